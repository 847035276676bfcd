"""Validated, read-only arrays of reduced bodies."""

from __future__ import annotations

from typing import Any

import numpy as np

from acausal import DeclarationError

Array = np.ndarray


def frozen(values: Any, shape: tuple[int, ...], what: str) -> Array:
    """Return a read-only copy of `values`, checked for its shape and for finite numbers."""
    array = np.array(values, dtype=float, order="C") + 0.0  # + 0.0: -0.0 and 0.0 get the same digest
    if array.shape != shape:
        raise DeclarationError(f"{what} must have shape {shape}, not {array.shape}")
    if not np.isfinite(array).all():
        raise DeclarationError(f"{what} contains numbers that are not finite")
    array.setflags(write=False)
    return array
