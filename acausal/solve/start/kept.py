"""Which constraints of closed loops are kept, of some that follow from one another.

Which of them follow from the others changes with the position: what is kept becomes unfit where the others do not follow from
it, and others are kept from there on. The motion is the same; forces that are not determined are 0 elsewhere then.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import scipy

from acausal.compiler import CompiledModel
from acausal.compiler.constants import Constants
from acausal.compiler.once import once
from acausal.policy import POLICY
from acausal.solve.points import Point, Rows
from acausal.solve.problem import Problem
from acausal.solve.start.parts import Part
from acausal.solve.start.rank import pivots
from acausal.solve.start.reach import held_in_sizes, levels_of
from acausal.solve.start.regular import gram, least_singular_value

RANKS = POLICY.ranks


def sharpness(problem: Problem, times: np.ndarray, x: np.ndarray, constants: Constants) -> np.ndarray:
    """Smallest singular value of the constraints of each part, 0 in a flat position, at n points: shape (m, n).

    Of constraints that follow from one another it is that of all, of as many as are kept: the least that is not 0 elsewhere;
    in large mechanisms that of the kept ones.

    Parameters
    ----------
    problem : Problem
        The model.
    times, x : arrays, shapes (n,), (n, nx)
        Times in s, and states.
    constants : Constants
        Those of the segment.
    """
    held = _in_sizes(problem, times, x, constants)
    found = [_smallest(part, held, on, spare) for part, on, spare in _rows(problem, constants) if on.any()]
    return np.array(found).reshape(len(found), len(times))


def fitness(problem: Problem, times: np.ndarray, x: np.ndarray, constants: Constants) -> np.ndarray:
    """How well the constraints that are kept hold the others, at n points: 1 is best, 0 is not at all; shape (n,).

    It is the smallest singular value of the kept ones over that of all, see `sharpness`, or in large mechanisms, where the
    others are X times the kept ones, 1 / sqrt(1 + |X|^2).
    """
    found, spared = np.ones(len(times)), [rows for rows in _rows(problem, constants) if rows[2].any() and rows[1].any()]
    held = _in_sizes(problem, times, x, constants) if spared else found
    for part, on, spare in spared:
        if np.sum(on) > RANKS.small:
            own = np.array([_spanning(part, held[k], on, spare) for k in range(len(held))])
        else:
            own, all_ = (_smallest(part, held, on, others) for others in (np.zeros_like(spare), spare))
            own = own / np.maximum(all_, np.finfo(float).tiny)
        found = np.fmin(found, own)
    return found


def refitted(problem: Problem, at: Point) -> Constants:
    """Return the constants of a point, with others of the constraints kept where those that are hold the others hardly.

    The projection is that of before.
    """
    rows, constants = Rows.of(at), at.constants
    if constants.all_count or fitness(problem, rows.times, rows.x, constants)[0] >= POLICY.loops.fairly:
        return constants
    return kept_again(problem, rows, constants)


def kept_again(problem: Problem, at: Rows, constants: Constants) -> Constants:
    """Return constants with which as many constraints are kept at one point as before, those that hold the others best."""
    closures, closure_of = constants.closures.copy(), _closure_of(problem.compiled)
    held = _in_sizes(problem, at.times, at.x, constants)[0]
    for part, on, spare in _rows(problem, constants):
        if not spare.any():
            continue
        rows = np.flatnonzero(on | spare)
        own = closure_of[part.rows[rows]]
        weight = np.where(droppable(problem.compiled)[own] & (own >= 0), 1.0, RANKS.kept)
        order = pivots((weight[:, None] * part.dense(held)[rows]).T)
        closures[own[own >= 0]] = 1.0
        left = own[order[int(np.sum(on)) :]]
        closures[left[left >= 0]] = 0.0
    return replace(constants, closures=closures)


@once
def droppable(compiled: CompiledModel) -> np.ndarray:
    """Which closures may be dropped: those on which a flow works."""
    return np.array([not closure.dual.is_constant() for closure in compiled.reduced.flat.loops.closures], dtype=bool)


@once
def _closure_of(compiled: CompiledModel) -> np.ndarray:
    """Closure of each residual of the constraints that is the lowest one of a closure, -1 for others."""
    c = compiled.constraints
    found = np.full(c.size, -1)
    found[c.lowest[c.closures]] = np.arange(len(c.closures))
    return found


def _rows(problem: Problem, constants: Constants) -> list[tuple[Part, np.ndarray, np.ndarray]]:
    """Parts of the constraints, with which rows at their lowest levels are kept, and which are not."""
    c = problem.compiled.constraints
    counts = c.counting(constants.closures)
    return [
        (part, c.is_lowest[part.rows] & counts[part.rows], c.is_lowest[part.rows] & ~counts[part.rows])
        for part in levels_of(problem.compiled)
    ]


def _smallest(part: Part, held: np.ndarray, on: np.ndarray, spare: np.ndarray) -> np.ndarray:
    """Least of as many singular values of rows of a part as are kept, to 1e-8: roots of eigenvalues of A A', or of A' A."""
    n = int(np.sum(on))
    if n > RANKS.small:
        return np.array([least_singular_value(part.sparse(row)[on]) for row in held])
    A = part.dense(held)[:, on | spare]
    turned = A.transpose(0, 2, 1)
    square = A @ turned if A.shape[1] <= A.shape[2] else turned @ A
    return np.sqrt(np.maximum(np.linalg.eigvalsh(square)[:, max(square.shape[1] - n, 0)], 0.0))


def _spanning(part: Part, held: np.ndarray, on: np.ndarray, spare: np.ndarray) -> float:
    """Of many rows: 1 / sqrt(1 + |X|^2), where the others are X times the kept ones; 0 where these are not independent."""
    rows = part.sparse(held)
    inverse = gram(rows[on], RANKS.rank)
    if inverse is None:
        return 0.0
    X = inverse((rows[on] @ rows[spare].T).toarray())
    options = {"return_singular_vectors": False, "v0": np.cos(np.arange(min(X.shape))), "tol": POLICY.loops.angles}
    most = scipy.sparse.linalg.svds(X, 1, **options)[0] if min(X.shape) > 1 else np.linalg.norm(X)
    return float(1 / np.sqrt(1 + most**2))


def _in_sizes(problem: Problem, times: np.ndarray, x: np.ndarray, constants: Constants) -> np.ndarray:
    """Jacobian of the constraints at n points, over the size of each equation: in a flat position a row may vanish by itself."""
    c = problem.compiled.constraints
    held, _ = held_in_sizes(problem, x, times, constants.vector)
    rows = c.entries[0]
    lengths = np.zeros((len(held), c.size))
    np.add.at(lengths.T, rows, held.T**2)
    most = np.zeros((len(held), int(np.max(c.kinds, initial=-1)) + 1))
    np.maximum.at(most.T, c.kinds, np.sqrt(lengths.T))
    return held / np.where(most > 0, most, 1.0)[:, c.kinds[rows]]
