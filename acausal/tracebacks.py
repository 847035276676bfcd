"""Tracebacks of uncaught acausal errors in scripts and notebooks, reduced to the user's lines.

The environment variable ACAUSAL_TRACEBACK=full, or an exception hook installed by others, keeps full tracebacks. In a
notebook `%env ACAUSAL_TRACEBACK=full` and `%tb` show the last one in full.
"""

from __future__ import annotations

import os
import re
import sys
import sysconfig
import traceback
from pathlib import Path
from types import TracebackType
from typing import Any

from acausal.shadowed import NAMES, shadowed

SETTING = "ACAUSAL_TRACEBACK"
_PLACE = re.compile(r'(?:File ")?([^\s"]+)(?:", line |:)(\d+)(?:, in <module>)?')
_HOME = Path(__file__).parent.parent
_LIBRARIES = (
    *(f"{_HOME / name}{os.sep}" for name in ("acausal", "components")),
    *(f"{sysconfig.get_path(name)}{os.sep}" for name in ("stdlib", "platstdlib", "purelib", "platlib")),
    "<frozen ",
)


def install() -> None:
    """Install the exception hook of scripts, unless another is installed already."""
    if sys.excepthook is sys.__excepthook__:
        sys.excepthook = _show


def is_short() -> bool:
    """True if tracebacks show the user's lines only."""
    return os.environ.get(SETTING) != "full"


def user_traceback(error: BaseException, trace: TracebackType | None) -> str:
    """Return the traceback of an error with the user's frames only; with all frames if there are none of the user's.

    Parameters
    ----------
    error : BaseException
        The exception.
    trace : traceback
        Its traceback.
    """
    frames = traceback.extract_tb(trace)
    shell = sys.modules.get("IPython")
    libraries = (*_LIBRARIES, f"{Path(shell.__file__).parents[1]}{os.sep}") if shell and shell.__file__ else _LIBRARIES
    own = [frame for frame in frames if not frame.filename.startswith(libraries)]
    lines = ["Traceback (most recent call last):\n", *traceback.format_list(own or frames)]
    return _PLACE.sub(_cell, "".join([*lines, *traceback.format_exception_only(type(error), error)]))


def _cell(place: re.Match[str]) -> str:
    """Return a place in a notebook by its cell instead of a temporary file, other places as they are."""
    shell: Any = getattr(sys.modules.get("IPython"), "get_ipython", lambda: None)()
    name = getattr(getattr(shell, "compile", None), "format_code_name", lambda file: None)(place[1])
    return f"{' '.join(name)}, line {place[2]}" if name else place[0]


def _show(kind: type[BaseException], error: BaseException, trace: TracebackType | None) -> None:
    short = getattr(error, "_render_traceback_", None)  # of errors of this package
    if short:
        sys.stderr.write("\n".join([*short(), ""]))
    else:
        sys.__excepthook__(kind, error, trace)
        if isinstance(error, ImportError) and (error.name or "").partition(".")[0] in NAMES and (hidden := shadowed()):
            sys.stderr.write(f"{hidden[0].upper()}{hidden[1:]}\n")
