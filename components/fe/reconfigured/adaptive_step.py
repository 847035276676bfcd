"""Step size control by step doubling: two steps of order 4 against one of twice the size (Richardson extrapolation).

Embedded pairs of orders 5 and 4 have smaller errors, but a smaller stability limit for undamped vibrations, which
bounds the steps of most bodies: dt omega = 1.0 for Dormand-Prince with 7 evaluations, 2 x 2.83 for two steps with 12
evaluations.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from typing import Any

import numpy as np

from acausal import CompiledStep, March, SimulationError, as_expr
from components.fe.arrays import Array
from components.fe.body.modal_properties import DEFLECTION
from components.fe.reconfigured.free_modes import FreeModes
from components.fe.reconfigured.load import apart
from components.fe.reconfigured.motion import FrameMotion
from components.fe.reconfigured.step_inputs import Inputs
from components.fe.reconfigured.step_limits import BELOW, MOST, WHOLE, bounds, diverged, limit
from components.fe.reconfigured.steps import Loads, State, corrected

# Error of two steps of order 4, relative to their difference from one step of twice the size.
RICHARDSON = 1 / 15
# Controller: the error per unit time scales with the step to the power of 4; AIM is the safety factor, LEAST and GROWTH
# bound the change of the step between two blocks.
POWER, AIM, LEAST, GROWTH = -1 / 4, 0.8, 0.2, 2.0
# Length of a pair relative to the run: shorter pairs may have the error of one of this length, as otherwise none could
# pass a load jump. A pair shorter than SHARE times the tolerance of the run is accepted with any error, because the
# impulse of a load within it is that small.
SHARE = 1e-3
# Speed that counts as rest, relative to a vibration with amplitude DEFLECTION at the first frequency: below it,
# round-off dominates the error.
REST = 1e-6
# First step of a rigid body relative to the run: no frequency bounds it.
FIRST = 1e-2
# Longest block of pairs evaluated in one call: Python then takes a tenth of the time. If the first pair of a block
# fails, the others are wasted.
LONGEST = 32


def pair(body: FreeModes, maps: tuple[Array, Array], stop_time: float, x: Any, u: Any) -> tuple[Any, Any]:
    """Take two steps, and one of twice the size.

    Parameters
    ----------
    body : FreeModes
        The body.
    maps : two arrays
        Maps of its loads, see `Inputs`.
    stop_time : float
        Length of the run in s, which converts errors of positions to errors of speeds.
    x : Expr, shape (15 + 2 N,)
        State at the start.
    u : Expr
        A row of `Inputs.pairs`.

    Returns
    -------
    state, values : Expr
        State after the second step; v' at the start, the state after the first step, v' there, and the squared speeds
        that `_Sizes` needs.
    """
    size = 3 + sum(part.shape[1] for part in maps)
    dt, instants = u[0], [u[1 + k * size : 1 + (k + 1) * size] for k in range(5)]

    def loads(*which: int) -> Loads:
        return Loads(*maps, as_expr([value for k in which for value in instants[k]]))

    start = State.of(x)
    half, rates = corrected(body, loads(0, 1, 2), start, dt)
    whole, between = corrected(body, loads(2, 3, 4), State.of(half), dt)
    coarse, _ = corrected(body, loads(0, 2, 4), start, 2 * dt)
    found, rough = State.of(whole), State.of(coarse)
    moved, turned = (found.O - rough.O) / stop_time, _turn(found.A @ rough.A.T) / stop_time
    v, q = found.v - rough.v, (found.q - rough.q)[6:]
    outer = moved @ moved + v[:3] @ v[:3]
    inner = _inner(body, v[3:6], v[6:], q) + _inner(body, turned, 0 * v[6:], 0 * q)
    speeds = found.v[:3] @ found.v[:3], _inner(body, found.v[3:6], found.v[6:], found.q[6:])
    return whole, as_expr([*rates, *half, *between, outer, inner, *speeds])


def _turn(R: Any) -> Any:
    """Return the rotation vector of a small rotation."""
    return as_expr([R[2, 1] - R[1, 2], R[0, 2] - R[2, 0], R[1, 0] - R[0, 1]]) / 2


def _inner(body: FreeModes, w: Any, v: Any, q: Any) -> Any:
    """Return the mean square speed of rotation and deformation; elastic energy counts as kinetic energy."""
    found = w @ (as_expr(body.inertia) @ w)
    if body.body.n:
        found = found + v @ (as_expr(body.body.M) @ v) + q @ (as_expr(body.body.K) @ q)
    return found / body.body.mass


class _Sizes:
    """Errors of pairs of steps relative to their limits.

    An error is a speed, root mean square over the mass of the body: of its velocities, of its positions divided by the
    length of the run, and of equal elastic energy. It is relative to the largest speed so far, separately for
    translation and all other motion, and to the share of the pair in the tolerance, proportional to its duration. The
    sum of all errors is then at most the tolerance.
    """

    def __init__(self, body: FreeModes, start: Array, stop_time: float, tolerance: float) -> None:
        reduced, N = body.body, body.size
        v, q = start[15 + N :], start[21 : 15 + N]
        inner = (v[3:6] @ body.inertia @ v[3:6] + v[6:] @ reduced.M @ v[6:] + q @ reduced.K @ q) / reduced.mass
        rest = 0.0
        if reduced.n:
            size = np.sqrt(np.trace(reduced.second_moment) / reduced.mass)
            rest = REST * DEFLECTION * size * 2 * np.pi * reduced.frequencies[0]
        self.most = np.array([v[:3] @ v[:3], max(float(inner), rest**2)])
        self.stop_time, self.tolerance = stop_time, tolerance

    def errors(self, squares: Array, dt: float) -> Array:
        """Return the relative error of each pair, at most 1 if accepted, from the last four values of `pair`."""
        outer, inner = np.maximum.accumulate(np.vstack([self.most, squares[:, 2:]]))[1:].T
        parts = np.column_stack([squares[:, 0], squares[:, 1]]), np.column_stack([outer + inner, inner])
        ratios = np.divide(*parts, out=np.where(parts[0] == 0, 0.0, np.inf), where=parts[1] > 0)
        share = max(2 * dt / self.stop_time, SHARE) * self.tolerance
        return RICHARDSON * np.sqrt(ratios.max(axis=1)) / share

    def take(self, squares: Array) -> None:
        """Update the largest speeds by accepted pairs."""
        self.most = np.maximum(self.most, squares[:, 2:].max(axis=0, initial=0.0))


class _Run:
    """A run with step size control.

    Parameters
    ----------
    modes : FreeModes
        The body.
    inputs : Inputs
        Loads and gravity.
    start : array, shape (15 + 2 N,)
        State at the start.
    breaks : array
        Times in s at which steps must end, the stop time last.
    tolerance : float
        Limit of the sum of all errors.
    """

    def __init__(self, modes: FreeModes, inputs: Inputs, start: Array, breaks: Array, tolerance: float) -> None:
        self.modes, self.inputs, self.breaks, self.tolerance = modes, inputs, breaks, tolerance
        self.N, self.stop_time = modes.size, float(breaks[-1])
        columns = inputs.pairs(0.0, 1.0, 1).shape[1]
        self.step = CompiledStep(lambda x, u: pair(modes, inputs.maps, self.stop_time, x, u), len(start), columns)
        self.sizes = _Sizes(modes, start, self.stop_time, tolerance)
        most, _ = limit(modes)
        self.most = BELOW * most
        self.shortest = tolerance * SHARE * self.stop_time
        self.dt = min(self.most, FIRST * self.stop_time)
        self.time, self.state, self.length, self.rejected = 0.0, start, 1, 0
        # Times, states and rates, appended together: an interrupt may come at any time.
        self.kept: list[tuple[Array, Array, Array]] = []

    @property
    def taken(self) -> int:
        """Number of steps."""
        return sum(len(times) for times, _, _ in self.kept)

    def block(self, end: float) -> bool:
        """Take a block of pairs towards a break; return whether the break is reached."""
        pairs = max(int(np.ceil((end - self.time) / (2 * self.dt) - WHOLE)), 1)
        dt = (end - self.time) / (2 * pairs)
        count = 1 << (min(self.length, pairs).bit_length() - 1)
        states, values = self.step(self.state, self.inputs.pairs(self.time, dt, count))
        errors = self.sizes.errors(values[:, -4:], dt)
        fits = errors <= 1  # False for NaN
        good = count if fits.all() else int(np.argmin(fits))
        if not good and 2 * dt <= self.shortest:
            if not np.isfinite(values[0]).all():
                raise SimulationError(
                    diverged(self.modes, self.motion().w, self.taken + 1, self.time, dt), self.motion()
                )
            good = 1
        self._keep(states[:good], values[:good], dt)
        reached = good == pairs
        self.time = end if reached else self.time + 2 * dt * good
        self.rejected += 2 * (count - good)
        worst = errors[: good + 1].max()
        factor = np.clip(AIM * max(worst, 1e-10) ** POWER, LEAST, GROWTH) if np.isfinite(worst) else LEAST
        wanted = dt * factor if good < count else max(dt * factor, self.dt * min(factor, 1.0))
        wanted = min(max(wanted, self.shortest / 2), self.most)
        self.dt, self.length = wanted, min(2 * self.length, LONGEST) if good == count else 1
        return reached

    def _keep(self, states: Array, values: Array, dt: float) -> None:
        """Append rows for the start of each step, with the rates there."""
        if not len(states):
            return
        n = self.modes.size
        size = states.shape[1]
        starts = np.vstack([self.state, states[:-1]])
        halves = values[:, n : n + size]
        rows = np.stack([starts, halves], axis=1).reshape(-1, size)
        rates = np.stack([values[:, :n], values[:, n + size : 2 * n + size]], axis=1).reshape(-1, n)
        times = self.time + dt * np.arange(len(rows))
        inside: Any = (np.abs(np.vstack([rows[1:], states[-1:]])) <= bounds(self.modes)).all(axis=1)
        kept = len(rows) if inside.all() else int(np.argmin(inside)) + 1
        self.kept.append((times[:kept], rows[:kept], rates[:kept]))
        end = float(times[kept - 1] + dt)
        if kept < len(rows) or not inside[-1]:
            raise SimulationError(diverged(self.modes, self.motion().w, self.taken, end, dt), self.motion())
        self.sizes.take(values[:, -4:])
        self.state = states[-1]
        if self.taken * (15 + 2 * n) > MOST:
            raise SimulationError(
                f"after {self.taken} steps, at t = {end:.6g} s, the motion has more than {MOST:g} numbers: a load may depend on "
                "more than the time. Use a larger tolerance or a shorter run",
                self.motion(),
            )

    def finish(self) -> None:
        """Append the row of the stop time."""
        row = np.hstack([[[self.dt]], *[self.inputs.at(np.array([self.stop_time]))] * 5])
        _, values = self.step(self.state, row)
        self.kept.append((np.array([self.stop_time]), self.state[None], values[:, : self.modes.size]))

    def motion(self) -> FrameMotion:
        """Return the motion so far."""
        step, none = self.step, (np.empty(0), np.empty((0, len(self.state))), np.empty((0, self.modes.size)))
        times, states, outputs = (np.concatenate(parts) for parts in zip(none, *self.kept, strict=True))
        found = March(states, outputs, False, step.operations, step.building, step.seconds)
        breaks = tuple(float(t) for t in self.breaks[:-1])
        counts = {"steps": max(len(times) - 1, 0), "rejected": self.rejected}
        return FrameMotion(
            self.modes, times, states, outputs, "corrected", found, tolerance=self.tolerance, breaks=breaks, **counts
        )


def controlled(
    modes: FreeModes,
    inputs: Inputs,
    start: Array,
    breaks: Array,
    times: Array,
    tolerance: float,
    progress: Callable[[float, int], None] | None,
) -> FrameMotion:
    """Move a body by steps whose size follows from a tolerance.

    Parameters
    ----------
    modes : FreeModes
        The body.
    inputs : Inputs
        Loads and gravity.
    start : array, shape (15 + 2 N,)
        State at the start.
    breaks : array
        Times in s at which loads are not smooth, the stop time last.
    times : array
        Output times in s, including the start; if empty, the end of each step.
    tolerance : float
        Limit of the sum of all errors, relative to the largest speed of the points of the body.
    progress : callable or None
        Called with the completed fraction of the run and the number of steps.

    Raises
    ------
    SimulationError
        If the motion diverges or has too many steps; `result` holds the motion until then.
    KeyboardInterrupt
        With the motion until then as attribute `result`.
    """
    run = _Run(modes, inputs, start, breaks, tolerance)
    try:
        for end in apart(np.concatenate([breaks, times[1:]]), run.stop_time):
            reached = False
            while not reached:
                reached = run.block(float(end))
                if progress is not None:
                    progress(run.time / run.stop_time, run.taken)
        run.finish()
    except KeyboardInterrupt as interrupt:
        interrupt.result = run.motion()  # type: ignore[attr-defined]
        raise
    found = run.motion()
    if not len(times):
        return found
    rows = np.abs(found.time[:, None] - times).argmin(axis=0)
    return replace(found, time=times, states=found.states[rows], outputs=found.outputs[rows])
