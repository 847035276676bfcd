"""Tracebacks of uncaught acausal errors in scripts and notebooks, reduced to the user's lines.

The environment variable ACAUSAL_TRACEBACK=full, or an exception hook installed by others, keeps full tracebacks.
"""

from __future__ import annotations

import os
import sys
import sysconfig
import traceback
from pathlib import Path
from types import TracebackType
from typing import Any

from acausal.errors import AcausalError
from acausal.shadowed import NAMES, shadowed

SETTING = "ACAUSAL_TRACEBACK"
_HOME = Path(__file__).parent.parent
_LIBRARIES = (
    *(f"{_HOME / name}{os.sep}" for name in ("acausal", "components")),
    *(f"{sysconfig.get_path(name)}{os.sep}" for name in ("stdlib", "platstdlib", "purelib", "platlib")),
    "<frozen ",
)


def install() -> None:
    """Install the exception hooks, unless others are installed already."""
    if sys.excepthook is sys.__excepthook__:
        sys.excepthook = _show
    shell: Any = getattr(sys.modules.get("IPython"), "get_ipython", lambda: None)()
    if shell is not None and not shell.custom_exceptions:
        shell.set_custom_exc((AcausalError,), _show_in_notebook)


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
    own = [frame for frame in frames if not frame.filename.startswith(_LIBRARIES)]
    lines = ["Traceback (most recent call last):\n", *traceback.format_list(own or frames)]
    return "".join([*lines, *traceback.format_exception_only(type(error), error)])


def _show(kind: type[BaseException], error: BaseException, trace: TracebackType | None) -> None:
    if isinstance(error, AcausalError) and os.environ.get(SETTING) != "full":
        sys.stderr.write(user_traceback(error, trace))
    else:
        sys.__excepthook__(kind, error, trace)
        if isinstance(error, ImportError) and (error.name or "").partition(".")[0] in NAMES and (hidden := shadowed()):
            sys.stderr.write(f"{hidden[0].upper()}{hidden[1:]}\n")


def _show_in_notebook(
    shell: Any, kind: type[BaseException], error: BaseException, trace: Any, tb_offset: Any = None
) -> None:
    if os.environ.get(SETTING) == "full":
        shell.showtraceback((kind, error, trace), tb_offset=tb_offset)
    else:
        sys.stderr.write(user_traceback(error, trace))
