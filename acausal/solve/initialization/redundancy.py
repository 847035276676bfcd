"""Which constraints of loops count, by their ranks when numbers are known.

A constraint is redundant only if its Jacobian lacks rank at consistent positions all around: where the rank rises after
a small motion, the position is singular, and all constraints stay.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from acausal.compiler import CompiledModel
from acausal.compiler.once import once
from acausal.policy import POLICY
from acausal.solve.initialization.assembly import close
from acausal.solve.initialization.independent_constraints import may_be_redundant
from acausal.solve.initialization.rank import is_regular, null_space, pivots, rank, scaled
from acausal.solve.point import Point
from acausal.solve.problem import Problem
from acausal.solve.sparse_blocks import Block, block_of, connected_blocks, connected_blocks_of

RANKS = POLICY.ranks


@dataclass(frozen=True)
class Redundancy:
    """Redundant constraints, by number, and whether the position is singular."""

    redundant: tuple[int, ...] = ()
    singular: bool = False


def find_redundancy(problem: Problem, at: Point) -> Redundancy:
    """Compare the rank of the constraint Jacobian at a consistent position and after a small motion."""
    held, apart = lowest(problem.compiled)
    entries = problem.scaled_gradients(at).data[held.entries]
    doubtful = [block for block in apart if not is_regular(block.sparse(entries), RANKS.nearly)]
    if not doubtful:
        return Redundancy()
    here = [scaled(block.dense(entries)) for block in doubtful]
    best, singular, stuck = list(here), False, False
    for seed in range(RANKS.motions):
        aside = _aside(problem, at, doubtful, here, seed)
        if aside is None:
            break
        moved, mismatch = close(problem, aside, np.empty(0, int), positions=True)
        if not mismatch < RANKS.moved:
            stuck = True
            continue
        entries = problem.scaled_gradients(moved).data[held.entries]
        for k, block in enumerate(doubtful):
            there = scaled(block.dense(entries))
            if rank(there, RANKS.nearly) > rank(best[k], RANKS.nearly):
                best[k], singular = there, True
    if stuck and not singular:
        # What seems to be free is held by what the Jacobian does not show, such as the length of a straight inextensible beam.
        return Redundancy((), True)
    weight = _weight(problem.compiled)
    redundant = [row for block, rows in zip(doubtful, best, strict=True) for row in _surplus(block, rows, weight)]
    return Redundancy(tuple(sorted(redundant)), singular)


@once
def lowest(compiled: CompiledModel) -> tuple[Block, list[Block]]:
    """Return the constraints at their lowest levels, and the parts of these that share no coordinates."""
    c = compiled.constraints
    found = block_of(c.pattern, c.lowest, np.arange(compiled.nx))
    return found, connected_blocks(found.places[0], found.places[1], (len(c.lowest), compiled.nx))


def _weight(compiled: CompiledModel) -> np.ndarray:
    """Those that cannot be redundant come first."""
    c = compiled.constraints
    weight = np.full(len(c.rows), RANKS.kept)
    weight[np.array(c.closures, dtype=int)[may_be_redundant(compiled)]] = 1.0
    return weight


def _surplus(block: Block, rows: np.ndarray, weight: np.ndarray) -> list[int]:
    """Constraints of a block that follow from others of it."""
    independent = rank(rows)
    if independent == len(rows):
        return []
    order = pivots((weight[block.rows, None] * rows).T) if rows.size else np.arange(len(rows))
    return block.rows[order[independent:]].tolist()


def is_singular(problem: Problem, at: Point) -> bool:
    """Whether constraints that are independent elsewhere are nearly dependent in a position."""
    c = problem.compiled.constraints
    if not c.size:
        return False
    held = c.lowest[c.counting(at.constants.closures)[c.lowest]]
    J = problem.scaled_gradients(at)[held].tocsc()
    return not all(is_regular(block.sparse(J.data), RANKS.beside) for block in connected_blocks_of(J))


def _aside(problem: Problem, at: Point, doubtful: list[Block], here: list[np.ndarray], seed: int) -> Point | None:
    """Return a point near by, along what the Jacobian leaves free in each of some parts; None where that is nothing."""
    x, random = at.x.copy(), np.random.default_rng(seed)
    for block, J in zip(doubtful, here, strict=True):
        null = null_space(J)
        if len(null):
            direction = null.T @ random.standard_normal(len(null))
            x[block.columns] += (
                RANKS.motion * direction / np.linalg.norm(direction) * problem.loop_scales[block.columns]
            )
    return None if np.array_equal(x, at.x) else replace(at, x=x)
