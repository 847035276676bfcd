"""Select an independent subset of the redundant constraints of closed loops.

Which subset is well conditioned depends on the position, and may be exchanged during a run. The motion does not depend on
it; the forces do, which are statically indeterminate: those of redundant constraints are 0.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np
import scipy

from acausal.compiler import CompiledModel
from acausal.compiler.constants import Constants
from acausal.compiler.memo import memoized
from acausal.policy import POLICY
from acausal.solve.coordinate_scaling import constraint_blocks
from acausal.solve.initialization.rank import pivots
from acausal.solve.initialization.sparse_rank import gram, least_singular_value
from acausal.solve.point import Point
from acausal.solve.problem import Problem
from acausal.solve.sparse_blocks import Block

RANKS = POLICY.ranks


@dataclass(frozen=True, eq=False)
class IndependentConstraints:
    """Independent constraints of closed loops, and their conditioning, at n points.

    Parameters
    ----------
    problem : Problem
        The model.
    times, x : arrays, shapes (n,), (n, nx)
        Times in s, and states.
    constants : Constants
        Those of the segment.
    """

    problem: Problem
    times: np.ndarray
    x: np.ndarray
    constants: Constants

    @classmethod
    def at(cls, problem: Problem, at: Point) -> IndependentConstraints:
        """Return those at one point."""
        return cls(problem, np.array([at.time]), at.x[None], at.constants)

    @cached_property
    def blocks(self) -> list[tuple[Block, np.ndarray, np.ndarray]]:
        """Blocks with masks of the independent and of the redundant rows among those of their lowest levels."""
        c = self.problem.compiled.constraints
        counts = c.counting(self.constants.closures)
        found = [
            (block, c.is_lowest[block.rows], counts[block.rows]) for block in constraint_blocks(self.problem.compiled)
        ]
        return [(block, low & on, low & ~on) for block, low, on in found if (low & on).any()]

    @cached_property
    def J(self) -> np.ndarray:
        """Jacobian, scaled by equation instead of row: in a singular configuration a single row may vanish."""
        c = self.problem.compiled.constraints
        J, _ = self.problem.scaled_entries(self.x, self.times, self.constants.vector)
        rows = c.entries[0]
        lengths = np.zeros((len(J), c.size))
        np.add.at(lengths.T, rows, J.T**2)
        most = np.zeros((len(J), int(np.max(c.kinds, initial=-1)) + 1))
        np.maximum.at(most.T, c.kinds, np.sqrt(lengths.T))
        return J / np.where(most > 0, most, 1.0)[:, c.kinds[rows]]

    @cached_property
    def smallest_singular_values(self) -> np.ndarray:
        """Smallest singular value of each block, shape (m, n), 0 in a singular configuration.

        With redundant constraints: the k-th largest of all rows, k the number of independent ones; in large blocks the
        smallest of the independent rows.
        """
        found = [_smallest(block, self.J, independent, redundant) for block, independent, redundant in self.blocks]
        return np.array(found).reshape(len(found), len(self.times))

    @cached_property
    def conditioning(self) -> np.ndarray:
        """How well the independent constraints determine the redundant ones, shape (n,): 1 is best, 0 is singular.

        Their smallest singular value over that of all, see `smallest_singular_values`; in large blocks, where the redundant
        rows are X times the independent ones, 1 / sqrt(1 + |X|^2).
        """
        found = np.ones(len(self.times))
        for k, (block, independent, redundant) in enumerate(self.blocks):
            if not redundant.any():
                continue
            if np.sum(independent) > RANKS.small:
                own = np.array([_spanning(block, self.J[place], independent, redundant) for place in range(len(found))])
            else:
                of_all = np.maximum(self.smallest_singular_values[k], np.finfo(float).tiny)
                own = _smallest(block, self.J, independent, np.zeros_like(redundant)) / of_all
            found = np.fmin(found, own)
        return found


def smallest_singular_value(problem: Problem, at: Point) -> float:
    """Return that of the constraints at a point: 0 in a singular configuration, inf without loops."""
    return (
        float(np.min(IndependentConstraints.at(problem, at).smallest_singular_values, initial=np.inf))
        if problem.compiled.constraints.size
        else np.inf
    )


def reselected(problem: Problem, at: Point) -> Constants:
    """Return the constants of a point, with another selection if the present one is ill conditioned; the same projection."""
    own = IndependentConstraints.at(problem, at)
    if at.constants.all_count or own.conditioning[0] >= POLICY.loops.fairly:
        return at.constants
    return selection(own)


def selection(own: IndependentConstraints) -> Constants:
    """Return constants with the selection by pivots at one point, of as many independent constraints as before."""
    compiled, constants = own.problem.compiled, own.constants
    closures = constants.closures.copy()
    for block, independent, redundant in own.blocks:
        if not redundant.any():
            continue
        rows = np.flatnonzero(independent | redundant)
        of = closure_of(compiled)[block.rows[rows]]
        weight = np.where(of >= 0, 1.0, RANKS.kept)
        order = pivots((weight[:, None] * block.dense(own.J[0])[rows]).T)
        closures[of[of >= 0]] = 1.0
        left = of[order[int(np.sum(independent)) :]]
        closures[left[left >= 0]] = 0.0
    return replace(constants, closures=closures)


@memoized
def may_be_redundant(compiled: CompiledModel) -> np.ndarray:
    """Closures that may be redundant: those whose flow does work."""
    return np.array([not closure.dual.is_constant() for closure in compiled.reduced.flat.loops.closures], dtype=bool)


@memoized
def closure_of(compiled: CompiledModel) -> np.ndarray:
    """Closure of each residual of the constraints, -1 if it must not be redundant."""
    c = compiled.constraints
    found = np.full(c.size, -1)
    for closure in np.flatnonzero(may_be_redundant(compiled)).tolist() if c.closures else ():
        found[list(c.rows[c.closures[closure]])] = closure
    return found


def _smallest(block: Block, J: np.ndarray, independent: np.ndarray, redundant: np.ndarray) -> np.ndarray:
    """Return the k-th largest singular value of rows of a block, k independent ones, to 1e-8: from A A' or A' A."""
    n = int(np.sum(independent))
    if n > RANKS.small:
        return np.array([least_singular_value(block.sparse(row)[independent]) for row in J])
    A = block.dense(J)[:, independent | redundant]
    turned = A.transpose(0, 2, 1)
    square = A @ turned if A.shape[1] <= A.shape[2] else turned @ A
    return np.sqrt(np.maximum(np.linalg.eigvalsh(square)[:, max(square.shape[1] - n, 0)], 0.0))


def _spanning(block: Block, J: np.ndarray, independent: np.ndarray, redundant: np.ndarray) -> float:
    """Return 1 / sqrt(1 + |X|^2) for redundant rows that are X times the independent ones; 0 if these are dependent."""
    rows = block.sparse(J)
    inverse = gram(rows[independent], RANKS.rank)
    if inverse is None:
        return 0.0
    X = inverse((rows[independent] @ rows[redundant].T).toarray())
    options = {"return_singular_vectors": False, "v0": np.cos(np.arange(min(X.shape))), "tol": POLICY.loops.angles}
    most = scipy.sparse.linalg.svds(X, 1, **options)[0] if min(X.shape) > 1 else np.linalg.norm(X)
    return float(1 / np.sqrt(1 + most**2))
