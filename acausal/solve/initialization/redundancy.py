"""Redundant constraints of loops, by numerical ranks.

Constraints are redundant only if their Jacobian lacks rank in a neighbourhood on the constraints: if the rank rises after a
small motion, the configuration is singular instead, and all constraints are independent.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from acausal.compiler import CompiledModel
from acausal.compiler.memo import memoized
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
    """Redundant constraints, by number, and whether the configuration is singular."""

    redundant: tuple[int, ...] = ()
    singular: bool = False


def find_redundancy(problem: Problem, at: Point) -> Redundancy:
    """Compare the rank of the constraint Jacobian at a consistent position and after a small motion."""
    whole, blocks = lowest(problem.compiled)
    entries = problem.scaled_gradients(at).data[whole.entries]
    doubtful = [block for block in blocks if not is_regular(block.sparse(entries), RANKS.nearly)]
    if not doubtful:
        return Redundancy()
    here = [scaled(block.dense(entries)) for block in doubtful]
    best, singular, stuck = list(here), False, False
    for seed in range(RANKS.motions):
        aside = _perturbed(problem, at, doubtful, here, seed)
        if aside is None:
            break
        moved, mismatch = close(problem, aside, np.empty(0, int), positions=True)
        if not mismatch < RANKS.moved:
            stuck = True
            continue
        entries = problem.scaled_gradients(moved).data[whole.entries]
        for k, block in enumerate(doubtful):
            rows = scaled(block.dense(entries))
            if rank(rows, RANKS.nearly) > rank(best[k], RANKS.nearly):
                best[k], singular = rows, True
    if stuck and not singular:
        # Constraints of second order lock the motion that the Jacobian leaves free: the length of a straight inextensible beam.
        return Redundancy((), True)
    weight = _weight(problem.compiled)
    redundant = [row for block, rows in zip(doubtful, best, strict=True) for row in _surplus(block, rows, weight)]
    return Redundancy(tuple(sorted(redundant)), singular)


@memoized
def lowest(compiled: CompiledModel) -> tuple[Block, list[Block]]:
    """Return the constraints at their lowest levels, and the connected blocks of these."""
    c = compiled.constraints
    found = block_of(c.pattern, c.lowest, np.arange(compiled.nx))
    return found, connected_blocks(found.places[0], found.places[1], (len(c.lowest), compiled.nx))


def _weight(compiled: CompiledModel) -> np.ndarray:
    """Weights for pivoting: constraints that must not be redundant come first."""
    c = compiled.constraints
    weight = np.full(len(c.rows), RANKS.kept)
    weight[np.array(c.closures, dtype=int)[may_be_redundant(compiled)]] = 1.0
    return weight


def _surplus(block: Block, rows: np.ndarray, weight: np.ndarray) -> list[int]:
    """Redundant constraints of a block."""
    independent = rank(rows)
    if independent == len(rows):
        return []
    order = pivots((weight[block.rows, None] * rows).T) if rows.size else np.arange(len(rows))
    return block.rows[order[independent:]].tolist()


def is_singular(problem: Problem, at: Point) -> bool:
    """Return whether independent constraints are nearly dependent at a point."""
    c = problem.compiled.constraints
    if not c.size:
        return False
    rows = c.lowest[c.counting(at.constants.closures)[c.lowest]]
    J = problem.scaled_gradients(at)[rows].tocsc()
    return not all(is_regular(block.sparse(J.data), RANKS.beside) for block in connected_blocks_of(J))


def _perturbed(problem: Problem, at: Point, doubtful: list[Block], here: list[np.ndarray], seed: int) -> Point | None:
    """Return a point a small random motion away in the null spaces of blocks; None if there are none."""
    x, random = at.x.copy(), np.random.default_rng(seed)
    for block, J in zip(doubtful, here, strict=True):
        null = null_space(J)
        if len(null):
            direction = null.T @ random.standard_normal(len(null))
            x[block.columns] += (
                RANKS.motion * direction / np.linalg.norm(direction) * problem.loop_scales[block.columns]
            )
    return None if np.array_equal(x, at.x) else replace(at, x=x)
