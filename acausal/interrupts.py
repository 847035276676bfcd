"""A short message, instead of a traceback, for an interrupt while the command is loading."""

from __future__ import annotations

import sys
from pathlib import PurePath
from types import TracebackType


def shorten_loading_interrupts() -> None:
    """Print one line for an interrupt if this process is the `acausal` command (script or `python -m`)."""
    module = sys.argv[:1] == ["-m"] and "acausal" in sys.orig_argv
    if module or PurePath(sys.argv[0] if sys.argv else "").stem == "acausal":
        sys.excepthook = _report


def _report(kind: type[BaseException], error: BaseException, trace: TracebackType | None) -> None:
    if issubclass(kind, KeyboardInterrupt):
        print("Error: interrupted.", file=sys.stderr)
    else:
        sys.__excepthook__(kind, error, trace)
