"""Warnings that show the line of the user."""

from __future__ import annotations

import sys
import warnings

from acausal import AcausalWarning


def warn(text: str) -> None:
    """Issue an `AcausalWarning` at the innermost line outside this package."""
    level, frame = 1, sys._getframe(0)
    while frame.f_back is not None and frame.f_globals.get("__name__", "").startswith("components.fe"):
        level, frame = level + 1, frame.f_back
    warnings.warn(AcausalWarning(text), stacklevel=level)
