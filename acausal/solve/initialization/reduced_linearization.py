"""Rates and conditions at points with closed loops, and their Jacobians with the algebraic unknowns eliminated."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np
import scipy

from acausal.policy import POLICY
from acausal.solve.initialization.assembly import close, polished, tighten
from acausal.solve.initialization.coordinate_partitioning import choose_projection, partition_is_valid
from acausal.solve.initialization.equilibrium_test import counters, kinematic
from acausal.solve.initialization.newton import NoConvergence, algebraic
from acausal.solve.initialization.rank import factored
from acausal.solve.point import Point
from acausal.solve.problem import Problem


@dataclass(frozen=True, eq=False)
class ReducedLinearization:
    """Rates and conditions at a point, and their Jacobians by the states with the algebraic unknowns eliminated.

    Attributes
    ----------
    point : Point
        With consistent algebraic unknowns.
    value : array
        Rates, algebraic equations and conditions.
    J : csc_matrix
        Their Jacobian by states and algebraic unknowns.
    nominal : array
        Nominal values of these.
    """

    point: Point
    value: np.ndarray
    J: scipy.sparse.csc_matrix
    nominal: np.ndarray

    @property
    def nx(self) -> int:
        """Number of states."""
        return len(self.point.x)

    @property
    def rates(self) -> np.ndarray:
        """Derivatives of the states."""
        return self.value[: self.nx]

    @property
    def conditions(self) -> np.ndarray:
        """Residuals of the initial conditions."""
        return self.value[len(self.nominal) :]

    @cached_property
    def A(self) -> np.ndarray:
        """Jacobian of the rates by the states."""
        return self._eliminated(slice(0, self.nx))

    @cached_property
    def C(self) -> np.ndarray:
        """Jacobian of the conditions by the states."""
        return self._eliminated(slice(len(self.nominal), None))

    def adds_up(self, sizes: np.ndarray) -> np.ndarray:
        """Return the size of the terms in each row of A, for states of these sizes."""
        direct, through = (abs(self.J[: self.nx, own]) for own in (slice(0, self.nx), slice(self.nx, None)))
        return np.linalg.norm((direct.toarray() + through @ np.abs(self._follow)) * sizes, axis=1)

    def times(self, x: np.ndarray) -> np.ndarray:
        """Return A x by sparse factors."""
        nx, n = self.nx, len(self.nominal)
        follows = self._solve(-(self.J[nx:n, :nx] @ x)) if n > nx else np.zeros(0)
        return self.J[:nx] @ np.concatenate([x, follows])

    def implicit(self, h: float) -> Callable[[np.ndarray], tuple[np.ndarray, np.ndarray]]:
        """Return a solver of (I - h A) x = b by sparse factors, which gives changes of the algebraic unknowns as well.

        Raises
        ------
        RuntimeError
            If the matrix is singular.
        """
        nx, n = self.nx, len(self.nominal)
        weights = scipy.sparse.diags(np.where(np.arange(n) < nx, -h, 1.0))
        matrix = weights @ self.J[:n] + scipy.sparse.diags(np.where(np.arange(n) < nx, 1.0, 0.0))
        factors = scipy.sparse.linalg.splu(matrix.tocsc())

        def solve(right: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
            found = factors.solve(np.concatenate([right, np.zeros(n - nx)]))
            return found[:nx], found[nx:]

        return solve

    def follows(self, step: np.ndarray) -> np.ndarray:
        """Return the changes of the algebraic unknowns that follow a step of the states."""
        return self._follow @ step

    @cached_property
    def _solve(self) -> Callable[[np.ndarray], np.ndarray]:
        nx, n = self.nx, len(self.nominal)
        return factored(self.J[nx:n, nx:], self.nominal[nx:], POLICY.ranks.rank)

    @cached_property
    def _follow(self) -> np.ndarray:
        """Derivatives of the algebraic unknowns by the states."""
        nx, n = self.nx, len(self.nominal)
        if n == nx:
            return np.zeros((0, nx))
        return self._solve(-self.J[nx:n, :nx].toarray())

    def _eliminated(self, rows: slice) -> np.ndarray:
        nx = self.nx
        return self.J[rows, :nx].toarray() + self.J[rows, nx:] @ self._follow


class Linearizer:
    """Linearization near a guess.

    Parameters
    ----------
    problem : Problem
        The model.
    guess : Point
        A point with closed loops.
    space : array, shape (nx, k), optional
        Cyclic coordinates, to search for a steady rotation; see `steady_rotation.cyclic_spaces`.
    """

    def __init__(self, problem: Problem, guess: Point, space: np.ndarray | None = None) -> None:
        self.problem, self.guess = problem, guess
        self.rotates = space is not None
        self.space = np.zeros((problem.nx, 0)) if space is None else space
        compiled, self.nx = problem.compiled, problem.nx
        self.scale = problem.nominal[: self.nx]
        self.rows = np.setdiff1d(np.arange(self.nx), counters(compiled))
        pairs = [coordinate for coordinate, _ in problem.rates]
        self.coordinates = np.array(sorted({*pairs, *kinematic(compiled)}), dtype=int)
        self.still = self._still()

    def _still(self) -> scipy.sparse.csr_matrix:
        """Combinations of rates that vanish, one in each row: all but those of counters and cyclic coordinates."""
        turning = np.flatnonzero(np.any(self.space, axis=1))
        others = np.setdiff1d(self.rows, turning)
        single = scipy.sparse.identity(self.nx, format="csr")[others]
        if len(turning) == self.space.shape[1]:
            return single
        own = scipy.linalg.null_space(self.space[turning].T).T / self.scale[turning]
        across = scipy.sparse.lil_matrix((len(own), self.nx))
        across[:, turning] = own
        return scipy.sparse.vstack([single, across]).tocsr()

    def without_rotation(self, step: np.ndarray) -> np.ndarray:
        """Return a step without its part along cyclic coordinates."""
        return step - self.scale * (self.space @ (self.space.T @ (step / self.scale)))

    def linearized(self, at: Point) -> ReducedLinearization:
        """Solve for the algebraic unknowns, and linearise."""
        at = algebraic(self.problem, at)
        local = self.problem.local(at)
        if not (np.all(np.isfinite(local.value)) and np.all(np.isfinite(local.jacobian.data))):
            raise NoConvergence("the equations have no value there", at, 0.0)
        return ReducedLinearization(at, local.value, local.jacobian.tocsc(), self.problem.nominal)

    def closed(self, at: Point) -> Point:
        """Close the loops, and choose the coordinate partitioning again.

        Only dependent states move, if that closes the loops: moving stiff parts as well would add energy.
        """
        c, left = self.problem.compiled.constraints, np.inf
        if not c.size:
            return at
        closed = at
        if not at.constants.moves:
            held = np.setdiff1d(np.arange(self.nx), c.entries[1][at.constants.D != 0])
            quick = polished(self.problem, at, held)
            if quick is not None and self.far(quick.x - at.x) <= POLICY.rest.far:
                closed, left = quick, 0.0
            else:
                closed, left = close(self.problem, at, held)
        if left > POLICY.loops.closed:
            closed = tighten(self.problem, replace(at, constants=self.guess.constants))
        if closed.constants.moves or not partition_is_valid(self.problem, closed):
            closed = replace(closed, constants=choose_projection(self.problem, closed))
        return self.problem.completed(closed)

    def size(self, step: np.ndarray) -> float:
        """Largest change of a state in a step, in nominal values."""
        return float(np.max(np.abs(step) / self.scale, initial=0.0))

    def far(self, step: np.ndarray) -> float:
        """Largest change of a coordinate in a step, in nominal values: of states with a rate among the states or kinematic."""
        return float(np.max(np.abs(step / self.scale)[self.coordinates], initial=0.0))


def moved(at: Point, step: np.ndarray, follows: np.ndarray | float = 0.0) -> Point:
    """Return the point after a step of the states, and of the algebraic unknowns as guesses for these."""
    return replace(at, x=at.x + step, z=at.z + follows)
