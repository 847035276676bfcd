"""Which constraints of closed loops are kept, of some that follow from one another.

Which of them follow from the others changes with the position: what is kept becomes unfit where the others do not follow from
it, and others are kept from there on. The motion is the same; forces that are not determined are 0 elsewhere then.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np
import scipy

from acausal.compiler import CompiledModel
from acausal.compiler.constants import Constants
from acausal.compiler.once import once
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
    """Constraints of closed loops at n points, block by block.

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
        """Return them at one point."""
        return cls(problem, np.array([at.time]), at.x[None], at.constants)

    @cached_property
    def blocks(self) -> list[tuple[Block, np.ndarray, np.ndarray]]:
        """Those of which some are kept, with which rows at their lowest levels are, and which are not."""
        c = self.problem.compiled.constraints
        counts = c.counting(self.constants.closures)
        found = [
            (block, c.is_lowest[block.rows], counts[block.rows]) for block in constraint_blocks(self.problem.compiled)
        ]
        return [(block, low & on, low & ~on) for block, low, on in found if (low & on).any()]

    @cached_property
    def J(self) -> np.ndarray:
        """Their Jacobian, over the size of each equation: in a flat position a row may vanish by itself."""
        c = self.problem.compiled.constraints
        held, _ = self.problem.scaled_jacobians(self.x, self.times, self.constants.vector)
        rows = c.entries[0]
        lengths = np.zeros((len(held), c.size))
        np.add.at(lengths.T, rows, held.T**2)
        most = np.zeros((len(held), int(np.max(c.kinds, initial=-1)) + 1))
        np.maximum.at(most.T, c.kinds, np.sqrt(lengths.T))
        return held / np.where(most > 0, most, 1.0)[:, c.kinds[rows]]

    @cached_property
    def smallest_singular_values(self) -> np.ndarray:
        """Smallest singular value of each block, 0 in a flat position, shape (m, n).

        Of constraints that follow from one another it is that of all, of as many as are kept: the least that is not 0
        elsewhere; in large mechanisms that of the kept ones.
        """
        found = [_smallest(block, self.J, on, spare) for block, on, spare in self.blocks]
        return np.array(found).reshape(len(found), len(self.times))

    @cached_property
    def conditioning(self) -> np.ndarray:
        """How well the constraints that are kept hold the others: 1 is best, 0 is not at all; shape (n,).

        It is the smallest singular value of the kept ones over that of all, see `sharpness`, or in large mechanisms, where the
        others are X times the kept ones, 1 / sqrt(1 + |X|^2).
        """
        found = np.ones(len(self.times))
        for k, (block, on, spare) in enumerate(self.blocks):
            if not spare.any():
                continue
            if np.sum(on) > RANKS.small:
                own = np.array([_spanning(block, self.J[place], on, spare) for place in range(len(found))])
            else:
                of_all = np.maximum(self.smallest_singular_values[k], np.finfo(float).tiny)
                own = _smallest(block, self.J, on, np.zeros_like(spare)) / of_all
            found = np.fmin(found, own)
        return found


def smallest_singular_value(problem: Problem, at: Point) -> float:
    """Return the smallest singular value of the constraints at a point, 0 in a flat position, inf without loops."""
    return (
        float(np.min(IndependentConstraints.at(problem, at).smallest_singular_values, initial=np.inf))
        if problem.compiled.constraints.size
        else np.inf
    )


def reselected(problem: Problem, at: Point) -> Constants:
    """Return the constants of a point, with others of the constraints kept where those that are hold the others hardly.

    The projection is that of before.
    """
    held = IndependentConstraints.at(problem, at)
    if at.constants.all_count or held.conditioning[0] >= POLICY.loops.fairly:
        return at.constants
    return selection(held)


def selection(held: IndependentConstraints) -> Constants:
    """Return constants with which as many constraints are kept at one point as before, those that hold the others best."""
    compiled, constants = held.problem.compiled, held.constants
    closures = constants.closures.copy()
    for block, on, spare in held.blocks:
        if not spare.any():
            continue
        rows = np.flatnonzero(on | spare)
        own = closure_of(compiled)[block.rows[rows]]
        weight = np.where(own >= 0, 1.0, RANKS.kept)
        order = pivots((weight[:, None] * block.dense(held.J[0])[rows]).T)
        closures[own[own >= 0]] = 1.0
        left = own[order[int(np.sum(on)) :]]
        closures[left[left >= 0]] = 0.0
    return replace(constants, closures=closures)


@once
def may_be_redundant(compiled: CompiledModel) -> np.ndarray:
    """Which closures may be dropped: those on which a flow works."""
    return np.array([not closure.dual.is_constant() for closure in compiled.reduced.flat.loops.closures], dtype=bool)


@once
def closure_of(compiled: CompiledModel) -> np.ndarray:
    """Closure of each residual of the constraints, -1 where none may be dropped."""
    c = compiled.constraints
    found = np.full(c.size, -1)
    for closure in np.flatnonzero(may_be_redundant(compiled)).tolist() if c.closures else ():
        found[list(c.rows[c.closures[closure]])] = closure
    return found


def _smallest(block: Block, held: np.ndarray, on: np.ndarray, spare: np.ndarray) -> np.ndarray:
    """Least of as many singular values of rows of a block as are kept, to 1e-8: roots of eigenvalues of A A', or of A' A."""
    n = int(np.sum(on))
    if n > RANKS.small:
        return np.array([least_singular_value(block.sparse(row)[on]) for row in held])
    A = block.dense(held)[:, on | spare]
    turned = A.transpose(0, 2, 1)
    square = A @ turned if A.shape[1] <= A.shape[2] else turned @ A
    return np.sqrt(np.maximum(np.linalg.eigvalsh(square)[:, max(square.shape[1] - n, 0)], 0.0))


def _spanning(block: Block, held: np.ndarray, on: np.ndarray, spare: np.ndarray) -> float:
    """Of many rows: 1 / sqrt(1 + |X|^2), where the others are X times the kept ones; 0 where these are not independent."""
    rows = block.sparse(held)
    inverse = gram(rows[on], RANKS.rank)
    if inverse is None:
        return 0.0
    X = inverse((rows[on] @ rows[spare].T).toarray())
    options = {"return_singular_vectors": False, "v0": np.cos(np.arange(min(X.shape))), "tol": POLICY.loops.angles}
    most = scipy.sparse.linalg.svds(X, 1, **options)[0] if min(X.shape) > 1 else np.linalg.norm(X)
    return float(1 / np.sqrt(1 + most**2))
