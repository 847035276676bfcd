"""Equilibrium: states at which all rates vanish, on the constraints, near the guesses, stable if one exists.

In steady rotation those of cyclic coordinates do not, see `rotation`.

Newton steps of least norm lead to the nearest equilibrium, which may be an unstable one. The motion itself, with steps
of the implicit Euler method that grow, loses energy on the way and ends in a stable one (pseudo-transient continuation,
Kelley & Keyes 1998). What no equation determines goes back to its guess.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from acausal.errors import InitializationError, caution
from acausal.policy import POLICY
from acausal.solve.diagnosis.initialization import unstable_text
from acausal.solve.initialization.equilibrium_test import at_rest, motion_text
from acausal.solve.initialization.independent_constraints import smallest_singular_value
from acausal.solve.initialization.minimum_norm_step import least_change
from acausal.solve.initialization.pseudo_transient import relax
from acausal.solve.initialization.reduced_linearization import Linearized, Linearizer, moved
from acausal.solve.initialization.steady_rotation import changes, cyclic, turning
from acausal.solve.initialization.tangent_space import tangent
from acausal.solve.point import Point
from acausal.solve.problem import Problem

REST = POLICY.rest


class NoEquilibrium(InitializationError):
    """Nothing comes to rest; `at` is where the motion leads."""

    def __init__(self, text: str, at: Point) -> None:
        super().__init__(text)
        self.at = at


class Equilibrium(Linearizer):
    """Search for an equilibrium near a guess."""

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
        if found is None or self.far(self._apart(found)) > REST.turn:
            # What Newton's steps of any length lead to may be turns away.
            near = [here for here in (self._newton(self.guess), found) if here]
            found = min(near, key=self._distance, default=None)
        rate, push = (0.0, np.zeros(self.nx)) if found is None else self._growing(found)
        at = relaxed = self.guess
        for far, bent in () if found is not None and self._is_guess(found) else REST.limits:
            if found is not None and not rate:
                break
            relaxed = relax(self, at, far, bent)
            resting = self._newton(relaxed)
            if resting is not None:
                found = self._unturned(resting)
                rate, push = self._growing(found)
                at = moved(found.point, push)
        if found is None:
            self.linearized(self.guess)  # the cause may be there
            nearly = self._nearly(relaxed)
            if not self._is_steady(nearly):
                raise NoEquilibrium(motion_text(self.problem, nearly), relaxed)
            found = self.linearized(nearly)
            rate = self._growing(found)[0]
        if rate:
            flat = smallest_singular_value(self.problem, found.point) <= POLICY.loops.flat
            caution(unstable_text(self.problem.compiled, self.guess.time, rate, flat))
        return found.point

    def _tried(self, first: Point | None) -> Linearized | None:
        try:
            here = self.linearized(first) if first else None
        except InitializationError:
            return None
        return here if here and self._rests(here) else None

    def _is_guess(self, found: Linearized) -> bool:
        return bool(np.all(np.abs(self._apart(found)) <= REST.guess * self.scale))

    def _nearly(self, relaxed: Point) -> Point:
        """Where the rates are least, whatever the initial conditions; those that remain show what moves."""
        found = [self._search(at, conditions=False) for at in (self.guess, relaxed)]
        resting = [here for here in found if here is not None]
        resting.sort(key=lambda here: float(np.linalg.norm(self.still @ here.rates)))
        return resting[0].point if resting else self.guess

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
            there = self._search(moved(here.point, part * back))
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
            there = self._tried(self.problem.completed(moved(here.point, back))) if back[k] else None
            here = there or here
        return here

    def _rests(self, here: Linearized) -> bool:
        return self._is_steady(here.point)

    def _is_steady(self, at: Point) -> bool:
        if self.turns:
            return turning(self.problem, at, [self.space]) is not None
        return at_rest(self.problem, at)

    def _apart(self, here: Linearized) -> np.ndarray:
        return self.guess.x - here.point.x

    def _distance(self, here: Linearized) -> float:
        return float(np.linalg.norm(self._apart(here) / self.scale))

    def _search(self, at: Point, conditions: bool = True) -> Linearized | None:
        """Newton steps of least norm, as far as they lead; None where equations cannot be solved."""
        try:
            here = self.linearized(self.closed(at))
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
        for part in min(1.0, REST.far / (self.far(step) or REST.far)) / 2.0 ** np.arange(REST.halvings):
            try:
                there = self.linearized(self.closed(moved(here.point, part * step, part * here.follows(step))))
            except InitializationError:
                continue
            left = np.linalg.norm(weight * self._values(there, conditions))
            if left <= (1 - REST.decrease * part) * np.linalg.norm(weight * value) + REST.converged:
                return there
        return None

    def _all(self, here: Linearized, conditions: bool) -> tuple[np.ndarray, np.ndarray]:
        """Everything that must vanish: rates, initial conditions, constraints; and its Jacobian by the states."""
        J = self.still @ here.A
        if conditions:
            J = np.vstack([J, here.C])
        if self.problem.compiled.constraints.size:
            J = np.vstack([J, self.problem.constraints(here.point)[1].toarray()[self._kept(here)]])
        return self._values(here, conditions), J

    def _values(self, here: Linearized, conditions: bool) -> np.ndarray:
        value = self.still @ here.rates
        if conditions:
            value = np.concatenate([value, here.conditions])
        if self.problem.compiled.constraints.size:
            value = np.concatenate([value, self.problem.constraints(here.point)[0][self._kept(here)]])
        return value

    def _kept(self, here: Linearized) -> np.ndarray:
        """Which constraints count; rows that are dropped may be rounding, which would hold something once they have length 1."""
        return self.problem.compiled.constraints.counting(here.point.constants.closures)

    def _growing(self, here: Linearized) -> tuple[float, np.ndarray]:
        """What grows fastest: its rate in 1/s, 0 if none grows beyond rounding, and a small way along it.

        Eigenvalues of a Jacobian that changes as angles turn do not tell.
        """
        turn = turning(self.problem, here.point, [self.space]) if self.turns else None
        if turn:
            there = self.linearized(turn.on(self.problem, here.point, 1.0))
            if changes(self.still @ here.A * self.scale, self.still @ there.A * self.scale).any():
                return 0.0, np.zeros(self.nx)
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
            self.far(direction) or float(np.max(np.abs(direction / self.scale)))
        )


def rest(problem: Problem, at: Point, first: Point | None) -> Point:
    """Return a point at rest near a guess; it does not depend on how fast invariants are kept in a run.

    Parameters
    ----------
    problem : Problem
        The model.
    at : Point
        The guess, where loops are closed.
    first : Point, optional
        Where it may rest.
    """
    own = replace(problem, feedback=REST.feedback)
    found = Equilibrium(own, _kept(at, own.feedback)).find(first and _kept(first, own.feedback))
    return _kept(found, problem.feedback)


def rotation(problem: Problem, at: Point) -> Point:
    """Return a point in steady rotation near a guess; see `rest`."""
    own = replace(problem, feedback=REST.feedback)
    guess, failed = _kept(at, own.feedback), InitializationError("no coordinate is cyclic")
    for space in cyclic(own, guess):
        try:
            return _kept(Equilibrium(own, guess, space).find(), problem.feedback)
        except InitializationError as error:
            failed = error
    raise failed


def _kept(at: Point, feedback: float) -> Point:
    return replace(at, constants=replace(at.constants, feedback=feedback))
