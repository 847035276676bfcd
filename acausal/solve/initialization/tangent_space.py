"""Tangent space of the constraints, and elimination of algebraic unknowns from Jacobians."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
import scipy

from acausal.compiler import CompiledModel
from acausal.compiler.memo import memoized
from acausal.policy import POLICY
from acausal.solve.initialization.rank import null_space, pivots
from acausal.solve.point import Point
from acausal.solve.problem import Problem
from acausal.solve.sparse_blocks import Block, Places, block_of

# Right-hand sides in one call of a sparse solver.
AT_ONCE = 64


def tangent(problem: Problem, at: Point) -> tuple[np.ndarray, np.ndarray]:
    """Choose independent states and a basis of the tangent space in which their changes are unit vectors.

    Returns
    -------
    N : array, shape (nx, n)
        Changes of all states for a unit change of each independent one, tangent to all constraints.
    independent : array of int, shape (n,)
        The independent states, independent by pivots, coordinates with their rates.
    """
    if not problem.compiled.constraints.size:
        return np.eye(problem.nx), np.arange(problem.nx)
    J, size = problem.scaled_gradients(at), problem.loop_scales
    null = null_space(J)
    rate_of = dict(problem.rates)
    # States without constraints come first, then coordinates before their rates.
    weight = np.full(problem.nx, POLICY.ranks.unheld)
    weight[np.repeat(np.arange(problem.nx), np.diff(J.indptr))[J.data != 0]] = 1.0
    weight[[k for k in rate_of if weight[k] == 1.0]] = POLICY.ranks.coordinate
    order = pivots(null * weight)
    first = [k for k in order[: len(null)] if k not in rate_of.values()]
    paired = np.array(sorted({*first, *(rate_of[k] for k in first if k in rate_of)}), dtype=int)
    independent = np.sort(order[: len(null)])
    if len(paired) == len(null) and not np.array_equal(paired, independent):
        independent = paired if np.linalg.matrix_rank(null[:, paired]) == len(null) else independent
    return size[:, None] * np.linalg.solve(null[:, independent], null).T / size[independent], independent


@dataclass(frozen=True)
class Elimination:
    """Schur complement: some rows and columns of a Jacobian with the algebraic unknowns eliminated.

    Attributes
    ----------
    own, through, equations, inner : Block
        The rows by the columns and by the algebraic unknowns, and the algebraic equations by both.
    """

    own: Block
    through: Block
    equations: Block
    inner: Block

    @classmethod
    def of(cls, J: scipy.sparse.csc_matrix, rows: Places, columns: Places, alg: Places, z: Places) -> Elimination:
        """Return that of all matrices of one pattern; `alg` are algebraic equations, `z` algebraic unknowns."""
        return cls(block_of(J, rows, columns), block_of(J, rows, z), block_of(J, alg, columns), block_of(J, alg, z))

    def matrix(self, entries: np.ndarray) -> np.ndarray:
        """Return J_rx - J_rz J_az^-1 J_ax, dense, from the entries of the Jacobian."""
        own = self.own.dense(entries)
        if not self.inner.rows.size:
            return own
        return own - self.through.sparse(entries) @ self._solve(entries)(self.equations.dense(entries))

    def diagonal(self, entries: np.ndarray) -> np.ndarray:
        """Return the diagonal of `matrix`, some columns at a time."""
        found = np.zeros(len(self.own.rows))
        on = self.own.places[0] == self.own.places[1]
        found[self.own.places[0, on]] = entries[self.own.entries[on]]
        if not self.inner.rows.size:
            return found
        solve, right = self._solve(entries), self.equations.sparse(entries)
        (row, column), values = self.through.places, entries[self.through.entries]
        for first in range(0, len(found), AT_ONCE):
            here = found[first : first + AT_ONCE]
            dz = solve(right[:, first : first + len(here)].toarray())
            some = (row >= first) & (row < first + len(here))
            terms = values[some] * dz[column[some], row[some] - first]
            here -= np.bincount(row[some] - first, terms, minlength=len(here))
        return found

    def _solve(self, entries: np.ndarray) -> Callable[[np.ndarray], np.ndarray]:
        return scipy.sparse.linalg.splu(self.inner.sparse(entries)).solve


@memoized
def of_states(compiled: CompiledModel) -> Elimination:
    """Elimination that leaves the state matrix A = f_x - f_z g_z^-1 g_x."""
    x, z = np.split(np.arange(compiled.nx + compiled.nz), [compiled.nx])
    return Elimination.of(compiled.pattern, x, x, z, z)
