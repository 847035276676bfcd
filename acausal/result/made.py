"""A result from arrays: of a method that is none of the engine's, read like any other."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from acausal.errors import DeclarationError
from acausal.language.arguments import fitting
from acausal.result.kept import Kept
from acausal.result.lookup import Quantity
from acausal.result.result import Result
from acausal.units import parse as unit_of


@fitting
def result_of(
    time: Any,
    values: Mapping[str, tuple[Any, str]],
    outputs: Sequence[str] = (),
    *,
    model: str = "",
    **stats: Any,
) -> Result:
    """Return a result that holds given arrays.

    Parameters
    ----------
    time : array_like, shape (times,)
        In s, increasing.
    values : mapping of str to (array_like, str)
        For each path, as "body.tip.v", an array with one entry for each time, shape (times, *shape), in SI, and the unit of its
        entries. The entries are scalars, vectors or matrices.
    outputs : sequence of str
        Paths of the columns of tables and pictures if nothing is asked for; all scalars if there are none.
    model : str
        What the arrays are of, for titles.
    **stats : Any
        Statistics, as `Result.stats` has them.

    Returns
    -------
    Result
        Of these quantities alone, as one that was loaded without its model.

    Raises
    ------
    DeclarationError
        If an array has not one entry for each time, a path is none, a unit is not known, or an output is not among the
        values.

    Examples
    --------
    >>> result_of([0.0, 1.0], {"ball.r_0": ([[0, 0, 1], [0, 0, 0.5]], "m")})["ball.r_0[2]"].tolist()
    [1.0, 0.5]
    """
    times = np.array(time, dtype=float)
    if times.ndim != 1 or not np.isfinite(times).all() or (np.diff(times) <= 0).any():
        raise DeclarationError("the times of a result are a vector of finite numbers that increase")
    quantities: dict[str, Quantity] = {}
    columns, first = [np.empty((times.size, 0))], 0
    for path, (given, unit) in values.items():
        array = np.array(given, dtype=float)
        if array.shape[:1] != times.shape or array.ndim > 3:
            raise DeclarationError(
                f"`{path}` has shape {array.shape}: a scalar, vector or matrix for each of {times.size} times is needed"
            )
        shape = array.shape[1:]
        size = int(np.prod(shape))
        columns.append(
            array.reshape(times.size, size) if len(shape) < 2 else array.transpose(0, 2, 1).reshape(-1, size)
        )
        quantities[_path(path)] = Quantity(path, np.arange(first, first + size), shape, (_unit(unit),) * size)
        first += size
    missing = [name for name in outputs if name not in quantities]
    if missing:
        raise DeclarationError(f"the output `{missing[0]}` is not among the values")
    kept = Kept(model or "Result", quantities, {}, np.hstack(columns), np.empty(0))
    shown = tuple(outputs) or tuple(name for name, q in quantities.items() if not q.shape)
    return Result(times, kept.evaluate, kept, shown, stats, model)


def _unit(unit: str) -> str:
    unit_of(unit)
    return unit


def _path(path: str) -> str:
    if not isinstance(path, str) or not all(part.split("[")[0].isidentifier() for part in path.split(".")):
        raise DeclarationError(f'a quantity is named by a path, as "body.tip.v", not {path!r}')
    return path
