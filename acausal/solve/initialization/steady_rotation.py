"""Steady rotation: only cyclic coordinates change, at constant rates.

A cyclic coordinate enters no equation but its own (Goldstein 1980, section 8.2), such as the angle of a shaft. With rotors on
elastic shafts it is a sum of angles. Cyclic coordinates therefore span a space of directions: the largest one, among the
coordinates, that the Jacobian of the rates maps into itself and that is tangent to the constraints.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from acausal.compiler import CompiledModel
from acausal.compiler.memo import memoized
from acausal.errors import InitializationError
from acausal.policy import POLICY
from acausal.solve.initialization.equilibrium_test import (
    at_rest,
    derivatives,
    equations_hold,
    kinematic,
    loops_closed,
    rates_allowed,
)
from acausal.solve.initialization.newton import algebraic
from acausal.solve.initialization.reduced_linearization import Linearizer, moved
from acausal.solve.point import Point
from acausal.solve.problem import Problem

REST, RANKS = POLICY.rest, POLICY.ranks


@dataclass(frozen=True, eq=False)
class SteadyRotation:
    """A steady rotation.

    Attributes
    ----------
    space : array, shape (nx, k)
        Directions of the cyclic coordinates, see `cyclic_spaces`.
    rates : array, shape (nx,)
        Rates of the states: those of cyclic coordinates, all others 0.
    seconds : float
        Time in which the fastest of them, or of the coordinates prescribed in time if there are none, changes by its nominal
        value: 1 rad.
    """

    space: np.ndarray
    rates: np.ndarray
    seconds: float

    def on(self, problem: Problem, at: Point, turn: float) -> Point:
        """Return the point after a rotation by some nominal values; time advances only if it prescribes the rotation."""
        span = turn * self.seconds
        if not self.space.size:
            return algebraic(problem, replace(at, time=at.time + span))
        there = self._moved(problem, at, span * self.rates)
        if np.allclose(self.along(problem, there), self.rates, rtol=REST.still, atol=0.0):
            return there
        # Rates of quaternions depend on these: classical Runge-Kutta method.
        step, there = span / REST.parts, at
        for _ in range(REST.parts):
            k1 = self.along(problem, there)
            k2 = self.along(problem, self._moved(problem, there, step / 2 * k1))
            k3 = self.along(problem, self._moved(problem, there, step / 2 * k2))
            k4 = self.along(problem, self._moved(problem, there, step * k3))
            there = self._moved(problem, there, step / 6 * (k1 + 2 * k2 + 2 * k3 + k4))
        return there

    def along(self, problem: Problem, at: Point) -> np.ndarray:
        """Return the rates of the cyclic coordinates at a point, in rates of all states."""
        size = problem.nominal[: problem.nx]
        return size * (self.space @ (self.space.T @ (problem.local(at).value[: problem.nx] / size)))

    def others(self, problem: Problem, at: Point) -> np.ndarray:
        """Return the rates of the states without those of cyclic coordinates."""
        return problem.local(at).value[: problem.nx] - self.along(problem, at)

    def _moved(self, problem: Problem, at: Point, step: np.ndarray) -> Point:
        return algebraic(problem, problem.completed(moved(at, step)))


def cyclic_spaces(problem: Problem, at: Point) -> list[np.ndarray]:
    """Return spaces of cyclic coordinates near a point with closed loops.

    The first contains those that are cyclic in any position, the second those that may be cyclic in this one alone: in a
    symmetric position the loads on a rotor of two blades do not depend on its angle. The last one is empty, for rotations
    prescribed in time.

    Returns
    -------
    list of array, shape (nx, k)
        Orthonormal columns, in nominal values.
    """
    own, coordinates, by_time = Linearizer(problem, at), _candidates(problem.compiled), np.zeros((problem.nx, 0))
    if not len(coordinates):
        return [by_time]
    try:
        here = _jacobians(own, own.closed(at))
        near = _largest(own, [here], coordinates)
        random, rows = np.random.default_rng(0), [here]
        for _ in range(RANKS.motions if near.size else 0):
            step = RANKS.shake * own.scale * random.standard_normal(own.nx)
            rows.append(_jacobians(own, own.closed(moved(at, step))))
    except InitializationError:
        return [by_time]
    everywhere = _largest(own, rows, coordinates)
    found = [everywhere, near] if near.shape[1] > everywhere.shape[1] else [everywhere]
    return [*(space for space in found if space.size), by_time]


@memoized
def _candidates(compiled: CompiledModel) -> np.ndarray:
    """States that may be cyclic: coordinates, whose rates are differentiated or follow from other states alone."""
    system = compiled.reduced.plan.system
    states = list(compiled.reduced.plan.states)
    rates = {d for d in system.derivative if d >= 0}
    own = {
        k for k, v in enumerate(states) if system.derivative[v] >= 0 and system.derivative[system.derivative[v]] >= 0
    }
    own |= set(kinematic(compiled, True))
    return np.array(sorted(k for k in own if states[k] not in rates), dtype=int)


def is_steady(problem: Problem, at: Point) -> bool:
    """Return whether a consistent point is in equilibrium or in steady rotation."""
    return at_rest(problem, at) or steady_rotation(problem, at, cyclic_spaces(problem, at)) is not None


def cyclic_states(problem: Problem, at: Point) -> list[int]:
    """Return the states of cyclic coordinates, if a consistent point is in steady rotation."""
    found = None if at_rest(problem, at) else steady_rotation(problem, at, cyclic_spaces(problem, at))
    return np.flatnonzero(np.any(found.space, axis=1)).tolist() if found else []


def steady_rotation(problem: Problem, at: Point, spaces: list[np.ndarray]) -> SteadyRotation | None:
    """Return the steady rotation of a consistent point along one of some spaces; None if it is in none."""
    size, rates = problem.nominal[: problem.nx], problem.local(at).value[: problem.nx]
    if not np.all(np.isfinite(rates)) or not equations_hold(problem, at):
        return None
    allowed = rates_allowed(problem, at)
    for space in spaces:
        found = SteadyRotation(space, np.zeros(problem.nx), np.inf)
        found = replace(found, rates=found.along(problem, at))
        if not _vanishes(problem, at, rates - found.rates):
            continue
        fastest = float(np.max(np.abs(found.rates) / size, initial=0.0)) if space.size else _prescribed(problem, at)
        if fastest > 0 and (not space.size or np.any(np.abs(found.rates) > allowed)):
            found = replace(found, seconds=1 / fastest)
            if _stays_steady(problem, at, found):
                return found
    return None


def changes(here: np.ndarray, there: np.ndarray) -> np.ndarray:
    """Return which entries of a Jacobian, with columns in nominal values, differ between two points."""
    row = np.max(np.abs(here), axis=1, keepdims=True, initial=0.0)
    return np.abs(there - here) > REST.periodic * row + REST.faint * np.max(row, initial=0.0)


def _prescribed(problem: Problem, at: Point) -> float:
    """Largest rate of a coordinate that is prescribed in time, in nominal values; 0 if one accelerates."""
    flat, system = problem.compiled.reduced.flat, problem.compiled.reduced.plan.system
    _, call, _, variables = derivatives(problem.compiled)
    values = np.abs(call(at.x, at.z, problem.p, at.time, at.constants.vector, 0.0)[0][: len(variables)])
    nominal = np.append(flat.unknowns.nominal, np.ones(system.n_variables - len(flat.unknowns.nominal)))[variables]
    is_rate = np.isin(variables, [d for d in system.derivative if d >= 0])
    accelerates = np.any(values[is_rate] > REST.still * nominal[is_rate])
    return 0.0 if accelerates else float(np.max((values / nominal)[~is_rate], initial=0.0))


def _stays_steady(problem: Problem, at: Point, found: SteadyRotation) -> bool:
    """Return whether other rates vanish at other angles and times as well, which they do not while a drive accelerates."""
    try:
        later = algebraic(problem, replace(at, time=at.time + REST.later * found.seconds))
        turned = [found.on(problem, at, turn) for turn in REST.turns]
    except InitializationError:
        return False
    if not _vanishes(problem, later, problem.local(later).value[: problem.nx] - found.rates):
        return False
    return all(_vanishes(problem, there, found.others(problem, there)) for there in turned)


def _vanishes(problem: Problem, at: Point, rates: np.ndarray) -> bool:
    """Return whether rates vanish within tolerance and loops are closed."""
    own = Linearizer(problem, at).rows
    return bool(np.all(np.abs(rates[own]) <= rates_allowed(problem, at)[own])) and loops_closed(problem, at)


def _jacobians(own: Linearizer, at: Point) -> tuple[np.ndarray, np.ndarray]:
    """Jacobian of rates, in nominal values, and constraints by the states; and the size of the terms of each row."""
    here = own.linearized(at)
    gradients = (
        own.problem.scaled_gradients(at).toarray() if own.problem.compiled.constraints.size else np.zeros((0, own.nx))
    )
    J = np.vstack([here.A * own.scale / own.scale[:, None], gradients])
    most = np.concatenate([here.adds_up(own.scale) / own.scale, np.linalg.norm(gradients, axis=1)])
    return J, np.where(most > 0, most, 1.0)


def _largest(own: Linearizer, found: list[tuple[np.ndarray, np.ndarray]], coordinates: np.ndarray) -> np.ndarray:
    """Largest space of coordinates that all Jacobians of the rates map into itself, and those of constraints to 0."""
    space = np.eye(own.nx)[:, coordinates]
    counts = np.setdiff1d(np.arange(found[0][0].shape[0]), np.setdiff1d(np.arange(own.nx), own.rows))
    while space.size:
        out = list[np.ndarray]()
        for J, most in found:
            rates = J @ space
            rates[: own.nx] -= space @ (space.T @ rates[: own.nx])
            size = most.copy()
            size[coordinates] = np.max(most[coordinates])  # the projection mixes them
            out.append((rates / size[:, None])[counts])
        _, s, V = np.linalg.svd(np.vstack(out), full_matrices=True)
        rank = int(np.sum(s > RANKS.rank * RANKS.small))
        if not rank:
            break
        space = space @ V[rank:].T
    return np.where(np.abs(space) > RANKS.rank, space, 0.0)
