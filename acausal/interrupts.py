"""An interrupt while the command is still loading ends it in a word, not in a traceback."""

from __future__ import annotations

import sys
from pathlib import PurePath
from types import TracebackType


def shorten_loading_interrupts() -> None:
    """Tell of an interrupt in a word if this process is the `acausal` command, from the script or by `python -m`."""
    module = sys.argv[:1] == ["-m"] and "acausal" in sys.orig_argv
    if module or PurePath(sys.argv[0] if sys.argv else "").stem == "acausal":
        sys.excepthook = _report


def _report(kind: type[BaseException], error: BaseException, trace: TracebackType | None) -> None:
    if issubclass(kind, KeyboardInterrupt):
        print("Error: interrupted.", file=sys.stderr)
    else:
        sys.__excepthook__(kind, error, trace)
