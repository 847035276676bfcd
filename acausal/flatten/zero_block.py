"""The equations of the unknowns that stay 0, which tell whether a disturbance of them would grow."""

from __future__ import annotations

from collections.abc import Callable
from itertools import pairwise

import casadi as ca

from acausal.flatten.attributes import unknown_names
from acausal.flatten.collected_statements import CollectedStatements
from acausal.flatten.linear_values import expressions, resolved
from acausal.flatten.stays_zero import StaysZero, ZeroBlock
from acausal.symbols import picked


def zero_block(
    raw: CollectedStatements, lower: list[int], found: StaysZero, residuals: ca.SX, symbols: ca.SX
) -> Callable[[], ZeroBlock] | None:
    """Return a function that forms the equations of the unknowns that stay 0; None if none of these has a derivative.

    Parameters
    ----------
    raw : CollectedStatements
        Statements of the components.
    lower : list of int
        Position of the differentiated unknown, for each derivative.
    found : StaysZero
        The unknowns that stay 0.
    residuals, symbols : casadi.SX
        Residuals and unknowns of the model, before simplification.
    """
    if not found.differentiated:
        return None

    def block() -> ZeroBlock:
        names = unknown_names(raw, lower)
        members = list(found.members)
        derivative = {k: up for chain in found.chains for k, up in pairwise(chain)}
        column = ca.vertcat(
            picked(residuals, [s.row for s in found.sources if not s.unknowns]),
            expressions(list(found.links.values()), symbols),
        )
        # What was removed before is an alias of members or of other unknowns.
        removed = list(found.solved)
        values = [resolved((0.0, ((k, 1.0),)), found.solved) for k in removed]
        column = ca.substitute([column], [picked(symbols, removed)], [expressions(values, symbols)])[0]
        place = {k: n for n, k in enumerate(members)}
        return ZeroBlock(
            column,
            picked(symbols, members),
            tuple(names[k] for k in members),
            tuple(place[derivative[k]] if k in derivative else -1 for k in members),
        )

    return block
