"""Coordinate partitioning of closed loops (Wehage and Haug 1982), or projection directions, from constraint Jacobians."""

from __future__ import annotations

from contextlib import suppress
from dataclasses import replace

import numpy as np
import scipy

from acausal.compiler import CompiledModel
from acausal.compiler.constants import Constants
from acausal.compiler.memo import memoized
from acausal.policy import POLICY
from acausal.solve.coordinate_scaling import constraint_blocks
from acausal.solve.initialization.rank import columns_by_pivots, pivots
from acausal.solve.initialization.tangent_space import Elimination
from acausal.solve.point import Point, Rows
from acausal.solve.problem import Problem
from acausal.solve.sparse_blocks import Block

LOOPS, SMALL = POLICY.loops, POLICY.ranks.small

# Row spaces, by block and by the mask of its rows.
Spaces = dict[tuple[Block, bytes], np.ndarray]


def choose_projection(problem: Problem, at: Point, spare: bool = True, moves: bool = False) -> Constants:
    """Return the constants of a segment with a new choice of D at a consistent point.

    Parameters
    ----------
    problem : Problem
        The model.
    at : Point
        A consistent point, with the constants of the last segment.
    spare : bool
        Whether stiff coordinates move less; this needs consistent algebraic unknowns.
    moves : bool
        False for coordinate partitioning, True for projection along the current constraint Jacobian.
    """
    moving = _moving(problem, at, spare)
    return moving if moves else partitioned(problem, replace(at, constants=moving))


def partitioned(problem: Problem, at: Point) -> Constants:
    """Return the constants of a coordinate partitioning at a point whose projection moves."""
    c = problem.compiled.constraints
    J, sizes = _jacobians(problem, Rows.of(at), at.constants)
    D = J[0] * at.constants.D / sizes**2
    selection = _select(constraint_blocks(problem.compiled), D, c.counting(at.constants.closures))
    return replace(at.constants, moves=False, D=selection * sizes)


def _moving(problem: Problem, at: Point, spare: bool) -> Constants:
    c = problem.compiled.constraints
    rows, columns = c.entries
    on = c.counting(at.constants.closures)
    # The least scaled change of the states that reaches the constraints is along J' over the squares of their scales.
    J, sizes = _jacobians(problem, Rows.of(at), at.constants)
    J = J[0] * on[rows]
    stiffness = _stiffness(problem, at) if spare else np.zeros(problem.nx)
    weights = _weights(constraint_blocks(problem.compiled), J, stiffness[columns], problem.feedback)
    length = np.sqrt(np.bincount(rows, (J * weights) ** 2, minlength=c.size))
    length = np.where(length > 0, length, 1.0)[rows]
    return replace(at.constants, moves=True, D=on[rows] * weights * sizes**2 / length)


@np.errstate(all="ignore")
def closing_scales(problem: Problem, at: Point) -> np.ndarray:
    """Return scales of the states for closing loops, shape (nx,): small for stiff ones, if the others suffice to close them.

    Parameters
    ----------
    problem : Problem
        The model.
    at : Point
        A consistent point.
    """
    c, sizes = problem.compiled.constraints, problem.loop_scales.copy()
    rows, columns = c.entries
    J = _jacobians(problem, Rows.of(at), at.constants)[0][0] * c.counting(at.constants.closures)[rows]
    stiffness = _stiffness(problem, at)[columns]
    largest = float(np.max(stiffness, initial=0.0))
    for threshold in largest * 10.0 ** -np.arange(LOOPS.decades, -1, -1):
        soft = J * (stiffness <= threshold)
        closes = np.array_equal(np.unique(rows[soft != 0]), np.unique(rows[J != 0]))
        if closes and _transversality(constraint_blocks(problem.compiled), J[None], soft)[0] >= LOOPS.worn:
            sizes[columns[stiffness > LOOPS.stiffer * threshold]] *= LOOPS.stiff
            break
    return sizes


@np.errstate(all="ignore")
def independent_states(problem: Problem, at: Point) -> tuple[str, ...]:
    """Names of the independent states, at a point with the projection that moves."""
    follows = set(problem.compiled.constraints.entries[1][partitioned(problem, at).D != 0].tolist())
    return tuple(name for k, name in enumerate(problem.compiled.states) if k not in follows)


def _stiffness(problem: Problem, at: Point) -> np.ndarray:
    """Stiffness of each coordinate, |d der(rate) / d coordinate| in 1/s2, the same for its rate.

    Without the projection: constraints at all levels but the highest, and their multipliers, are left out.
    """
    left = _unprojected(problem.compiled)
    rates, coordinates = left.own.rows, left.own.columns
    stiffness = np.zeros(problem.nx)
    with suppress(RuntimeError):  # singular: no coordinate counts as stiff
        slopes = left.diagonal(problem.local(at).entries)
        stiffness[coordinates] = stiffness[rates] = np.abs(slopes)
    return stiffness


@memoized
def _unprojected(compiled: CompiledModel) -> Elimination:
    """Elimination that leaves the derivatives of the rates by their coordinates, see `_stiffness`."""
    plan, c, nx = compiled.reduced.plan, compiled.constraints, compiled.nx
    lower = {row for constraint in plan.constrained.constraints for row in constraint.rows}
    equations = [nx + k for k, e in enumerate(plan.residuals) if e not in lower]
    unknowns = np.setdiff1d(np.arange(nx, nx + compiled.nz), nx + c.multipliers)
    place = {v: k for k, v in enumerate(plan.states)}
    of = {q.coordinate: place[q.state] for q in plan.constrained.projections}
    pairs = [(of[q.coordinate], of[q.rate]) for q in plan.constrained.projections if q.rate in of]
    coordinates, rates = np.array(pairs, dtype=int).reshape(-1, 2).T
    return Elimination.of(compiled.pattern, rates, coordinates, equations, unknowns)


def _select(levels: list[Block], D: np.ndarray, on: np.ndarray) -> np.ndarray:
    """Unit vectors in place of the rows of D: one dependent coordinate for each constraint, by pivots and matching."""
    selection, follows = np.zeros(len(D)), np.full(len(on), -1)
    rows, columns, sizes = (np.concatenate(k) for k in zip(*(_candidates(p, D, on) for p in levels), strict=True))
    if not rows.size:
        return selection
    (row_of, row), (column_of, column) = (np.unique(k, return_inverse=True) for k in (rows, columns))
    # A weight of 0 would not be a matrix entry. Sums of multiples of the grid are exact; with round-off the matching may cycle.
    weights = np.ceil((1 - np.log(sizes)) / LOOPS.grid) * LOOPS.grid
    weight = scipy.sparse.csr_matrix((weights, (row, column)))
    pairs = scipy.sparse.csgraph.min_weight_full_bipartite_matching(weight)
    follows[row_of[pairs[0]]] = column_of[pairs[1]]
    for block in levels:
        selection[block.entries] = follows[block.rows[block.places[0]]] == block.columns[block.places[1]]
    return selection


def _candidates(block: Block, D: np.ndarray, on: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Rows of a block, as many coordinates by pivots, and the magnitudes of their entries: the edges of the matching."""
    active = np.flatnonzero(on[block.rows])[: len(block.columns)]
    if len(active) > SMALL:
        matrix = block.sparse(D)[active]
        order = columns_by_pivots(matrix)
        size = abs(matrix[:, order]).tocoo()
        size.eliminate_zeros()
        row, column, sizes = size.row, size.col, size.data
    else:
        matrix = block.dense(D)[active]
        order = pivots(matrix)[: len(active)] if active.size else np.zeros(0, dtype=int)
        row, column = (k.ravel() for k in np.indices((len(active), len(order))))
        # A singular block has a matching, too.
        sizes = np.maximum(np.abs(matrix[row, order[column]]), np.finfo(float).tiny)
    return block.rows[active[row]], block.columns[order[column]], sizes


def _weights(levels: list[Block], J: np.ndarray, stiffness: np.ndarray, feedback: float) -> np.ndarray:
    """Weights of the coordinates: stiff ones, whose motion costs energy, move as little as transversality allows.

    Weights fall with the stiffness above a threshold, the lowest for which the projection is transversal enough.
    """
    known: Spaces = {}
    threshold = max(float(np.square(feedback)), np.finfo(float).tiny)  # in runs over 1e163 s the square underflows
    for decade in range(1, LOOPS.decades + 1) if np.any(stiffness) else ():
        weights = 1 / (1 + stiffness / (10.0**decade * threshold))
        if _transversality(levels, J[None], J * weights, known)[0] >= LOOPS.spared:
            return weights
    return np.ones(len(stiffness))


def _transversality(levels: list[Block], J: np.ndarray, D: np.ndarray, known: Spaces | None = None) -> np.ndarray:
    """Cosine of the largest angle between the row spaces of J, shape (n, entries), and D: 1 is best, 0 is singular.

    `known` stores the row spaces of J for the next D.
    """
    least, known = np.ones(len(J)), {} if known is None else known
    for block in levels:
        chosen = block.dense(D)
        on = np.linalg.norm(chosen, axis=1) > 0
        if not on.any():
            continue
        if len(on) > SMALL:
            to = block.sparse(D)[on]
            found = np.array([1 / _projector_norm(block.sparse(row)[on], to) for row in J])
        else:
            if (block, rows := on.tobytes()) not in known:
                known[block, rows] = _basis(block.dense(J)[..., on, :])
            found = np.linalg.svd(np.swapaxes(known[block, rows], -1, -2) @ _basis(chosen[on]), compute_uv=False)[
                ..., -1
            ]
        least = np.fmin(least, found)
    return least


def _basis(rows: np.ndarray) -> np.ndarray:
    """Orthonormal columns that span a row space."""
    return np.linalg.qr(np.swapaxes(rows, -1, -2))[0]


def _projector_norm(J: scipy.sparse.csc_matrix, D: scipy.sparse.csc_matrix) -> float:
    """Norm of the projector D'(J D')^-1 J along the surface of J: one over the cosine of the angle (Szyld 2006)."""
    try:
        inner = scipy.sparse.linalg.splu((J @ D.T).tocsc())
    except RuntimeError:
        return np.inf
    n = J.shape[1]

    def forward(v: np.ndarray) -> np.ndarray:
        return D.T @ inner.solve(J @ v)

    def adjoint(v: np.ndarray) -> np.ndarray:
        return J.T @ inner.solve(D @ v, "T")

    projector = scipy.sparse.linalg.LinearOperator((n, n), matvec=forward, rmatvec=adjoint, dtype=float)
    options = {"return_singular_vectors": False, "v0": np.cos(np.arange(n)), "tol": LOOPS.angles}
    return float(scipy.sparse.linalg.svds(projector, 1, **options)[0])


def projection_cosine(problem: Problem, rows: Rows, constants: Constants) -> np.ndarray:
    """Return the transversality of the partitioning of a segment at n positions: 1 is best, 0 is singular.

    Parameters
    ----------
    problem : Problem
        The model.
    rows : Rows
        Positions of the segment.
    constants : Constants
        Those of the segment.
    """
    J, sizes = _jacobians(problem, rows, constants)
    return _transversality(constraint_blocks(problem.compiled), J, constants.D / sizes)


def partition_is_valid(problem: Problem, at: Point) -> bool:
    """Return whether the partitioning of a point is still transversal enough there."""
    return bool(projection_cosine(problem, Rows.of(at), at.constants)[0] >= least_cosine(problem))


def projection_is_valid(problem: Problem, at: Point) -> bool:
    """Return whether the projection of a point is one that moves, and is transversal enough there."""
    if not at.constants.moves:
        return False
    J, sizes = _jacobians(problem, Rows.of(at), at.constants)
    D = J[0] * at.constants.D / sizes**2
    return bool(_transversality(constraint_blocks(problem.compiled), J, D)[0] >= least_cosine(problem))


def _jacobians(problem: Problem, rows: Rows, constants: Constants) -> tuple[np.ndarray, np.ndarray]:
    """Scaled constraint Jacobians and the scales of the states, in the order of `Constraints.entries`."""
    return problem.scaled_entries(rows.x, rows.times, constants.vector)


def least_cosine(problem: Problem) -> float:
    """Smallest acceptable cosine between constraints and projection; at best it is 1/sqrt(n), if n coordinates move equally."""
    return min(LOOPS.worn, LOOPS.fit / problem.nx**0.5)
