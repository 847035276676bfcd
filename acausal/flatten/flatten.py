"""Flattening of a model to its FlatModel."""

from __future__ import annotations

from collections.abc import Collection, Mapping
from typing import Any

import casadi as ca

from acausal.flatten.assembly import Assembly
from acausal.flatten.collected_statements import CollectedStatements, collect_statements
from acausal.flatten.derivatives import Derivatives
from acausal.flatten.flat_model import FlatModel
from acausal.flatten.model_inputs import refuse_input_derivatives
from acausal.flatten.opaque_calls import refuse_opaque_expressions
from acausal.flatten.origin import Origin
from acausal.language.component import Component
from acausal.symbols import scalars


def flatten(
    model: Component, overrides: Mapping[str, Any] | None = None, free: Collection[str] = (), full: bool = False
) -> FlatModel:
    """Return the flat model: instantiate, connect, collect the equations, propagate constants and aliases.

    Parameters
    ----------
    model : Component
        The model as constructed.
    overrides : mapping of str to value, optional
        Values of parameters and structural parameters by path, instead of those in the model.
    free : collection of str
        Parameters that keep a symbol even if they are 0.
    full : bool
        Whether unknowns that stay 0 remain.

    Returns
    -------
    FlatModel

    Raises
    ------
    DeclarationError, ConnectError, UnitsError
        For errors in the model, with component and line.
    """
    raw = collect_statements(model, overrides, free)
    refuse_opaque_expressions(raw)
    declared = _declared(raw)
    integrated = _integrated(raw, declared)
    chain = Derivatives(raw.variables, {k: e for k, e in declared.items() if k not in integrated})
    placeholders, derivatives = chain.resolve(raw.pending.derivatives)

    refuse_input_derivatives(raw)

    def resolved(expressions: list[ca.SX]) -> list[ca.SX]:
        return ca.substitute(expressions, [placeholders], [derivatives])

    names = [name for a in raw.arrays for name in a.names]
    for k in integrated:
        raw.equations.residuals.append(chain.symbol(k) - declared[k])
        raw.equations.origins.append(Origin(names[k], "root", "declared derivative"))
        raw.equations.sides.append((chain.symbol(k), declared[k]))
    followed = {k: e for k, e in declared.items() if k not in integrated}
    return Assembly(raw, chain, resolved, followed, full).flat_model()


def _declared(raw: CollectedStatements) -> dict[int, ca.SX]:
    """Return the declared derivatives by the positions of their variables."""
    return {
        raw.index[s.element_hash()]: e
        for variable, derivative in (*raw.declared, *raw.declared_by_parts)
        for s, e in zip(scalars(variable.sx), scalars(derivative.sx), strict=True)
    }


def _integrated(raw: CollectedStatements, declared: dict[int, ca.SX]) -> list[int]:
    """Return the variables of chosen roots with a declared derivative that no root equation defines."""
    if not raw.graph.roots:
        return []
    found: set[int] = set()
    defined = {k for i in raw.equations.of_roots for k in _bare(raw, raw.equations.sides[i][0])}
    for connector in raw.graph.roots:
        for variable, _ in connector.declared_derivatives():
            found.update(raw.index[s.element_hash()] for s in scalars(variable.sx))
    return sorted(k for k in found if k in declared and k not in defined)


def _bare(raw: CollectedStatements, side: ca.SX) -> list[int]:
    """Return the positions of the variables on a side of an equation, [] if it contains other expressions."""
    indices = [raw.index.get(s.element_hash(), -1) for s in scalars(side)]
    return indices if -1 not in indices else []
