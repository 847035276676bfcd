"""Equilibrium: states at which all rates vanish, on the constraints, near the guesses, stable if one exists.

Newton steps of least norm lead to the nearest equilibrium, which may be an unstable one. The motion itself, with steps
of the implicit Euler method that grow, loses energy on the way and ends in a stable one (pseudo-transient continuation,
Kelley & Keyes 1998). What no equation determines goes back to its guess.
"""

from __future__ import annotations

import warnings
from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np
import scipy

from acausal.errors import InitializationError, caution
from acausal.policy import POLICY
from acausal.solve.points import Point
from acausal.solve.problem import Problem
from acausal.solve.start.at_rest import at_rest, kinematic, meters, motion_text
from acausal.solve.start.least_change import least_change
from acausal.solve.start.loop_states import choose_projection
from acausal.solve.start.loops import close, tighten
from acausal.solve.start.newton import Lost, algebraic
from acausal.solve.start.rank import factored
from acausal.solve.start.tangent import tangent
from acausal.solve.start.words import unstable_text

REST = POLICY.rest


class Restless(InitializationError):
    """Nothing comes to rest; `at` is where the motion leads."""

    def __init__(self, text: str, at: Point) -> None:
        super().__init__(text)
        self.at = at


@dataclass
class Linearized:
    """Rates and conditions at a point, and their Jacobians by the states with the algebraic unknowns eliminated."""

    point: Point
    rates: np.ndarray
    A: np.ndarray
    conditions: np.ndarray
    C: np.ndarray


class Equilibrium:
    """Search for an equilibrium.

    Parameters
    ----------
    problem : Problem
        The model.
    guess : Point
        Where it is sought, loops closed.
    """

    def __init__(self, problem: Problem, guess: Point) -> None:
        self.problem, self.guess = problem, guess
        compiled, self.nx = problem.compiled, problem.nx
        self.scale = problem.nominal[: self.nx]
        self.rows = np.setdiff1d(np.arange(self.nx), meters(compiled))
        pairs = [coordinate for coordinate, _ in problem.rates]
        self.coordinates = np.array(sorted({*pairs, *kinematic(compiled)}), dtype=int)

    def find(self, first: Point | None = None) -> Point:
        """Return a point at rest.

        Parameters
        ----------
        first : Point, optional
            Where it may rest.

        Raises
        ------
        InitializationError
            If there is no equilibrium, none is found, or the initial conditions do not hold in it.
        """
        found = self._tried(first)
        if found is None or self._far(self._apart(found)) > REST.turn:
            # What Newton's steps of any length lead to may be turns away.
            near = [here for here in (self._newton(self.guess), found) if here]
            found = min(near, key=self._distance, default=None)
        rate, push = (0.0, np.zeros(self.nx)) if found is None else self._growing(found)
        at = relaxed = self.guess
        for far, bent in () if found is not None and self._is_guess(found) else REST.limits:
            if found is not None and not rate:
                break
            relaxed = self._relax(at, far, bent)
            resting = self._newton(relaxed)
            if resting is not None:
                found = self._unturned(resting)
                rate, push = self._growing(found)
                at = _moved(found.point, push)
        if found is None:
            self._at(self.guess)  # the cause may be there
            nearly = self._nearly(relaxed)
            if not at_rest(self.problem, nearly):
                raise Restless(motion_text(self.problem, nearly), relaxed)
            found = self._at(nearly)
            rate = self._growing(found)[0]
        if rate:
            caution(unstable_text(self.problem.compiled, self.guess.time, rate))
        return found.point

    def _tried(self, first: Point | None) -> Linearized | None:
        try:
            here = self._at(first) if first else None
        except InitializationError:
            return None
        return here if here and self._rests(here) else None

    def _is_guess(self, found: Linearized) -> bool:
        return bool(np.all(np.abs(self._apart(found)) <= REST.guess * self.scale))

    def _nearly(self, relaxed: Point) -> Point:
        """Where the rates are least, whatever the initial conditions; those that remain show what moves."""
        found = [self._search(at, conditions=False) for at in (self.guess, relaxed)]
        resting = [here for here in found if here is not None]
        resting.sort(key=lambda here: float(np.linalg.norm(here.rates[self.rows])))
        return resting[0].point if resting else self.guess

    def _at(self, at: Point) -> Linearized:
        """Solve for the algebraic unknowns, and linearise."""
        nx, nz = self.nx, self.problem.nz
        at = algebraic(self.problem, at)
        local = self.problem.local(at)
        if not (np.all(np.isfinite(local.value)) and np.all(np.isfinite(local.jacobian.data))):
            raise Lost("the equations have no value there", at, 0.0)
        J = local.jacobian.tocsc()
        solve = factored(J[nx : nx + nz, nx:], self.problem.nominal[nx:], POLICY.ranks.rank) if nz else None
        dz = solve(-J[nx : nx + nz, :nx].toarray()) if solve else np.zeros((0, nx))
        A, C = ((J[rows, :nx] + J[rows, nx:] @ dz) for rows in (slice(0, nx), slice(nx + nz, None)))
        return Linearized(at, local.value[:nx], np.asarray(A), local.value[nx + nz :], np.asarray(C))

    def _close(self, at: Point) -> Point:
        """Close the loops, and choose again which states follow from others.

        Only states that follow from others move, if that closes them: moving stiff parts as well would drive the motion.
        """
        c, left = self.problem.compiled.constraints, np.inf
        if not c.size:
            return at
        closed = at
        if not at.constants.moves:
            held = np.setdiff1d(np.arange(self.nx), c.entries[1][at.constants.D != 0])
            closed, left = close(self.problem, at, held)
        if left > POLICY.loops.closed:
            closed = tighten(self.problem, replace(at, constants=self.guess.constants))
        at = replace(closed, constants=choose_projection(self.problem, closed))
        return self.problem.completed(at)

    def _newton(self, at: Point) -> Linearized | None:
        """Search from a point, then return what is free to its guess; None where it does not come to rest."""
        here = self._search(at)
        if here is None or not self._rests(here):
            return None
        part = 1.0
        for _ in range(REST.back):
            back = least_change(*self._all(here, True), self._apart(here), self.scale)[1]
            if part < REST.short or np.max(np.abs(back) / self.scale, initial=0.0) <= REST.there:
                break
            there = self._search(_moved(here.point, part * back))
            nearer = there is not None and self._distance(there) < (1 - part / 4) * self._distance(here)
            if there is not None and self._distance(there) < self._distance(here) and self._rests(there):
                here = there
            part = part if nearer else part / 2
        return here

    def _unturned(self, here: Linearized) -> Linearized:
        """Take back whole turns away from the guess, of coordinates that rest there as well."""
        for k in self.coordinates:
            back = np.zeros(self.nx)
            back[k] = 2 * np.pi * np.round(self._apart(here)[k] / (2 * np.pi))
            there = self._tried(_moved(here.point, back)) if back[k] else None
            here = there or here
        return here

    def _rests(self, here: Linearized) -> bool:
        return at_rest(self.problem, here.point)

    def _apart(self, here: Linearized) -> np.ndarray:
        return self.guess.x - here.point.x

    def _distance(self, here: Linearized) -> float:
        return float(np.linalg.norm(self._apart(here) / self.scale))

    def _search(self, at: Point, conditions: bool = True) -> Linearized | None:
        """Newton steps of least norm, as far as they lead; None where equations cannot be solved."""
        try:
            here = self._at(self._close(at))
        except InitializationError:
            return None
        for _ in range(REST.newton):
            value, J = self._all(here, conditions)
            step = least_change(value, J, np.zeros(self.nx), self.scale)[0]
            if np.max(np.abs(step) / (self.scale + np.abs(here.point.x)), initial=0.0) <= REST.converged:
                break
            there = self._go(here, step, value, J, conditions)
            if there is None:
                break
            here = there
        return here

    def _go(
        self, here: Linearized, step: np.ndarray, value: np.ndarray, J: np.ndarray, conditions: bool
    ) -> Linearized | None:
        """Shorten a step that leads too far until the residuals do not grow; None if they always do."""
        size = np.linalg.norm(J * self.scale, axis=1)
        weight = 1 / np.where(size > 0, size, 1.0)
        for part in min(1.0, REST.far / (self._far(step) or REST.far)) / 2.0 ** np.arange(REST.halvings):
            try:
                there = self._at(self._close(_moved(here.point, part * step)))
            except InitializationError:
                continue
            left = np.linalg.norm(weight * self._all(there, conditions)[0])
            if left <= (1 - REST.decrease * part) * np.linalg.norm(weight * value) + REST.converged:
                return there
        return None

    def _all(self, here: Linearized, conditions: bool) -> tuple[np.ndarray, np.ndarray]:
        """Everything that must vanish: rates, initial conditions, constraints; and its Jacobian by the states."""
        value, J = here.rates[self.rows], here.A[self.rows]
        if conditions:
            value, J = np.concatenate([value, here.conditions]), np.vstack([J, here.C])
        c = self.problem.compiled.constraints
        if c.size:
            off, M = self.problem.constraints(here.point)
            # Rows that are dropped may be rounding, which would hold something once they have length 1.
            kept = c.counting(here.point.constants.closures)
            value, J = np.concatenate([value, off[kept]]), np.vstack([J, M.toarray()[kept]])
        return value, J

    def _size(self, step: np.ndarray) -> float:
        return float(np.max(np.abs(step) / self.scale, initial=0.0))

    def _far(self, step: np.ndarray) -> float:
        """How far a step leads, in nominal values of what has a rate among the states, or whose rate is kinematics."""
        return float(np.max(np.abs(step / self.scale)[self.coordinates], initial=0.0))

    def _relax(self, at: Point, far: float, bent: float) -> Point:
        """Follow the motion by steps of the linearly implicit Euler method that grow."""
        try:
            here = self._at(self._close(at))
        except InitializationError:
            return at
        fastest = float(np.max(np.abs(np.linalg.eigvals(here.A)), initial=0.0)) or 1.0
        h = REST.first / fastest
        for _ in range(REST.relaxation):
            there = self._euler(here, h, far, bent)
            if there is None:
                h /= REST.shrinkage
                if h * fastest < REST.shortest:
                    break
                continue
            moved, here = there.point.x - here.point.x, there
            h *= REST.growth
            if h * fastest > REST.last or np.all(np.abs(moved) < REST.converged * (self.scale + np.abs(here.point.x))):
                break
        return here.point

    def _euler(self, here: Linearized, h: float, far: float, bent: float) -> Linearized | None:
        """Take a step of length h; None where it cannot be taken, leads too far, or iterations go on to change it much."""
        moves = np.isin(np.arange(self.nx), self.rows)
        there, step, before = here, np.zeros(self.nx), np.inf
        for k in range(REST.iterations):
            left = np.where(moves, h * there.rates - (there.point.x - here.point.x), 0.0)
            change = _solver(np.eye(self.nx) - h * there.A)(left)
            if k and self._size(change) <= bent * self._size(step):
                return there
            if not self._size(change) <= REST.lessens * before:
                return None
            before = self._size(change)
            step = there.point.x + change - here.point.x
            if not np.all(np.isfinite(step)) or self._far(step) > far:
                return None
            try:
                there = self._at(self._close(_moved(here.point, step)))
            except InitializationError:
                return None
        return None

    def _growing(self, here: Linearized) -> tuple[float, np.ndarray]:
        """What grows fastest: its rate in 1/s, 0 if none grows beyond rounding, and a small way along it."""
        N, chosen = tangent(self.problem, here.point)
        size = self.scale[chosen]
        A = (here.A @ N)[chosen] * size / size[:, None]
        if not A.size:
            return 0.0, np.zeros(self.nx)
        values, vectors = np.linalg.eig(A)
        # Double zeros, of what is free to move, split by the root of rounding.
        floor = REST.split * np.sqrt(np.finfo(float).eps * float(np.max(np.abs(A))) * self.problem.feedback)
        real = np.where(np.real(values) > np.maximum(floor, REST.grows * np.abs(values)), np.real(values), 0.0)
        k = int(np.argmax(real))
        direction = N @ (size * np.real(vectors[:, k]))
        return float(real[k]), REST.push * direction / (
            self._far(direction) or float(np.max(np.abs(direction / self.scale)))
        )


def _solver(matrix: np.ndarray) -> Callable[[np.ndarray], np.ndarray]:
    """Solve with a matrix many times; nan where it is singular."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", scipy.linalg.LinAlgWarning)
        factors = scipy.linalg.lu_factor(matrix, check_finite=False)
    return lambda right: scipy.linalg.lu_solve(factors, right, check_finite=False)


def _moved(at: Point, step: np.ndarray) -> Point:
    return replace(at, x=at.x + step)
