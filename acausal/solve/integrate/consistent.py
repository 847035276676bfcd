"""Algebraic unknowns that satisfy their equations to rounding, for given states at many times at once.

An integrator controls the error of states only: algebraic unknowns between its steps may be far off.
"""

from __future__ import annotations

from collections.abc import Iterable

import numpy as np

from acausal.compiler import CompiledModel
from acausal.compiler.core_equations import core_square
from acausal.compiler.memo import memoized
from acausal.core import Settler
from acausal.errors import InitializationError
from acausal.policy import POLICY
from acausal.solve.initialization.newton import algebraic
from acausal.solve.point import Rows
from acausal.solve.problem import Problem

CONSISTENT = POLICY.consistent


@memoized
def _needed(compiled: CompiledModel, wanted: frozenset[int] | None) -> np.ndarray:
    """Return what has to be solved for to know some unknowns, all if not given."""
    return compiled.dependence.needed(range(compiled.nz) if wanted is None else wanted)[0]


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
        self._settlers: dict[tuple[int, ...], Settler] = {}

    def __call__(
        self, rows: Rows, wanted: Iterable[int] | None = None, enough: float = CONSISTENT.settled
    ) -> tuple[Rows, list[float]]:
        """Return rows whose algebraic unknowns satisfy their equations, and times at which no such are found.

        What was given stays where none are found.

        Parameters
        ----------
        rows : Rows
            States, and algebraic unknowns nearly right.
        wanted : iterable of int, optional
            Unknowns that must be right, with all that they need; all if not given.
        enough : float, optional
            Relative change in a Newton step that may be the last one: its square is left of the error.
        """
        unknowns = _needed(self.compiled, None if wanted is None else frozenset(wanted))
        if not unknowns.size or not len(rows):
            return rows, []
        found = rows.with_z(rows.z.copy())
        values, settled = self._solved(unknowns, rows, enough)
        found.z[np.ix_(settled, unknowns)] = values[settled]
        lost = [k for k in np.flatnonzero(~settled).tolist() if not self._alone(rows, k, found)]
        return found, [float(rows.times[k]) for k in lost]

    def rates(self, rows: Rows) -> np.ndarray:
        """Return the derivatives of the states, shape (n, nx)."""
        self.evaluations += len(rows)
        return self.problem.each(self.compiled.rates, rows)

    def _solved(self, unknowns: np.ndarray, rows: Rows, enough: float) -> tuple[np.ndarray, np.ndarray]:
        """Solve for unknowns in all rows at once; return them, and whether each row is solved."""
        key = tuple(unknowns.tolist())
        if key not in self._settlers:
            self._settlers[key] = Settler(core_square(self.compiled, key))
        settler, given = self._settlers[key], (self.problem.p, rows.constants, rows.x, rows.z, rows.times[:, None])
        before = settler.evaluations
        found = settler(*given, size=self._sizes(rows)[unknowns], enough=enough)
        self.evaluations += settler.evaluations - before
        return found

    def _sizes(self, rows: Rows) -> np.ndarray:
        """Return the size of each unknown in some rows: what is far below the largest is rounding."""
        size, nominal = np.max(np.abs(rows.z), axis=0), self.compiled.nominal[self.compiled.nx :]
        return np.maximum(size, CONSISTENT.noise * np.max(size / nominal) * nominal) if size.any() else nominal

    def _alone(self, given: Rows, k: int, found: Rows) -> bool:
        """Solve one row in place by the damped iteration, from what was given; return whether it converges."""
        try:
            found.z[k] = algebraic(self.problem, self.problem.point(given, k)).z
        except InitializationError:
            return False
        return True
