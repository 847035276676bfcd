"""compile(): from a model to a CompiledModel."""

from __future__ import annotations

import time as clock
from collections.abc import Collection, Mapping
from functools import partial
from typing import Any

import numpy as np

from acausal.compiler.argument_checks import checked_model, checked_values
from acausal.compiler.compiled_model import CompiledModel
from acausal.compiler.model_source import Source
from acausal.compiler.parameters import Settable
from acausal.compiler.structural_zeros import remedy_for_zeros
from acausal.compiler.time_conditions import split_time_comparisons
from acausal.errors import DeclarationError, StructurallySingularError, UnbalancedModelError
from acausal.flatten import FlatModel, flatten
from acausal.garbage import uncollected
from acausal.language.call_arguments import checked_arguments
from acausal.language.component import Component
from acausal.language.driven import Driven
from acausal.language.table import Table
from acausal.locks import exclusive
from acausal.reduce import plan_of, reduce
from acausal.reduce.explain import UNCONNECTED


@checked_arguments
@exclusive
@uncollected()
def compile(
    model: Component,
    parameters: Mapping[str, Any] | None = None,
    *,
    free: Collection[str] = (),
    full: bool = False,
) -> CompiledModel:
    """Compile a model: flatten, analyse, reduce and generate code.

    Parameters
    ----------
    model : Component
        An instance, such as SpinUp(omega=4).
    parameters : mapping of str to value, optional
        Values by path ("beam.E") that replace those of the model, structural ones as well.
    free : collection of str, optional
        Parameters, or entries such as "body.r_CM[0]", that stay in the equations although they are 0, so that they can be
        changed afterwards.
    full : bool
        Whether unknowns that stay 0 for ever remain, such as the motion of a planar machine out of its plane.

    Returns
    -------
    CompiledModel
        Ready for `simulate` and `linearize`; parameters can be changed without compiling again.

    Raises
    ------
    AcausalError
        If the model is wrong; the message names part, line, cause and remedy.
    """
    seconds: dict[str, float] = {}
    started = clock.perf_counter()

    def lap(stage: str) -> None:
        nonlocal started
        now = clock.perf_counter()
        seconds[stage] = now - started
        started = now

    model, parameters = checked_model(model), checked_values(parameters)
    free = (free,) if isinstance(free, str) else tuple(free)
    flat = flatten(model, parameters, free, full)
    settable = Settable(flat)
    settable.values(None)  # a parameter out of its limits, such as a length of 0, is reported before its consequences
    lap("flatten")
    flat, plan, linear = _analysed(flat, model, parameters, free)
    lap("analyse")
    reduced = split_time_comparisons(reduce(flat, plan, linear))
    lap("reduce")
    compiled = CompiledModel(
        reduced,
        seconds,
        Source(partial(compile, free=free, full=full) if free or full else compile, model, parameters),
        memo={Settable: settable},  # its values have been checked already
    )
    _generate(compiled)
    lap("generate")
    return compiled


def _analysed(
    flat: FlatModel, model: Component, parameters: Mapping[str, Any], free: Collection[str]
) -> tuple[FlatModel, Any, Any]:
    """Return the model with hidden constraints, the plan of its reduction and its linear terms."""
    try:
        return plan_of(flat)
    except (UnbalancedModelError, StructurallySingularError):
        _refuse_singular(flatten(model, parameters, free, full=True), model, parameters)
        raise


def _refuse_singular(flat: FlatModel, model: Component, parameters: Mapping[str, Any]) -> None:
    """Raise the error of a singular model with all unknowns; it names parameters whose zeros leave the model incomplete."""
    try:
        plan_of(flat)
    except (UnbalancedModelError, StructurallySingularError) as error:
        what, _, why = str(error).partition("\n")
        if remedy := remedy_for_zeros(model, parameters, flat, error):
            why = "\n".join([*(line for line in why.splitlines() if line.startswith(UNCONNECTED)), remedy])
        raise type(error)("\n".join(filter(None, (what, why)))) from None


def _generate(compiled: CompiledModel) -> None:
    """Generate the functions that every run needs, so that their seconds count as compile time."""
    guards = compiled.guards
    _ = compiled.local, compiled.values, compiled.start, guards.breaks, guards.estimate
    _ = compiled.constraints
    guards.check()


def _driven(compiled: CompiledModel, laws: dict[str, Any]) -> CompiledModel:
    """Return a model with laws of inputs among its equations, compiled again once for all laws of the same form."""
    if not laws:
        return compiled
    source = compiled.source
    if source is None:
        raise DeclarationError(f"`{next(iter(laws))}` is constant in this model, which cannot be compiled again.")
    forms = tuple((name, v.settings if isinstance(v, Table) else v) for name, v in sorted(laws.items()))
    if (_driven, forms) not in compiled.memo:
        compiled.memo[_driven, forms] = source.make(source.model, {**source.parameters, **laws})
    return compiled.memo[_driven, forms]


def full_system(compiled: CompiledModel) -> CompiledModel:
    """Return the model with the unknowns that stay 0, compiled again once; the model itself without a source."""
    source = compiled.source
    if source is None or not compiled.reduced.flat.stays_zero:
        return compiled
    if full_system not in compiled.memo:
        compiled.memo[full_system] = source.make(source.model, source.parameters, full=True)
    return compiled.memo[full_system]


def ready(
    model: Component | CompiledModel, parameters: Mapping[str, Any] | None = None, *, full: bool = False
) -> tuple[CompiledModel, np.ndarray]:
    """Return the compiled model, compiling it if needed, and the values of its free parameters after the changes.

    Parameters
    ----------
    model : Component or CompiledModel
        The model.
    parameters : mapping of str to value, optional
        Values by path.
    full : bool
        Whether unknowns that stay 0 remain.
    """
    if isinstance(model, CompiledModel):
        values = checked_values(parameters)
        model = _driven(model, {name: v for name, v in values.items() if model.settable.is_new_law(name, v)})
        model = full_system(model) if full else model
        return model, model.settable.values({k: v for k, v in values.items() if not isinstance(v, Driven)})
    compiled = compile(model, parameters, full=full)
    return compiled, compiled.settable.values(None)
