"""Steps whose size follows from their error: pairs of steps of order 4 against one of twice the size.

Pairs of orders 5 and 4 have less error, but follow undamped vibrations less far: that of Dormand and Prince with 7 evaluations to
dt omega = 1.0, a pair with 12 of them to 2 x 2.83; and fast vibrations bound the steps of most bodies.
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

# Two steps of order 4 have 1 / 15 of the difference to one of twice the size as their error.
RICHARDSON = 1 / 15
# The error in proportion to the time goes with the step to the power of 4; the aim is what is below the tolerance by a margin,
# and a step changes by no more than that between two blocks.
POWER, AIM, LEAST, GROWTH = -1 / 4, 0.8, 0.2, 2.0
# Of a run: a pair that is shorter may err by as much as one of this length, or none could pass a jump of a load. One of this part
# of the tolerance is taken whatever its error: a load that jumps in it does less in it than that of what it does in the run.
SHARE = 1e-3
# Of a motion that deflects the body by DEFLECTION of its size at its first frequency: less of it is rest, where rounding is all.
REST = 1e-6
# Of a run of a rigid body, whose steps no frequency bounds: the first one.
FIRST = 1e-2
# Pairs that are taken without Python in between: with so many it has about a tenth of the time, and as many are taken in vain
# where the first of them is too long.
LONGEST = 32


def pair(body: FreeModes, maps: tuple[Array, Array], stop_time: float, x: Any, u: Any) -> tuple[Any, Any]:
    """Two steps and one of twice the size.

    Parameters
    ----------
    body : FreeModes
        The body.
    maps : two arrays
        Of its loads, see `Inputs`.
    stop_time : float
        Time of the run in s, in which errors of places are as large as those of speeds.
    x : Expr, shape (15 + 2 N,)
        State at the start.
    u : Expr
        A row of `Inputs.pairs`.

    Returns
    -------
    state, values : Expr
        State after the second step; v' at the start, the state after the first step, v' there, and squares of speeds as
        `_Sizes` needs them.
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
    """Rotation vector of a small turn."""
    return as_expr([R[2, 1] - R[1, 2], R[0, 2] - R[2, 0], R[1, 0] - R[0, 1]]) / 2


def _inner(body: FreeModes, w: Any, v: Any, q: Any) -> Any:
    """Square of the mean speed of the points of a body beside its translation, the amplitudes as speeds of the same energy."""
    found = w @ (as_expr(body.inertia) @ w)
    if body.body.n:
        found = found + v @ (as_expr(body.body.M) @ v) + q @ (as_expr(body.body.K) @ q)
    return found / body.body.mass


class _Sizes:
    """Errors of pairs of steps in parts of what they may be.

    An error is a speed, the root mean square over the mass of the body: that of its velocities, that of its places over
    the time of the run, and that of the same elastic energy. It counts against the largest speed that there was, of
    translation apart from all other motion, and against the part that the pair has of the tolerance, in proportion to its time:
    the errors of all steps together then are the tolerance at most.
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
        """Errors of each pair, 1 where they are as large as they may be, from the last four values of `pair`."""
        outer, inner = np.maximum.accumulate(np.vstack([self.most, squares[:, 2:]]))[1:].T
        parts = np.column_stack([squares[:, 0], squares[:, 1]]), np.column_stack([outer + inner, inner])
        ratios = np.divide(*parts, out=np.where(parts[0] == 0, 0.0, np.inf), where=parts[1] > 0)
        share = max(2 * dt / self.stop_time, SHARE) * self.tolerance
        return RICHARDSON * np.sqrt(ratios.max(axis=1)) / share

    def take(self, squares: Array) -> None:
        """Remember the speeds of pairs that are kept."""
        self.most = np.maximum(self.most, squares[:, 2:].max(axis=0, initial=0.0))


class _Run:
    """A run under control.

    Parameters
    ----------
    modes : FreeModes
        The body.
    inputs : Inputs
        What acts on it.
    start : array, shape (15 + 2 N,)
        State at the start.
    breaks : array
        Times in s at which steps end, the stop time last.
    tolerance : float
        What the errors of all steps may be.
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
        # Times, states and rates, appended at once: an interrupt may come anywhere.
        self.kept: list[tuple[Array, Array, Array]] = []

    @property
    def taken(self) -> int:
        """Number of steps."""
        return sum(len(times) for times, _, _ in self.kept)

    def block(self, end: float) -> bool:
        """Take pairs towards a break, and return whether it is reached."""
        pairs = max(int(np.ceil((end - self.time) / (2 * self.dt) - WHOLE)), 1)
        dt = (end - self.time) / (2 * pairs)
        count = 1 << (min(self.length, pairs).bit_length() - 1)
        states, values = self.step(self.state, self.inputs.pairs(self.time, dt, count))
        errors = self.sizes.errors(values[:, -4:], dt)
        fits = errors <= 1  # false for what is no number
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
        """Rows for the start of each step, with the rates there."""
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
                f"after {self.taken} steps the motion holds more than {MOST:g} numbers, at t = {end:.6g} s: a load may be no "
                "function of the time alone. Take a larger tolerance, or a shorter run",
                self.motion(),
            )

    def finish(self) -> None:
        """Take the rates at the stop time."""
        row = np.hstack([[[self.dt]], *[self.inputs.at(np.array([self.stop_time]))] * 5])
        _, values = self.step(self.state, row)
        self.kept.append((np.array([self.stop_time]), self.state[None], values[:, : self.modes.size]))

    def motion(self) -> FrameMotion:
        """What there is."""
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
    """Move a body by steps of the size that a tolerance allows.

    Parameters
    ----------
    modes : FreeModes
        The body.
    inputs : Inputs
        What acts on it.
    start : array, shape (15 + 2 N,)
        State at the start.
    breaks : array
        Times in s at which loads break, the stop time last.
    times : array
        Times in s that are kept, of the start and after; all if there are none.
    tolerance : float
        What the errors of all steps may be, as a part of the largest speed of the points of the body.
    progress : callable or None
        Told the part of the run that is done, and the steps.

    Raises
    ------
    SimulationError
        If the motion diverges, or has too many steps; `result` holds what was computed.
    KeyboardInterrupt
        With what was computed as its attribute `result`.
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
