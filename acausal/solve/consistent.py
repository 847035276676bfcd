"""Algebraic unknowns that satisfy their equations to rounding, for given states at many times at once.

An integrator controls the error of states only: algebraic unknowns between its steps may be far off. They are solved
for again, with one factorisation for as many times as it serves (simplified Newton iteration, Deuflhard 2004, 2.1).
"""

from __future__ import annotations

from collections.abc import Iterable

import numpy as np
from scipy.sparse.linalg import splu

from acausal.compiler import CompiledModel
from acausal.errors import InitializationError
from acausal.solve.initialize import algebraic
from acausal.solve.newton import TERMS

# Times in one call; a group that one factorisation does not serve is split into so many.
AT_ONCE, SPLIT = 32, 8
# A factorisation serves as long as each iteration gains that factor: slower ones cost more than a new one.
GAIN, ITERATIONS = 0.2, 20
# Relative change below which an iteration that gains no more has reached rounding.
SETTLED = 1e-8


class Consistent:
    """Solver for algebraic unknowns at given states.

    Parameters
    ----------
    compiled : CompiledModel
        The model.
    p : array
        Parameter values.

    Attributes
    ----------
    evaluations : int
        Evaluations of the equations so far, one for each time.
    unsolved : list of float
        Times at which no solution was found; what was given stays there.
    """

    def __init__(self, compiled: CompiledModel, p: np.ndarray) -> None:
        self.compiled, self.p = compiled, p
        self.evaluations = 0
        self.unsolved: list[float] = []

    def __call__(
        self,
        x: np.ndarray,
        z: np.ndarray,
        t: np.ndarray,
        modes: np.ndarray,
        wanted: Iterable[int] | None = None,
    ) -> np.ndarray:
        """Return algebraic unknowns for which their equations hold.

        Parameters
        ----------
        x, z : arrays, shapes (n, nx), (n, nz)
            States, and algebraic unknowns nearly right.
        t : array, shape (n,)
            Times in s.
        modes : array, shape (n, m)
            Constants of the segment of each time.
        wanted : iterable of int, optional
            Unknowns that must be right, with all that they need; all if not given.
        """
        c = self.compiled
        unknowns, equations = c.dependence.closure(range(c.nz) if wanted is None else wanted)
        if not unknowns.size or not len(t):
            return z
        group = _Group(self, x, z.copy(), t, modes, unknowns, equations + c.nx)
        todo = [np.arange(len(t))]
        while todo:
            rows = todo.pop()
            left = group.iterate(rows)
            if len(rows) > 1:
                todo += [part for part in np.array_split(left, min(SPLIT, len(left) or 1)) if part.size]
            elif left.size and not group.alone(int(left[0])):
                self.unsolved.append(float(t[left[0]]))
        return group.z

    def rates(self, x: np.ndarray, z: np.ndarray, t: np.ndarray, modes: np.ndarray) -> np.ndarray:
        """Return the derivatives of the states, shape (n, nx)."""
        return self.values(x, z, t, modes)[:, : self.compiled.nx]

    def values(self, x: np.ndarray, z: np.ndarray, t: np.ndarray, modes: np.ndarray) -> np.ndarray:
        """Return derivatives of the states, then residuals, a row for each of n times."""
        n, c = len(t), self.compiled
        self.evaluations += n
        size = AT_ONCE if n > 1 else 1
        call, found = c.many(size), np.empty((n, c.nx + c.nz))
        for first in range(0, n, size):
            some = np.minimum(np.arange(first, first + size), n - 1)
            given = (x[some], z[some], np.tile(self.p, size), t[some], modes[some])
            for array, value in zip(call.inputs, given, strict=False):
                array[:] = value.ravel()
            call.evaluate()
            found[first : first + size] = call.outputs[0].reshape(size, -1)[: n - first, : c.nx + c.nz]
        return found

    def holds(self, x: np.ndarray, z: np.ndarray, t: float, modes: np.ndarray, tolerance: float) -> bool:
        """Whether all algebraic equations hold at one time, relative to the largest of their terms."""
        c = self.compiled
        local = c.at(x, z, self.p, t, modes, 0.0)
        rows = slice(c.nx, c.nx + c.nz)
        terms = np.abs(local.jacobian[rows]).multiply(np.abs(np.concatenate([x, z]))).max(axis=1).toarray().ravel()
        return bool(np.all(np.abs(local.value[rows]) <= tolerance * (1 + terms)))


class _Group:
    """One task: times, what is solved for, and how far it is."""

    def __init__(
        self,
        solver: Consistent,
        x: np.ndarray,
        z: np.ndarray,
        t: np.ndarray,
        modes: np.ndarray,
        unknowns: np.ndarray,
        equations: np.ndarray,
    ) -> None:
        self.solver, self.x, self.z, self.t, self.modes = solver, x, z, t, modes
        self.unknowns, self.equations = unknowns, equations
        # What is 0 but for rounding never settles by this measure; its residuals tell then.
        self.size = np.max(np.abs(z[:, unknowns]), axis=0)
        self.size[self.size == 0] = 1.0

    def residual(self, rows: np.ndarray) -> np.ndarray:
        """Residuals at some times, shape (len(rows), equations)."""
        return self.solver.values(self.x[rows], self.z[rows], self.t[rows], self.modes[rows])[:, self.equations]

    def iterate(self, rows: np.ndarray) -> np.ndarray:
        """Iterate with the factorisation at the middle of some times; return the times that it does not serve."""
        c, middle = self.solver.compiled, rows[len(rows) // 2]
        first = self.z[rows].copy()
        J = c.at(self.x[middle], self.z[middle], self.solver.p, self.t[middle], self.modes[middle], 0.0).jacobian
        J = J[self.equations]
        try:
            solve = splu(J[:, c.nx + self.unknowns].tocsc()).solve
        except (RuntimeError, ValueError):
            return rows
        active, before, left = np.arange(len(rows)), np.full(len(rows), np.inf), []
        for _ in range(ITERATIONS):
            value = self.residual(rows[active])
            step = solve(value.T).T
            change = np.max(np.abs(step) / self.size, axis=1)
            gains = change <= GAIN * before[active]
            settled = ~gains & (change <= SETTLED)
            doubtful = np.flatnonzero(~gains & ~settled)
            settled[doubtful] = self._is_rounding(rows[active[doubtful]], value[doubtful], J)
            self.z[np.ix_(rows[active[gains]], self.unknowns)] -= step[gains]
            left += active[~gains & ~settled].tolist()
            before[active] = change
            active = active[gains & (change > np.finfo(float).eps)]
            if not active.size:
                break
        lost = np.array(sorted([*left, *active.tolist()]), dtype=int)
        self.z[rows[lost]] = first[lost]
        return rows[lost]

    def _is_rounding(self, rows: np.ndarray, value: np.ndarray, J) -> np.ndarray:
        """At which times all residuals are no larger than the rounding of their terms."""
        if not rows.size:
            return np.zeros(0, dtype=bool)
        terms = abs(J[:, : self.solver.compiled.nx + self.z.shape[1]]) @ np.abs(np.hstack([self.x[rows], self.z[rows]])).T
        return np.all(np.abs(value) <= TERMS * np.finfo(float).eps * (terms.T + 1), axis=1)

    def alone(self, row: int) -> bool:
        """Solve at one time by the damped iteration; whether that worked."""
        c = self.solver.compiled
        y = np.concatenate([self.x[row], self.z[row]])
        try:
            y = algebraic(c, y, self.solver.p, float(self.t[row]), self.modes[row])
        except InitializationError:
            return False
        self.z[row] = y[c.nx :]
        return True
