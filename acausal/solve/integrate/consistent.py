"""Algebraic unknowns that satisfy their equations to rounding, for given states at many times at once.

An integrator controls the error of states only: algebraic unknowns between its steps may be far off.
"""

from __future__ import annotations

from collections.abc import Iterable

import numpy as np

from acausal.compiler.passes import Pass
from acausal.errors import InitializationError
from acausal.policy import POLICY
from acausal.solve.looks import spread
from acausal.solve.problem import Point, Problem
from acausal.solve.start.newton import algebraic, terms

CONSISTENT = POLICY.consistent


class Consistent:
    """Solver for algebraic unknowns at given states.

    Parameters
    ----------
    problem : Problem
        The model.

    Attributes
    ----------
    evaluations : int
        Evaluations of the equations, or of a part of them, so far; one for each time.
    unsolved : list of float
        Times at which no solution was found; what was given stays there.
    """

    def __init__(self, problem: Problem) -> None:
        self.problem, self.compiled, self.p = problem, problem.compiled, problem.p
        self.evaluations = 0
        self.unsolved: list[float] = []
        self._natural: dict[tuple[int, ...], np.ndarray] = {}

    def __call__(
        self,
        x: np.ndarray,
        z: np.ndarray,
        t: np.ndarray,
        constants: np.ndarray,
        wanted: Iterable[int] | None = None,
    ) -> np.ndarray:
        """Return algebraic unknowns for which their equations hold.

        Parameters
        ----------
        x, z : arrays, shapes (n, nx), (n, nz)
            States, and algebraic unknowns nearly right.
        t : array, shape (n,)
            Times in s.
        constants : array, shape (m,) or (n, m)
            Constants of the segment, or of that of each time.
        wanted : iterable of int, optional
            Unknowns that must be right, with all that they need; all if not given.
        """
        c = self.compiled
        unknowns, equations = c.dependence.needed(range(c.nz) if wanted is None else wanted)
        if not unknowns.size or not len(t):
            return z
        constants = np.broadcast_to(constants, (len(t), constants.shape[-1]))
        first, z = z, z.copy()
        size = self._sizes(x, z, t, constants, unknowns, equations)
        doubtful: set[int] = set()
        for step in c.passes(tuple(unknowns.tolist())):
            doubtful |= self._settle(step, size[step.unknowns], x, z, t, constants)
        for row in sorted(doubtful):
            if not self.holds(
                x[row], z[row], float(t[row]), constants[row], POLICY.newton.terms * np.finfo(float).eps, equations
            ):
                self._alone(row, x, z, first, t, constants)
        return z

    def rates(self, x: np.ndarray, z: np.ndarray, t: np.ndarray, constants: np.ndarray) -> np.ndarray:
        """Return the derivatives of the states, shape (n, nx)."""
        self.evaluations += len(t)
        return self.compiled.rates(x, z, self.p, t, constants)

    def holds(
        self,
        x: np.ndarray,
        z: np.ndarray,
        t: float,
        constants: np.ndarray,
        tolerance: float,
        equations: np.ndarray | None = None,
    ) -> bool:
        """Whether algebraic equations, all if not given, hold at one time, relative to the sizes of their terms."""
        c = self.compiled
        local = c.at(x, z, self.p, t, constants, 0.0)
        rows = c.nx + (np.arange(c.nz) if equations is None else equations)
        sizes = terms(local.jacobian[rows, : c.nx + c.nz], np.concatenate([x, z]), c.nominal)
        return bool(np.all(np.abs(local.value[rows]) <= tolerance * sizes))

    def _sizes(
        self,
        x: np.ndarray,
        z: np.ndarray,
        t: np.ndarray,
        constants: np.ndarray,
        unknowns: np.ndarray,
        equations: np.ndarray,
    ) -> np.ndarray:
        """Change of each unknown that changes an equation by as much as its terms: what is below it is rounding."""
        c = self.compiled
        key = tuple(unknowns)
        if key not in self._natural or len(t) > CONSISTENT.many:
            size = np.zeros(c.nz)
            for k in spread(len(t), CONSISTENT.looks):
                J = abs(c.at(x[k], z[k], self.p, float(t[k]), constants[k], 0.0).jacobian[c.nx + equations])
                entries = J[:, c.nx + unknowns].tocoo()
                terms = (J @ np.abs(np.concatenate([x[k], z[k]])))[entries.row]
                here = np.full(len(unknowns), np.inf)
                with np.errstate(divide="ignore", invalid="ignore"):
                    np.fmin.at(here, entries.col, terms / entries.data)
                size[unknowns] = np.fmax(size[unknowns], np.where(np.isfinite(here), here, 0))
            self._natural[key] = size
        size = np.maximum(self._natural[key], np.max(np.abs(z), axis=0))
        nominal = c.nominal[c.nx :]
        return np.maximum(size, CONSISTENT.noise * np.max(size / nominal) * nominal) if size.any() else nominal

    def _settle(
        self, step: Pass, size: np.ndarray, x: np.ndarray, z: np.ndarray, t: np.ndarray, constants: np.ndarray
    ) -> set[int]:
        """Repeat a pass in place until nothing changes; return the rows where it did not get there."""
        enough = CONSISTENT.once if step.linear else CONSISTENT.settled
        rows, before, doubtful = np.arange(len(t)), np.full(len(t), np.inf), set()
        while rows.size:
            found = self._newton(step, x[rows], z[rows], t[rows], constants[rows])
            change = np.max(np.abs(found - z[np.ix_(rows, step.unknowns)]) / size, axis=1)
            nearer = change < before[rows]
            doubtful |= set(rows[~nearer].tolist())
            rows, found, change = rows[nearer], found[nearer], change[nearer]
            z[np.ix_(rows, step.unknowns)] = found
            before[rows] = change
            rows = rows[change > enough]
        return doubtful

    def _newton(self, step: Pass, x: np.ndarray, z: np.ndarray, t: np.ndarray, constants: np.ndarray) -> np.ndarray:
        """One Newton step at every time; nan where the equations are singular."""
        self.evaluations += len(t)
        found = step.function(x, z, self.p, t, constants)
        bad = np.flatnonzero(~np.all(np.isfinite(found), axis=1))
        for k in bad if len(t) > 1 else ():
            # A singular one leaves nothing for the others of its call.
            found[k] = self._newton(step, x[[k]], z[[k]], t[[k]], constants[[k]])[0]
        return found

    def _alone(
        self, row: int, x: np.ndarray, z: np.ndarray, first: np.ndarray, t: np.ndarray, constants: np.ndarray
    ) -> None:
        """Solve at one time by the damped iteration, from what was given."""
        given = Point(float(t[row]), x[row], first[row], self.compiled.layout.constants(constants[row]))
        try:
            z[row] = algebraic(self.problem, given).z
        except InitializationError:
            z[row] = first[row]
            self.unsolved.append(float(t[row]))
