"""Indexing of symbolic arrays by the rules of numpy."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np

from acausal.errors import DeclarationError


def selected_entries(show: Callable[[], str], shape: tuple[int, ...], index: Any) -> np.ndarray:
    """Return the column-major positions of the selected entries, in the shape of the result.

    Parameters
    ----------
    show : function
        Returns the text of the array, for messages; called only for errors, as the text may be long.
    shape : tuple of int
        Shape of the array; a scalar has one entry.
    index : int, slice or tuple of them
        The index in brackets.

    Raises
    ------
    DeclarationError
        If the index is invalid or outside the array.
    """
    indices = index if isinstance(index, tuple) else (index,)
    ends = [end for item in indices for end in _ends(item)]
    if any(isinstance(end, bool) or not isinstance(end, int | np.integer) for end in ends):
        raise DeclarationError(
            f"{_indexed(show(), indices)}: entries of a symbol are selected by integers that are known when the model "
            "is built. Declare the index structural(...), or select with piecewise((value, condition), ..., otherwise)."
        )
    # A scalar can be indexed by 0, and a vector has one column.
    whole = (*shape, 1) if len(indices) > len(shape) < 2 else shape
    fits = len(indices) <= len(whole) and all(
        -n <= end < n + isinstance(item, slice)
        for item, n in zip(indices, whole, strict=False)
        for end in _bounds(item)
    )
    if not fits:
        shown = show()
        raise DeclarationError(f"{_indexed(shown, indices)} is outside {shown}, {_extent(shown, shape)}.")
    return np.arange(int(np.prod(shape))).reshape(whole, order="F")[index]


def _indexed(shown: str, indices: tuple[Any, ...]) -> str:
    return f"`{shown}[{', '.join(map(_written, indices))}]`"


def _ends(item: Any) -> list[Any]:
    """Return the values of an index that must be integers."""
    return [e for e in (item.start, item.stop, item.step) if e is not None] if isinstance(item, slice) else [item]


def _bounds(item: Any) -> list[int]:
    """Return the values of an index that must lie inside the array."""
    return [e for e in (item.start, item.stop) if e is not None] if isinstance(item, slice) else [item]


def _extent(shown: str, shape: tuple[int, ...]) -> str:
    if not shape:
        return "which is a scalar"
    if len(shape) == 2:
        return f"which has {shape[0]} rows and {shape[1]} columns"
    return f"whose entries are {shown}[0] to {shown}[{shape[0] - 1}]"


def _written(item: Any) -> str:
    if not isinstance(item, slice):
        return repr(item)
    return ":".join(
        "" if e is None else repr(e) for e in (item.start, item.stop, item.step)[: 2 + (item.step is not None)]
    )
