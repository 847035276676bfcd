"""Algebraic unknowns that satisfy their equations to rounding, for given states at many times at once.

An integrator controls the error of states only: algebraic unknowns between its steps may be far off.
"""

from __future__ import annotations

from collections.abc import Iterable

import numpy as np

from acausal.compiler.core_equations import core_square
from acausal.compiler.passes import Pass
from acausal.core import Settler, library
from acausal.errors import InitializationError
from acausal.policy import POLICY
from acausal.solve.looks import spread
from acausal.solve.points import Rows
from acausal.solve.problem import Problem
from acausal.solve.start.newton import algebraic, terms
from acausal.solve.start.parts import part_of

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
    """

    def __init__(self, problem: Problem) -> None:
        self.problem, self.compiled = problem, problem.compiled
        self.evaluations = 0
        self._natural: dict[tuple[int, ...], np.ndarray] = {}
        self._settlers: dict[tuple[int, ...], Settler] = {}

    def __call__(self, rows: Rows, wanted: Iterable[int] | None = None) -> tuple[Rows, list[float]]:
        """Return rows whose algebraic unknowns satisfy their equations, and times at which no such are found.

        What was given stays where none are found.

        Parameters
        ----------
        rows : Rows
            States, and algebraic unknowns nearly right.
        wanted : iterable of int, optional
            Unknowns that must be right, with all that they need; all if not given.
        """
        c = self.compiled
        unknowns, equations = c.dependence.needed(range(c.nz) if wanted is None else wanted)
        if not unknowns.size or not len(rows):
            return rows, []
        found = rows.with_z(rows.z.copy())
        size = self._sizes(rows, unknowns, equations)
        doubtful: set[int] = set()
        left = self._by_core(unknowns, size, found)
        for step in c.passes(tuple(unknowns.tolist())) if left.size else ():
            doubtful |= self._settle(step, size[step.unknowns], found, left)
        rounding = POLICY.newton.terms * np.finfo(float).eps
        wrong = [k for k in sorted(doubtful) if not self.holds(found, k, rounding, equations)]
        return found, [float(rows.times[k]) for k in wrong if not self._alone(rows, k, found)]

    def rates(self, rows: Rows) -> np.ndarray:
        """Return the derivatives of the states, shape (n, nx)."""
        self.evaluations += len(rows)
        return self.problem.each(self.compiled.rates, rows)

    def holds(self, rows: Rows, k: int, tolerance: float, equations: np.ndarray | None = None) -> bool:
        """Whether algebraic equations, all if not given, hold in a row, relative to the sizes of their terms."""
        c, at = self.compiled, self.problem.point(rows, k)
        local = self.problem.local(at)
        own = c.nx + (np.arange(c.nz) if equations is None else equations)
        sizes = terms(local, at.y, c.nominal)[own]
        return bool(np.all(np.abs(local.value[own]) <= tolerance * sizes))

    def _sizes(self, rows: Rows, unknowns: np.ndarray, equations: np.ndarray) -> np.ndarray:
        """Change of each unknown that changes an equation by as much as its terms: what is below it is rounding."""
        c = self.compiled
        key = tuple(unknowns)
        if key not in self._natural or len(rows) > CONSISTENT.many:
            size, part = np.zeros(c.nz), part_of(c.pattern, c.nx + equations, c.nx + unknowns)
            for k in spread(len(rows), CONSISTENT.looks):
                at = self.problem.point(rows, k)
                J = abs(self.problem.local(at).jacobian)
                terms = (J @ np.abs(at.y))[part.rows[part.places[0]]]
                here = np.full(len(unknowns), np.inf)
                with np.errstate(divide="ignore", invalid="ignore"):
                    np.fmin.at(here, part.places[1], terms / J.data[part.entries])
                size[unknowns] = np.fmax(size[unknowns], np.where(np.isfinite(here), here, 0))
            self._natural[key] = size
        size = np.maximum(self._natural[key], np.max(np.abs(rows.z), axis=0))
        nominal = c.nominal[c.nx :]
        return np.maximum(size, CONSISTENT.noise * np.max(size / nominal) * nominal) if size.any() else nominal

    def _by_core(self, unknowns: np.ndarray, size: np.ndarray, rows: Rows) -> np.ndarray:
        """Solve for unknowns in place, all at once; return the rows where that does not converge, which are as they were."""
        if not library():
            return np.arange(len(rows))
        key = tuple(unknowns.tolist())
        if key not in self._settlers:
            self._settlers[key] = Settler(core_square(self.compiled, key))
        settler = self._settlers[key]
        before = settler.evaluations
        given = self.problem.p, rows.constants, rows.x, rows.z, rows.times[:, None]
        found, settled = settler(*given, size=size[unknowns], enough=CONSISTENT.settled)
        self.evaluations += settler.evaluations - before
        rows.z[np.ix_(settled, unknowns)] = found[settled]
        return np.flatnonzero(~settled)

    def _settle(self, step: Pass, size: np.ndarray, rows: Rows, some: np.ndarray) -> set[int]:
        """Repeat a pass in place in some rows until nothing changes; return those where it did not get there."""
        enough = CONSISTENT.once if step.linear else CONSISTENT.settled
        before, doubtful = np.full(len(rows), np.inf), set()
        while some.size:
            found = self._newton(step, rows[some])
            change = np.max(np.abs(found - rows.z[np.ix_(some, step.unknowns)]) / size, axis=1)
            nearer = change < before[some]
            doubtful |= set(some[~nearer].tolist())
            some, found, change = some[nearer], found[nearer], change[nearer]
            rows.z[np.ix_(some, step.unknowns)] = found
            before[some] = change
            some = some[change > enough]
        return doubtful

    def _newton(self, step: Pass, rows: Rows) -> np.ndarray:
        """One Newton step in every row; nan where the equations are singular."""
        self.evaluations += len(rows)
        found = self.problem.each(step.function, rows)
        bad = np.flatnonzero(~np.all(np.isfinite(found), axis=1))
        for k in bad.tolist() if len(rows) > 1 else ():
            # A singular one leaves nothing for the others of its call.
            found[k] = self._newton(step, rows[[k]])[0]
        return found

    def _alone(self, given: Rows, k: int, found: Rows) -> bool:
        """Solve one row in place by the damped iteration, from what was given; False if that does not converge."""
        try:
            found.z[k] = algebraic(self.problem, self.problem.point(given, k)).z
        except InitializationError:
            found.z[k] = given.z[k]
            return False
        return True
