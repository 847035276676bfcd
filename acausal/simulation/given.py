"""result_of(): a Result of what another method than the engine's has found."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from acausal.compiler import CompiledModel, model_of, ready
from acausal.errors import DeclarationError
from acausal.language.arguments import fitting
from acausal.language.component import Component
from acausal.locks import alone
from acausal.result import Result
from acausal.result.lookup import find, names
from acausal.result.made import checked_columns, checked_outputs, checked_times, kept_of
from acausal.solve.results.external import evaluator_of
from acausal.units import parse


@fitting
@alone
def result_of(
    time: Any,
    values: Mapping[str, Any],
    outputs: Sequence[str] = (),
    *,
    model: Component | CompiledModel | None = None,
    parameters: Mapping[str, Any] | None = None,
    title: str = "",
    **stats: Any,
) -> Result:
    """Return a result of given arrays, alone or as the motion of a model.

    Without a model it holds these arrays and nothing else. With one, the arrays tell all of its states (`compiled.states`),
    by any name that a state has, and maybe more. Everything of the model can then be read: what is given, and what its
    variables of the same value are, as it is given; everything else from these, as the equations of the model have it
    at these states. So a method may bring its own accelerations, and the outputs of the model follow from them.

    Parameters
    ----------
    time : array_like, shape (times,)
        In s, increasing.
    values : mapping of str to (array_like, str)
        For each path, as "body.tip.v", an array with one entry for each time, shape (times, *shape), in SI, and the unit of its
        entries. The entries are scalars, vectors or matrices. Variables of the model need no unit: the array alone is in
        theirs. What the model does not have is read beside it.
    outputs : sequence of str
        Paths of the columns of tables and pictures if nothing is asked for. If there are none, the outputs of the model, or
        without one all scalars.
    model : Component or CompiledModel, optional
        Without closed loops and discrete variables: their states do not tell all.
    parameters : mapping of str to value, optional
        Values of the parameters of the model by path, as of `simulate`.
    title : str
        What the arrays are of, for titles; the class of the model if not given.
    **stats : Any
        Statistics, as `Result.stats` has them.

    Returns
    -------
    Result
        Of these arrays alone as one that was loaded without its model.

    Raises
    ------
    DeclarationError
        If an array has not one entry for each time, a path is none, a unit is not known or not that of the model, a state has no
        values, two names of one variable have different ones, or an output is not among the values.

    Examples
    --------
    >>> result_of([0.0, 1.0], {"ball.r_0": ([[0, 0, 1], [0, 0, 0.5]], "m")})["ball.r_0[2]"].tolist()
    [1.0, 0.5]
    """
    times = checked_times(time)
    if model is None:
        columns = checked_columns(times, values)
        if parameters:
            raise DeclarationError("parameters= are those of a model: give it by model=")
        kept = kept_of(columns, times.size, title)
        shown = checked_outputs(outputs, kept.names) or tuple(n for n, q in kept.quantities.items() if not q.shape)
        return Result(times, kept.evaluate, kept, shown, stats, title)
    compiled, p = ready(model_of(model, compiled=True), parameters)
    known = set(names(compiled.tree))
    columns = checked_columns(times, values, known)
    own = {path: _fitting(compiled, path, *column) for path, column in columns.items() if path in known}
    beside = {path: column for path, column in columns.items() if path not in known}
    shown = checked_outputs(outputs, [*known, *beside]) or compiled.outputs
    with np.errstate(all="ignore"):
        evaluate = evaluator_of(compiled, p, times, own)
    counts = {"equations_reduced": compiled.nx + compiled.nz, "states": compiled.nx, "algebraic": compiled.nz}
    more = kept_of(beside, times.size) if beside else None
    return Result(times, evaluate, compiled.tree, shown, counts | stats, title or type(compiled.tree).__name__, more)


def _fitting(compiled: CompiledModel, path: str, given: Any, values: np.ndarray) -> Any:
    """Return what a path means in the model, and its values."""
    quantity = find(compiled.tree, path)
    if quantity.shape != given.shape:
        raise DeclarationError(f"`{path}` has shape {quantity.shape} in the model, and {given.shape} in the values")
    for declared, unit in zip(quantity.units, given.units, strict=True):
        if declared and unit and parse(declared) != parse(unit):
            raise DeclarationError(f"`{path}` is in {declared} in the model, and in {unit} in the values")
    return quantity, values
