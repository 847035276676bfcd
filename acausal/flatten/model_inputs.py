"""Inputs of the whole model: parameters with unknown variation in time, and so without derivatives."""

from __future__ import annotations

from typing import Any

import casadi as ca
import numpy as np

from acausal.errors import DeclarationError
from acausal.flatten.collected_statements import CollectedStatements
from acausal.flatten.flat_model import FlatModel
from acausal.language import fields as f
from acausal.language.component import Component
from acausal.symbols import dense, scalars, vec

REMEDY = (
    'Give it by a table, inputs={{"{name}": Table(times, values, kind="cubic")}}, or filter it: '
    "exact=False in rotational.Position or rotational.Speed, or an equation such as "
    "T * der(y) == {name} - y, whose y has a derivative."
)


def inputs_of(tree: Component) -> dict[int, str]:
    """Return the names of the inputs of the whole model by the hashes of their symbols."""
    names = [n for n, d in tree.fields.items() if isinstance(d, f.Variable) and d.causality == "input"]
    return {s.element_hash(): name for name in names for s in _symbols(getattr(tree, name).sx)}


def held_inputs(flat: FlatModel, p: np.ndarray) -> dict[str, float]:
    """Return the inputs of the whole model that are constant, entry by entry, with their values in p."""
    known, own = inputs_of(flat.tree), flat.parameters
    entries = zip(own.names, scalars(own.symbols), p.tolist(), strict=True)
    return {name: value for name, symbol, value in entries if symbol.element_hash() in known}


def refuse_input_derivatives(raw: CollectedStatements) -> None:
    """Raise DeclarationError if der() is applied to an expression that contains an input of the whole model."""
    inputs = inputs_of(raw.build.root)
    if not inputs or not raw.pending.derivatives:
        return
    column = ca.vertcat(*[vec(dense(e)) for _, e in raw.pending.derivatives])
    found = [inputs[s.element_hash()] for s in ca.symvar(column) if s.element_hash() in inputs]
    if found:
        raise DeclarationError(
            f"der() is applied to an expression of the input `{found[0]}`, whose derivative is unknown. "
            f"{REMEDY.format(name=found[0])}"
        )


def _symbols(sx: Any) -> list[Any]:
    return [s for s in scalars(sx) if s.is_symbolic()]
