"""Equilibrium near the guesses: all rates vanish and the constraints hold; a stable one if it exists.

In steady rotation the rates of cyclic coordinates do not vanish, see `steady_rotation`.

Minimum-norm Newton steps find the nearest equilibrium, which may be unstable. Pseudo-transient continuation (Kelley & Keyes
1998), the implicit Euler method with growing steps, dissipates energy and ends in a stable one. Undetermined states return
to their guesses.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from acausal.errors import InitializationError, caution
from acausal.policy import POLICY
from acausal.solve.diagnosis.initialization import unstable_text
from acausal.solve.initialization.equilibrium_test import at_rest, motion_text
from acausal.solve.initialization.independent_constraints import smallest_singular_value
from acausal.solve.initialization.minimum_norm_step import minimum_norm_step
from acausal.solve.initialization.pseudo_transient import relax
from acausal.solve.initialization.reduced_linearization import Linearizer, ReducedLinearization, moved
from acausal.solve.initialization.steady_rotation import changes, cyclic_spaces, steady_rotation
from acausal.solve.initialization.tangent_space import tangent
from acausal.solve.point import Point
from acausal.solve.problem import Problem

REST = POLICY.rest


class NoEquilibrium(InitializationError):
    """No equilibrium was found; `at` is the end of the pseudo-transient motion."""

    def __init__(self, text: str, at: Point) -> None:
        super().__init__(text)
        self.at = at


class EquilibriumSearch(Linearizer):
    """Search for an equilibrium, or a steady rotation, near a guess."""

    def find(self, first: Point | None = None) -> Point:
        """Return an equilibrium.

        Parameters
        ----------
        first : Point, optional
            A candidate.

        Raises
        ------
        InitializationError
            If no equilibrium is found, or the initial conditions do not hold in it.
        """
        found = self._checked(first)
        if found is None or self.far(self._offset(found)) > REST.turn:
            # Undamped Newton steps may end whole turns away.
            near = [here for here in (self._newton(self.guess), found) if here]
            found = min(near, key=self._distance, default=None)
        rate, push = (0.0, np.zeros(self.nx)) if found is None else self._instability(found)
        at = relaxed = self.guess
        for far, bent in () if found is not None and self._is_guess(found) else REST.limits:
            if found is not None and not rate:
                break
            relaxed = relax(self, at, far, bent)
            resting = self._newton(relaxed)
            if resting is not None:
                found = self._without_turns(resting)
                rate, push = self._instability(found)
                at = moved(found.point, push)
        if found is None:
            self.linearized(self.guess)  # raises if the equations fail at the guess
            nearest = self._least_rates(relaxed)
            if not self._is_steady(nearest):
                raise NoEquilibrium(motion_text(self.problem, nearest), relaxed)
            found = self.linearized(nearest)
            rate = self._instability(found)[0]
        if rate:
            singular = smallest_singular_value(self.problem, found.point) <= POLICY.loops.flat
            caution(unstable_text(self.problem.compiled, self.guess.time, rate, singular))
        return found.point

    def _checked(self, first: Point | None) -> ReducedLinearization | None:
        try:
            here = self.linearized(first) if first else None
        except InitializationError:
            return None
        return here if here and self._rests(here) else None

    def _is_guess(self, found: ReducedLinearization) -> bool:
        return bool(np.all(np.abs(self._offset(found)) <= REST.guess * self.scale))

    def _least_rates(self, relaxed: Point) -> Point:
        """Return the point of least rates, without the initial conditions: the remaining rates show what moves."""
        found = [self._search(at, conditions=False) for at in (self.guess, relaxed)]
        candidates = [here for here in found if here is not None]
        candidates.sort(key=lambda here: float(np.linalg.norm(self.still @ here.rates)))
        return candidates[0].point if candidates else self.guess

    def _newton(self, at: Point) -> ReducedLinearization | None:
        """Find an equilibrium from a point, then move undetermined states back to their guesses; None if none is found."""
        here = self._search(at)
        if here is None or not self._rests(here):
            return None
        part = 1.0
        for _ in range(REST.back):
            back = minimum_norm_step(*self._residuals(here, True), self._offset(here), self.scale)[1]
            if part < REST.short or np.max(np.abs(back) / self.scale, initial=0.0) <= REST.there:
                break
            there = self._search(moved(here.point, part * back))
            nearer = there is not None and self._distance(there) < (1 - part / 4) * self._distance(here)
            if there is not None and self._distance(there) < self._distance(here) and self._rests(there):
                here = there
            part = part if nearer else part / 2
        return here

    def _without_turns(self, here: ReducedLinearization) -> ReducedLinearization:
        """Take back whole turns from the guess, for coordinates that are in equilibrium without them as well."""
        for k in self.coordinates:
            back = np.zeros(self.nx)
            back[k] = 2 * np.pi * np.round(self._offset(here)[k] / (2 * np.pi))
            there = self._checked(self.problem.completed(moved(here.point, back))) if back[k] else None
            here = there or here
        return here

    def _rests(self, here: ReducedLinearization) -> bool:
        return self._is_steady(here.point)

    def _is_steady(self, at: Point) -> bool:
        if self.rotates:
            return steady_rotation(self.problem, at, [self.space]) is not None
        return at_rest(self.problem, at)

    def _offset(self, here: ReducedLinearization) -> np.ndarray:
        return self.guess.x - here.point.x

    def _distance(self, here: ReducedLinearization) -> float:
        return float(np.linalg.norm(self._offset(here) / self.scale))

    def _search(self, at: Point, conditions: bool = True) -> ReducedLinearization | None:
        """Take minimum-norm Newton steps while residuals decrease; None if the equations cannot be solved."""
        try:
            here = self.linearized(self.closed(at))
        except InitializationError:
            return None
        for _ in range(REST.newton):
            value, J = self._residuals(here, conditions)
            step = minimum_norm_step(value, J, np.zeros(self.nx), self.scale)[0]
            if np.max(np.abs(step) / (self.scale + np.abs(here.point.x)), initial=0.0) <= REST.converged:
                break
            there = self._damped(here, step, value, J, conditions)
            if there is None:
                break
            here = there
        return here

    def _damped(
        self, here: ReducedLinearization, step: np.ndarray, value: np.ndarray, J: np.ndarray, conditions: bool
    ) -> ReducedLinearization | None:
        """Shorten a step until the residuals decrease; None if they do not."""
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

    def _residuals(self, here: ReducedLinearization, conditions: bool) -> tuple[np.ndarray, np.ndarray]:
        """Residuals that must vanish, rates, initial conditions and constraints, and their Jacobian by the states."""
        J = self.still @ here.A
        if conditions:
            J = np.vstack([J, here.C])
        if self.problem.compiled.constraints.size:
            J = np.vstack([J, self.problem.constraints(here.point)[1].toarray()[self._independent(here)]])
        return self._values(here, conditions), J

    def _values(self, here: ReducedLinearization, conditions: bool) -> np.ndarray:
        value = self.still @ here.rates
        if conditions:
            value = np.concatenate([value, here.conditions])
        if self.problem.compiled.constraints.size:
            value = np.concatenate([value, self.problem.constraints(here.point)[0][self._independent(here)]])
        return value

    def _independent(self, here: ReducedLinearization) -> np.ndarray:
        """Mask of the independent constraints; scaled to length 1, round-off in redundant rows would constrain states."""
        return self.problem.compiled.constraints.counting(here.point.constants.closures)

    def _instability(self, here: ReducedLinearization) -> tuple[float, np.ndarray]:
        """Largest growth rate in 1/s, 0 if none exceeds round-off, and a small step along its eigenvector.

        Eigenvalues do not decide the stability of a rotation whose Jacobian changes with the angles: 0.
        """
        turn = steady_rotation(self.problem, here.point, [self.space]) if self.rotates else None
        if turn:
            there = self.linearized(turn.on(self.problem, here.point, 1.0))
            if changes(self.still @ here.A * self.scale, self.still @ there.A * self.scale).any():
                return 0.0, np.zeros(self.nx)
        N, independent = tangent(self.problem, here.point)
        size = self.scale[independent]
        A = (here.A @ N)[independent] * size / size[:, None]
        if not A.size:
            return 0.0, np.zeros(self.nx)
        values, vectors = np.linalg.eig(A)
        # Double zero eigenvalues, of free motions, split by the square root of round-off.
        floor = REST.split * np.sqrt(np.finfo(float).eps * float(np.max(np.abs(A))) * self.problem.feedback)
        real = np.where(np.real(values) > np.maximum(floor, REST.grows * np.abs(values)), np.real(values), 0.0)
        k = int(np.argmax(real))
        direction = N @ (size * np.real(vectors[:, k]))
        return float(real[k]), REST.push * direction / (
            self.far(direction) or float(np.max(np.abs(direction / self.scale)))
        )


def find_equilibrium(problem: Problem, at: Point, first: Point | None) -> Point:
    """Return an equilibrium near a guess; it does not depend on the feedback of invariants in a run.

    Parameters
    ----------
    problem : Problem
        The model.
    at : Point
        The guess, with closed loops.
    first : Point, optional
        A candidate.
    """
    own = replace(problem, feedback=REST.feedback)
    found = EquilibriumSearch(own, _with_feedback(at, own.feedback)).find(first and _with_feedback(first, own.feedback))
    return _with_feedback(found, problem.feedback)


def find_rotation(problem: Problem, at: Point) -> Point:
    """Return a point in steady rotation near a guess, see `find_equilibrium`."""
    own = replace(problem, feedback=REST.feedback)
    guess, failed = _with_feedback(at, own.feedback), InitializationError("no coordinate is cyclic")
    for space in cyclic_spaces(own, guess):
        try:
            return _with_feedback(EquilibriumSearch(own, guess, space).find(), problem.feedback)
        except InitializationError as error:
            failed = error
    raise failed


def _with_feedback(at: Point, feedback: float) -> Point:
    return replace(at, constants=replace(at.constants, feedback=feedback))
