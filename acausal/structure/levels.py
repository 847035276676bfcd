"""Levels of a block triangular system: sets of blocks, each solved simultaneously, one after the other."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass

from acausal.structure.block import Block
from acausal.structure.incidence import Rows


@dataclass(frozen=True)
class Level:
    """Equations solved simultaneously for as many variables, both ascending; linear ones in one Newton step."""

    equations: tuple[int, ...]
    variables: tuple[int, ...]
    linear: bool


def levels(blocks: Sequence[Block], rows: Rows, products: Iterable[tuple[int, int, int]]) -> tuple[Level, ...]:
    """Merge blocks as long as the merged system stays linear in its own variables.

    Parameters
    ----------
    blocks : sequence of Block
        Blocks in order of solution.
    rows : sequence of sequence of int
        Variables of every equation.
    products : iterable of (int, int, int)
        Equation and two variables whose mixed second derivative is not zero, in any order.

    Returns
    -------
    levels : tuple of Level
        Levels in order of solution. Nonlinear blocks share no level with linear ones.
    """
    of = {variable: k for k, block in enumerate(blocks) for variable in block.variables}
    together: dict[int, set[tuple[int, int]]] = {}
    owner = {equation: k for k, block in enumerate(blocks) for equation in block.equations}
    for equation, a, b in products:
        together.setdefault(owner[equation], set()).add((of[a], of[b]))
    height: list[int] = []
    linear: list[bool] = []
    for k, block in enumerate(blocks):
        needed = {of[v] for equation in block.equations for v in rows[equation]} - {k}
        pairs = together.get(k, set())
        linear.append((k, k) not in pairs)
        if linear[k]:
            # A product of two variables is linear as soon as one of them is known.
            first = [min(height[m] for m in pair if m != k) for pair in pairs]
            height.append(max([*(height[m] + (not linear[m]) for m in needed), *(h + 1 for h in first)], default=0))
        else:
            height.append(max((height[m] + 1 for m in needed), default=0))
    members: dict[tuple[int, bool], list[Block]] = {}
    for k, block in enumerate(blocks):
        members.setdefault((height[k], linear[k]), []).append(block)
    return tuple(
        Level(
            tuple(sorted(e for block in members[key] for e in block.equations)),
            tuple(sorted(v for block in members[key] for v in block.variables)),
            key[1],
        )
        for key in sorted(members)
    )
