"""result_of(): a Result made from the arrays of another method."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import casadi as ca
import numpy as np

from acausal.compiler import CompiledModel, checked_model, ready
from acausal.errors import DeclarationError
from acausal.language.call_arguments import checked_arguments
from acausal.language.component import Component
from acausal.locks import exclusive
from acausal.result import Result
from acausal.result.from_arrays import checked_columns, checked_outputs, checked_times, snapshot_of
from acausal.result.lookup import Quantity, find, names
from acausal.solve.results.external import evaluator_of
from acausal.symbols import scalars
from acausal.units import parse


@checked_arguments
@exclusive
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
    """Return a result made from arrays, alone or as the motion of a model.

    Without a model, the result holds these arrays alone. With a model, the arrays must include all of its states
    (`compiled.states`), by any alias of a state, and may include more. Every variable of the model can then be read: given
    variables and their aliases as given, all others computed from them by the equations of the model. So a method may
    supply its own accelerations, and the outputs of the model follow from them.

    Parameters
    ----------
    time : array_like, shape (times,)
        In s, increasing.
    values : mapping of str to (array_like, str)
        For each path, such as "body.tip.v", an array of shape (times, *shape) in SI units, and the unit of its entries, which
        are scalars, vectors or matrices. For variables of the model the array alone is enough. Quantities that the model
        does not have are read beside it.
    outputs : sequence of str
        Default columns of tables and plots. If empty, the outputs of the model, or without a model all scalars.
    model : Component or CompiledModel, optional
        A model without closed loops and discrete variables: these are not determined by the states alone.
    parameters : mapping of str to value, optional
        Values of the parameters of the model by path, as in `simulate`.
    title : str
        Title of the result; the class of the model if not given.
    **stats : Any
        Statistics, as in `Result.stats`.

    Returns
    -------
    Result
        Without a model it is read by name alone, like a loaded result.

    Raises
    ------
    DeclarationError
        If an array does not have one entry per time, a path is invalid, a unit is unknown or not that of the model, a state
        has no values, two aliases have different values, or an output is not among the values.

    Examples
    --------
    >>> result_of([0.0, 1.0], {"ball.r_0": ([[0, 0, 1], [0, 0, 0.5]], "m")})["ball.r_0[2]"].tolist()
    [1.0, 0.5]
    """
    times = checked_times(time)
    if model is None:
        columns = checked_columns(times, values)
        if parameters:
            raise DeclarationError("parameters= needs a model: give it by model=")
        snapshot = snapshot_of(columns, times.size, title)
        shown = checked_outputs(outputs, snapshot.names) or tuple(
            n for n, q in snapshot.quantities.items() if not q.shape
        )
        return Result(times, snapshot.evaluate, snapshot, shown, stats, title)
    compiled, p = ready(checked_model(model, compiled=True), parameters)
    known = set(names(compiled.tree))
    columns = checked_columns(times, values, known)
    own = {path: _fitting(compiled, path, *column) for path, column in columns.items() if path in known}
    if compiled.reduced.flat.stays_zero and _contradicts_zeros(compiled, own):
        compiled, p = ready(model, parameters, full=True)
        own = {path: _fitting(compiled, path, *columns[path]) for path in own}
    beside = {path: column for path, column in columns.items() if path not in known}
    shown = checked_outputs(outputs, [*known, *beside]) or compiled.outputs
    with np.errstate(all="ignore"):
        evaluate = evaluator_of(compiled, p, times, own)
    counts = {"equations_reduced": compiled.nx + compiled.nz, "states": compiled.nx, "algebraic": compiled.nz}
    more = snapshot_of(beside, times.size) if beside else None
    return Result(times, evaluate, compiled.tree, shown, counts | stats, title or type(compiled.tree).__name__, more)


def _contradicts_zeros(compiled: CompiledModel, own: Mapping[str, tuple[Quantity, np.ndarray]]) -> bool:
    """Return whether a variable that is 0 in the model has other values, so that they are those of the full model."""
    was, becomes = compiled.reduced.flat.unknowns.eliminated
    for quantity, values in own.values():
        entries = scalars(ca.substitute([quantity.column], [was], [becomes])[0])
        if any(entry.is_zero() and values[:, k].any() for k, entry in enumerate(entries)):
            return True
    return False


def _fitting(compiled: CompiledModel, path: str, given: Any, values: np.ndarray) -> Any:
    """Return the quantity of the model that a path names, and its values, after checking shape and units."""
    quantity = find(compiled.tree, path)
    if quantity.shape != given.shape:
        raise DeclarationError(f"`{path}` has shape {quantity.shape} in the model, and {given.shape} in the values")
    for declared, unit in zip(quantity.units, given.units, strict=True):
        if declared and unit and parse(declared) != parse(unit):
            raise DeclarationError(f"`{path}` is in {declared} in the model, and in {unit} in the values")
    return quantity, values
