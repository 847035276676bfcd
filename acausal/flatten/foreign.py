"""Refuse calls of CasADi functions that cannot be written out: the passes that follow see elementary operations only."""

from __future__ import annotations

from collections.abc import Iterable
from typing import TYPE_CHECKING

import casadi as ca

from acausal.errors import DeclarationError

if TYPE_CHECKING:
    from acausal.flatten.said import Said


def refuse_calls(raw: Said) -> None:
    """Raise DeclarationError if an expression of the model calls an interpolant or another external function."""
    stated = [*zip(raw.equations.residuals, raw.equations.origins, strict=True)]
    stated += zip(raw.initial.residuals, raw.initial.origins, strict=True)
    stated += [(c.excess.sx, origin) for (_, c), origin in zip(raw.pending.switches, raw.pending.places, strict=False)]
    for when, origin in raw.pending.whens:
        stated += [(e.sx, origin) for e in (when.condition.excess, *[jump.value for jump in when.jumps])]
    others = [*[e for _, e in raw.pending.derivatives], *raw.energies.values(), *raw.discrete_starts]
    if not _calls([*[sx for sx, _ in stated], *others]):
        return
    where = next((f"{origin}: " for sx, origin in stated if _calls([sx])), "")
    if not where:
        where = _user(raw, others)
    raise DeclarationError(
        f"{where}an expression calls a CasADi function that cannot be differentiated and sorted as an equation, such as "
        "an interpolant or an external function. Write a table with piecewise((value, condition), ..., otherwise), or as "
        "a polynomial; a function of elementary operations is written out where it is called with SX."
    )


def _user(raw: Said, others: list[ca.SX]) -> str:
    """Where a derivative or an energy is used that holds the call."""
    held = [placeholder for (placeholder, _), e in zip(raw.pending.derivatives, others, strict=False) if _calls([e])]
    for residual, origin in zip(raw.equations.residuals, raw.equations.origins, strict=True):
        if any(ca.depends_on(residual, placeholder) for placeholder in held):
            return f"{origin}: "
    name = next((name for name, e in raw.energies.items() if _calls([e])), "a start value")
    return f"{name}{'()' if name in raw.energies else ''}: "


def _calls(entries: Iterable[ca.SX]) -> bool:
    column = ca.vertcat(ca.SX(0, 1), *[ca.vec(e) for e in entries])
    function = ca.Function("all", [ca.vertcat(ca.SX(0, 1), *ca.symvar(column))], [column])
    return any(function.instruction_id(k) == ca.OP_CALL for k in range(function.n_instructions()))
