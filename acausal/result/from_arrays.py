"""Results made from arrays, as other methods compute them."""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence
from typing import Any

import numpy as np

from acausal.errors import DeclarationError
from acausal.language.quantities import misplaced_quantity
from acausal.result.lookup import Quantity
from acausal.result.snapshot import Snapshot
from acausal.units import parse as unit_of

# Values by path: the quantity, and its entries in column-major order, shape (times, n).
Columns = Mapping[str, tuple[Quantity, np.ndarray]]


def checked_times(time: Any) -> np.ndarray:
    """Return times as an array.

    Raises
    ------
    DeclarationError
        If they are not increasing finite numbers.
    """
    if wrong := misplaced_quantity(time):
        raise DeclarationError(f"the time is {wrong}")
    try:
        times = np.array(time, dtype=float)
    except (TypeError, ValueError):
        times = np.full((1, 1), np.nan)
    if times.ndim != 1 or not np.isfinite(times).all() or (np.diff(times) <= 0).any():
        raise DeclarationError("the times of a result are a vector of increasing finite numbers")
    return times


def checked_columns(
    times: np.ndarray, values: Any, known: Collection[str] = ()
) -> dict[str, tuple[Quantity, np.ndarray]]:
    """Return each given array as a quantity with its unit, and as columns.

    Parameters
    ----------
    times : array, shape (times,)
        In s.
    values : mapping of str to (array_like, str)
        See `result_of`.
    known : collection of str
        Paths whose unit is known and may be left out; it is "" then.

    Raises
    ------
    DeclarationError
        If a path, an array, a shape or a unit is invalid.
    """
    if not isinstance(values, Mapping):
        raise DeclarationError('values is a dictionary of arrays with units by path: {"body.tip.v": (array, "m/s")}')
    found = {}
    for path, entry in values.items():
        measured = isinstance(entry, tuple | list) and len(entry) == 2 and isinstance(entry[1], str)
        if not measured and path not in known:
            raise DeclarationError(f'`{path}` needs an array and its unit: (array, "m/s")')
        given, unit = entry if measured else (entry, "")
        if wrong := misplaced_quantity(given):
            raise DeclarationError(f"`{path}` is {wrong}")
        try:
            array = np.array(given, dtype=float)
        except (TypeError, ValueError):
            array = np.empty((0, 0, 0, 0))
        if array.shape[:1] != times.shape or array.ndim > 3:
            raise DeclarationError(
                f"`{path}` has shape {array.shape}: a scalar, vector or matrix for each of {times.size} times is needed"
            )
        shape = array.shape[1:]
        size = int(np.prod(shape))
        columns = array.reshape(times.size, size) if len(shape) < 2 else array.transpose(0, 2, 1).reshape(-1, size)
        if measured:
            unit_of(unit)
        found[_path(path)] = Quantity(path, np.arange(size), shape, (unit,) * size), columns
    return found


def snapshot_of(columns: Columns, times: int, title: str = "") -> Snapshot:
    """Return arrays as a snapshot.

    Parameters
    ----------
    columns : mapping of str to (Quantity, array)
        From `checked_columns`.
    times : int
        Number of times.
    title : str
        Title of the result.
    """
    quantities, blocks, first = {}, [np.empty((times, 0))], 0
    for path, (quantity, block) in columns.items():
        places = np.arange(first, first + block.shape[1])
        quantities[path] = Quantity(path, places, quantity.shape, quantity.units)
        blocks.append(block)
        first += block.shape[1]
    return Snapshot(title or "Result", quantities, {}, np.hstack(blocks), np.empty(0))


def checked_outputs(outputs: Sequence[str], names: Sequence[str]) -> tuple[str, ...]:
    """Return the names of outputs.

    Raises
    ------
    DeclarationError
        If one is not among the known names.
    """
    if isinstance(outputs, str) or not all(isinstance(name, str) for name in outputs):
        raise DeclarationError(f'outputs are a list of paths, ["body.tip.v"], not {outputs!r}')
    missing = [name for name in outputs if name not in names]
    if missing:
        raise DeclarationError(f"the output `{missing[0]}` is not among the values")
    return tuple(outputs)


def _path(path: Any) -> str:
    if not isinstance(path, str) or not all(part.split("[")[0].isidentifier() for part in path.split(".")):
        raise DeclarationError(f'a quantity is named by a path, as "body.tip.v", not {path!r}')
    return path
