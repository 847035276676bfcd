"""Separation of the blocks that are evaluated after the integration."""

from __future__ import annotations

from collections.abc import Collection, Sequence

from acausal.structure.block import Block
from acausal.structure.system import System


def split_observed(
    system: System, states: Collection[int], blocks: Sequence[Block]
) -> tuple[list[Block], list[tuple[int, int]]]:
    """Separate scalar explicit equations on which no state derivative depends (backward reachability).

    Returns
    -------
    needed : list of Block
        In order of solution.
    observed : list of (int, int)
        (variable, equation), in order of evaluation.

    """
    rates = {system.derivative[state] for state in states}
    wanted: set[int] = set()
    needed: list[Block] = []
    observed: list[tuple[int, int]] = []
    for block in reversed(blocks):
        variable, equation = block.variables[0], block.equations[0]
        single = len(block.variables) == 1 and variable in system.explicit[equation]
        if single and variable not in rates and variable not in wanted:
            observed.append((variable, equation))
            continue
        needed.append(block)
        for e in block.equations:
            wanted.update(system.rows[e])
    return needed[::-1], observed[::-1]
