"""Algebraic unknowns that satisfy their equations to rounding, for given states at many times at once.

An integrator controls the error of states only: algebraic unknowns between its steps may be far off.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass

import numpy as np

from acausal.compiler import CompiledModel
from acausal.compiler.algebraic_newton import NewtonStep
from acausal.compiler.core_equations import core_square
from acausal.compiler.memo import memoized
from acausal.core import Settler, Square, library
from acausal.errors import InitializationError
from acausal.policy import POLICY
from acausal.solve.initialization.newton import algebraic, terms
from acausal.solve.looks import spread
from acausal.solve.point import Rows
from acausal.solve.problem import Problem
from acausal.solve.sparse_blocks import block_of

CONSISTENT = POLICY.consistent
CANCELS = 16 * np.finfo(float).eps
ROUNDING = POLICY.newton.terms * np.finfo(float).eps


@dataclass(frozen=True, eq=False)
class _Needed:
    """Algebraic unknowns and their equations, and the Jacobian of these.

    Attributes
    ----------
    unknowns, equations : arrays of int
        Places among all of the model.
    key : tuple of int
        The unknowns.
    rows, entries : arrays of int
        Equation, counted from the first of the model, and place of each entry, column by column.
    first, columns : arrays of int
        Where the entries of each unknown begin, and these unknowns, counted from the first: some have none.
    """

    unknowns: np.ndarray
    equations: np.ndarray
    key: tuple[int, ...]
    rows: np.ndarray
    entries: np.ndarray
    first: np.ndarray
    columns: np.ndarray

    def changes(self, problem: Problem, rows: Rows, k: int) -> np.ndarray:
        """Change of each unknown, in one of some rows, that changes an equation by as much as its terms; 0 if none does."""
        x, z = rows.x[k], rows.z[k]
        local = problem.compiled.at(x, z, problem.p, rows.times[k], rows.constants[k], 0.0)
        terms = local.magnitudes(np.abs(np.concatenate([x, z])))[self.rows]
        found = np.zeros(len(self.unknowns))
        if self.entries.size:
            with np.errstate(divide="ignore", over="ignore", invalid="ignore"):
                least = np.fmin.reduceat(terms / np.abs(local.entries[self.entries]), self.first)
            found[self.columns] = np.where(np.isfinite(least), least, 0.0)
        return found


@memoized
def _needed(compiled: CompiledModel, wanted: frozenset[int] | None) -> _Needed:
    """Return what has to be solved for to know some unknowns, all if not given."""
    unknowns, _ = compiled.dependence.needed(range(compiled.nz) if wanted is None else wanted)
    return _solved(compiled, tuple(unknowns.tolist()))


@memoized
def _solved(compiled: CompiledModel, key: tuple[int, ...]) -> _Needed:
    unknowns, equations = compiled.dependence.needed(key)
    block = block_of(compiled.pattern, compiled.nx + equations, compiled.nx + unknowns)
    columns, first = np.unique(block.places[1], return_index=True)
    return _Needed(unknowns, equations, key, block.rows[block.places[0]], block.entries, first, columns)


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
        self._natural: dict[_Needed, np.ndarray] = {}
        self._settlers: dict[_Needed, Settler] = {}

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
        needed = _needed(self.compiled, None if wanted is None else frozenset(wanted))
        if not needed.unknowns.size or not len(rows):
            return rows, []
        found = rows.with_z(rows.z.copy())
        left = self._by_core(needed, self._sizes(rows), found, enough) if library() else np.arange(len(rows))
        if not left.size:
            return found, []
        doubtful: set[int] = set()
        size = self._sizes(rows, self._terms(rows, needed))
        for step in self.compiled.newton_steps(needed.key):
            doubtful |= self._settle(step, size[step.unknowns], found, left)
        wrong = [k for k in sorted(doubtful) if not self.holds(found, k, ROUNDING, needed.equations)]
        return found, [float(rows.times[k]) for k in wrong if not self._alone(rows, k, found)]

    def rates(self, rows: Rows) -> np.ndarray:
        """Return the derivatives of the states, shape (n, nx)."""
        self.evaluations += len(rows)
        return self.problem.each(self.compiled.rates, rows)

    def holds(self, rows: Rows, k: int, tolerance: float, equations: np.ndarray | None = None) -> bool:
        """Whether algebraic equations, all if not given, hold in a row, relative to the sizes of their terms."""
        c, at = self.compiled, self.problem.point(rows, k)
        # Terms in algebraic unknowns alone are less than all of them, which take longer.
        if equations is None and c.nz and library():
            row = rows[[k]]
            if self._square(range(c.nz)).hold(*self._given(row), sizes=np.abs(row.z), tolerance=tolerance)[0]:
                return True
        local = self.problem.local(at)
        own = slice(c.nx, c.nx + c.nz) if equations is None else c.nx + equations
        left, y = np.abs(local.value[own]), at.y
        # These terms are never more than those, which take longer.
        if (left <= tolerance * local.magnitudes(np.abs(y))[own]).all():
            return True
        # Terms of states that cancel show in no slope; what is left of them is rounding beside nominal sizes. Nor do
        # terms of time and parameters alone: they are left where all unknowns are 0.
        nominal = np.append(np.zeros(c.nx), c.nominal[c.nx :])
        constant = np.abs(self.problem.values(at.with_y(np.zeros(len(y)))))
        cancel = np.fmax(local.magnitudes(nominal), np.where(np.isfinite(constant), constant, 0.0))
        rest = np.maximum(tolerance * terms(local, y, c.nominal), CANCELS * cancel)
        return bool((left <= rest[own]).all())

    def sizes(self, values: np.ndarray) -> np.ndarray:
        """Sizes of algebraic unknowns of some values at n times, shape (n, nz): what is far below the largest is rounding.

        So is what is far below the nominal value: it may be what is left of terms that cancel.
        """
        nominal = self.compiled.nominal[self.compiled.nx :]
        least = np.maximum(CONSISTENT.noise * np.max(values / nominal, axis=1, keepdims=True), ROUNDING)
        return np.maximum(values, least * nominal)

    def solve(self, rows: Rows) -> tuple[Rows, np.ndarray]:
        """Return rows as a call does, all of them solved, and whether the equations hold in each to rounding.

        That is in the sizes of its own unknowns: where these grow without end, a Newton step is small beside them.
        """
        found = self(rows)[0]
        square, sizes = self._square(range(self.compiled.nz)), self.sizes(np.abs(found.z))
        right = square.hold(*self._given(found), sizes=sizes, tolerance=ROUNDING)
        for k in np.flatnonzero(~right).tolist():
            right[k] = self._again(found, k)
        return found, right

    def _again(self, rows: Rows, k: int) -> bool:
        """Solve one row again in place, in the sizes of its own unknowns; return whether the equations hold to rounding."""
        for _ in range(CONSISTENT.again):
            rows.z[k] = self(rows[[k]])[0].z[0]
            if self.holds(rows, k, ROUNDING):
                return True
        return False

    def _terms(self, rows: Rows, needed: _Needed) -> np.ndarray:
        """Change of each unknown that changes an equation by as much as its terms, at some of the times."""
        if needed not in self._natural or len(rows) > CONSISTENT.many:
            found = [needed.changes(self.problem, rows, k) for k in spread(len(rows), CONSISTENT.looks)]
            self._natural[needed] = np.zeros(self.compiled.nz)
            self._natural[needed][needed.unknowns] = np.max(found, axis=0)
        return self._natural[needed]

    def _sizes(self, rows: Rows, terms: float | np.ndarray = 0.0) -> np.ndarray:
        """Size of each unknown, of its values or of the terms of its equations, if larger: what is far below it is rounding."""
        size = np.maximum(terms, np.max(np.abs(rows.z), axis=0))
        nominal = self.compiled.nominal[self.compiled.nx :]
        return np.maximum(size, CONSISTENT.noise * np.max(size / nominal) * nominal) if size.any() else nominal

    def _by_core(self, needed: _Needed, size: np.ndarray, rows: Rows, enough: float) -> np.ndarray:
        """Solve for unknowns in place, all at once; return the rows where that does not converge, which are as they were."""
        if needed not in self._settlers:
            self._settlers[needed] = Settler(self._square(needed.key))
        unknowns, settler = needed.unknowns, self._settlers[needed]
        before = settler.evaluations
        found, settled = settler(*self._given(rows), size=size[unknowns], enough=enough)
        self.evaluations += settler.evaluations - before
        left = np.flatnonzero(~settled)
        if left.size:
            found[left] = rows.z[left][:, unknowns]
        rows.z[:, unknowns] = found
        return left

    def _square(self, unknowns: Iterable[int]) -> Square:
        return core_square(self.compiled, tuple(unknowns))

    def _given(self, rows: Rows) -> tuple[np.ndarray, ...]:
        """Arguments of such equations."""
        return self.problem.p, rows.constants, rows.x, rows.z, rows.times[:, None]

    def _settle(self, step: NewtonStep, size: np.ndarray, rows: Rows, some: np.ndarray) -> set[int]:
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

    def _newton(self, step: NewtonStep, rows: Rows) -> np.ndarray:
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
