"""Arrays of reduced bodies: of one shape, finite, and never changed."""

from __future__ import annotations

from typing import Any

import numpy as np

from acausal import DeclarationError

Array = np.ndarray


def frozen(values: Any, shape: tuple[int, ...], what: str) -> Array:
    """An array of its own that nobody can change, with the shape that is needed."""
    array = np.array(values, dtype=float, order="C") + 0.0  # -0.0 and 0.0 are one value in a digest
    if array.shape != shape:
        raise DeclarationError(f"{what} has shape {array.shape} where {shape} is needed")
    if not np.isfinite(array).all():
        raise DeclarationError(f"{what} holds numbers that are not finite")
    array.setflags(write=False)
    return array
