"""Check that index reduction needs no derivative of an input of the model."""

from __future__ import annotations

import casadi as ca

from acausal.errors import DeclarationError
from acausal.flatten import FlatModel
from acausal.flatten.model_inputs import REMEDY, inputs_of
from acausal.structure import Plan
from acausal.symbols import scalars


def refuse_differentiated_inputs(flat: FlatModel, plan: Plan) -> None:
    """Raise DeclarationError if index reduction differentiates an equation that contains an input of the model.

    An input of the model is a constant parameter: its derivative would silently be 0.
    """
    inputs = inputs_of(flat.tree)
    if not inputs:
        return
    residuals = scalars(flat.equations.residuals)
    for equation in sorted(e for e in plan.differentiated if e < len(residuals)):
        found = [inputs[s.element_hash()] for s in ca.symvar(residuals[equation]) if s.element_hash() in inputs]
        if found:
            raise DeclarationError(
                f"{flat.equations.origins[equation]}: this equation prescribes a motion by the input `{found[0]}`, "
                f"whose derivatives are needed but unknown. {REMEDY.format(name=found[0])}"
            )
