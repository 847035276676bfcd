"""Which constraints of loops count, by their ranks when numbers are known.

A constraint is redundant only if its Jacobian lacks rank at consistent positions all around: where the rank rises after
a small motion, the position is singular, and all constraints stay.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from acausal.policy import POLICY
from acausal.solve.points import Point
from acausal.solve.problem import Problem
from acausal.solve.start.loops import close
from acausal.solve.start.rank import null_space, pivots, rank, scaled

RANKS = POLICY.ranks


@dataclass(frozen=True)
class Redundancy:
    """Redundant constraints, by number, and whether the position is singular."""

    dropped: tuple[int, ...] = ()
    singular: bool = False


def find_redundancy(problem: Problem, at: Point) -> Redundancy:
    """Compare the rank of the constraint Jacobian at a consistent position and after a small motion."""
    compiled, c = problem.compiled, problem.compiled.constraints
    rows = [r[0] for r in c.rows]

    def jacobian(at: Point) -> np.ndarray:
        return scaled(problem.gradients(at)[rows])

    here = jacobian(at)
    if rank(here, RANKS.nearly) == len(rows):
        return Redundancy()
    free = np.linalg.norm(here, axis=0) > 0
    best, singular = here, False
    for seed in range(RANKS.motions):
        moved = _moved(problem, at, here, free, seed)
        there = jacobian(moved) if moved is not None else here
        if rank(there, RANKS.nearly) > rank(best, RANKS.nearly):
            best, singular = there, True
    if rank(best) == len(rows):
        return Redundancy(singular=singular)
    # Those that cannot be dropped come first.
    weight = np.ones(len(rows))
    closures = compiled.reduced.flat.loops.closures
    droppable = {c.closures[k] for k, closure in enumerate(closures) if not closure.dual.is_constant()}
    weight[[k for k in range(len(rows)) if k not in droppable]] = RANKS.kept
    order = pivots((weight[:, None] * best).T)
    return Redundancy(tuple(sorted(order[rank(best) :].tolist())), singular)


def is_singular(problem: Problem, at: Point, redundancy: Redundancy) -> bool:
    """Whether constraints that are independent elsewhere are nearly dependent in a position."""
    if not problem.compiled.constraints.size:
        return False
    held = [rows[0] for k, rows in enumerate(problem.compiled.constraints.rows) if k not in redundancy.dropped]
    return rank(problem.gradients(at)[held], RANKS.beside) < len(held)


def _moved(problem: Problem, at: Point, J: np.ndarray, free: np.ndarray, seed: int) -> Point | None:
    """Return another consistent position near by, along what the constraints leave free."""
    null = null_space(J[:, free])
    if not len(null):
        return None
    direction = null.T @ np.random.default_rng(seed).standard_normal(len(null))
    x = at.x.copy()
    x[free] += RANKS.motion * direction / np.linalg.norm(direction) * problem.nominal[: problem.nx][free]
    moved, mismatch = close(problem, replace(at, x=x), np.empty(0, int), positions=True)
    return moved if mismatch < RANKS.moved else None
