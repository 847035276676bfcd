"""A run with breaks and events: integrate while nothing changes, stop where a condition changes, go on from there.

After an event the outputs are integrated in blocks of 1, 2, 4, ... intervals: their relative grids, and so the
integrators, are the same after each event.
"""

from __future__ import annotations

from collections import deque
from dataclasses import replace

import numpy as np

from acausal.errors import InitializationError, caution
from acausal.solve.between import work_between
from acausal.solve.instant import Cycling, Instants, Point, places_text
from acausal.solve.integrate import Failure, Integrator, Stretch
from acausal.solve.locate import FINE, Crossing, Locator, TooCoarse
from acausal.solve.passage import LONG, passage

MOST, WINDOW = 100, 1e-9  # events within this part of the run, or without any motion between them
# Pairs of rows of an interval, and steps of the integrator between two rows: in less than so many nothing turns back.
DENSEST, STEPS_A_ROW = 32, 4
# The same of all intervals, that there may be at least: few intervals are looked at as often as many.
ROWS = 400 * DENSEST
GOLDEN = (5**0.5 - 1) / 2


class Chattering(Exception):
    """Conditions change again and again at one time; `text` is the message."""


class Run:
    """Integration over all segments and events.

    Parameters
    ----------
    integrator : Integrator
        Integrates a segment.
    times : array
        Output times.
    breaks : list of float
        Times at which conditions of time alone change.
    declared : list of float
        Those of them that are no events, as they follow from parameters.
    """

    def __init__(self, integrator: Integrator, times: np.ndarray, breaks: list[float], declared: list[float]) -> None:
        self.integrator, self.times = integrator, times
        # A rounding error apart from an output, a break is on it.
        near = [float(times[np.argmin(np.abs(times - b))]) for b in breaks]
        self.breaks = [n if abs(n - b) <= 1e-13 * abs(b) else b for n, b in zip(near, breaks, strict=True)]
        self.found = {b for b, known in zip(self.breaks, breaks, strict=True) if known not in set(declared)}
        c, self.p = integrator.compiled, integrator.p
        self.guards, span = c.guards, float(times[-1] - times[0])
        settings = integrator.settings
        self.instants = Instants(c, self.p, settings.tolerance, span, settings.nominal)
        self.locator = Locator(integrator, self.instants)
        self.events: list[float] = []
        self.recent: deque[float] = deque(maxlen=MOST)
        self.weak, self.density, self.block = 0, 1, 0
        self.inclusive = np.array([self.guards.guards[k].inclusive for k in self.guards.timed], dtype=bool)
        self.first: Point | None = None
        self.hasty, self.piece = False, np.inf
        self.interval = float(times[-1] - times[0]) / (len(times) - 1)
        self.densest = max(DENSEST, ROWS // (len(times) - 1))

    def go(self, at: Point) -> None:
        """Go from break to break; the law of each segment holds up to its end."""
        ends = [*self.breaks, float(self.times[-1])]
        held = self._by_clock(at.time, ends[0])
        holds = held | self._on(at.time)
        acts = [k for k, on in zip(self.guards.timed, holds, strict=True) if on and self.guards.guards[k].at_start]
        self.first = at = self._happen(at, event=False, fired=acts)
        for end in ends:
            if at.time != self.times[0]:
                at = self._at_break(at, end, held)
                held = self._by_clock(at.time, end)
            at = self._segment(at, end)

    def _by_clock(self, begin: float, end: float) -> np.ndarray:
        """Which timed guards hold between two breaks."""
        return self._on((begin + end) / 2)

    def _on(self, time: float) -> np.ndarray:
        """Which timed guards hold at a time."""
        excess = self.guards.timed_excess(self.p, time)[0]
        return (excess < 0) | ((excess == 0) & self.inclusive)

    def _at_break(self, at: Point, end: float, held: np.ndarray) -> Point:
        """Switch what the clock switches; `held` tells which timed guards held before."""
        modes, fired = at.modes.copy(), []
        on = self._by_clock(at.time, end)
        changed = at.time in self.found and bool((on != held).any())
        if changed:
            self.events.append(at.time)
            self.block = 1
        for k, holds, before in zip(self.guards.timed, on, held, strict=True):
            if k < self.guards.n_switches:
                modes[k] = holds
            elif holds and not before:
                fired.append(k)
        new = self._happen(at, event=False, fired=fired, modes=modes)
        if changed:
            self.integrator.trace.put(-1, new.x, new.z, new.modes)
        return new

    def _segment(self, at: Point, end: float) -> Point:
        if not self.guards.watched:
            while at.time < end:
                grid = self._grid(at.time, end)
                x, z = self.integrator.segment(grid, at.x, at.z, at.modes)
                at = replace(at, time=float(grid[-1]), x=x, z=z, modes=self.integrator.trace.modes[-1][-1])
                self.block *= 2
        while at.time < end:
            at = self._advance(at, end)
            self.integrator.report(at.time)
        return at

    def _advance(self, at: Point, end: float) -> Point:
        """Integrate one stretch and go to its end, or to the first event in it."""
        grid = self._grid(at.time, end)
        stretch = self._integrate(at, grid)
        if stretch is None:
            return at if self.integrator.rescue(grid) else self._shorter(at, grid)
        if stretch.steps > STEPS_A_ROW * (len(stretch.times) + 3):
            if self.density < self.densest:
                needed = stretch.steps / (STEPS_A_ROW * (len(grid) - 1))
                self.density = 4 ** int(np.ceil(np.log(max(needed, 4 * self.density)) / np.log(4)))
            elif len(grid) > 2:
                self.block = max(1, (len(grid) - 1) // FINE)
            else:
                self.piece = float(grid[1] - grid[0]) / FINE
            return at
        try:
            crossing = self.locator.first(at, stretch, content=self.hasty)
        except TooCoarse:
            if self.density < self.densest:
                self.density *= 4
            else:
                self._warn_of_haste(at)
            return at
        except Failure:
            return self._shorter(at, grid)
        if crossing is None:
            self.integrator.keep(stretch)
            self.block *= 2
            self.piece *= 2
            return replace(at, time=float(stretch.times[-1]), x=stretch.x[-1], z=stretch.z[-1], modes=stretch.modes)
        return self._event(at, stretch, crossing)

    def _warn_of_haste(self, at: Point) -> None:
        self.hasty = True
        caution(
            f"from t = {at.time:.6g} s on, conditions turn faster than they are looked at, {2 * self.density} times an interval; "
            "one that changes and changes back in between is missed. One of these:\n"
            f"{places_text(self.integrator.compiled, self.instants.watched.tolist())}\n"
            "More intervals look more often: simulate(..., intervals=...)."
        )

    def _grid(self, now: float, end: float) -> np.ndarray:
        """Next times: all up to the end at first, blocks of equal intervals after an event."""
        ahead = self.times[(self.times > now) & (self.times < end)]
        grid = np.concatenate([[now], ahead, [end]])
        if now + self.piece < grid[1]:
            return np.array([now, now + self.piece])
        if not self.block:
            return grid
        steps = np.diff(grid)
        equal = int(np.argmin(np.append(np.isclose(steps, steps[0], rtol=1e-9), False)))
        return grid[: 1 + 2 ** int(np.log2(min(equal, self.block)))]

    def _integrate(self, at: Point, grid: np.ndarray) -> Stretch | None:
        n = len(grid) - 1
        pairs = self.density * (min(1.0, self.piece / self.interval) if n == 1 else 1.0)
        parts = 2 ** max(1 + int(np.ceil(np.log2(pairs))), int(np.log2(FINE / n)))
        # Uneven, so that no motion comes round from one row to the next all the time.
        share = 0.6 + 0.8 * (np.arange(n * parts) * GOLDEN % 1).reshape(n, parts)
        inside = np.cumsum(share, axis=1) / np.sum(share, axis=1, keepdims=True) * np.diff(grid)[:, None]
        fine = np.concatenate([grid[:1], (grid[:-1, None] + inside).ravel()])
        fine[::parts] = grid
        return self.integrator.attempt(fine, at.x, at.z, at.modes, max(1000, LONG // n), careful=False)

    def _shorter(self, at: Point, grid: np.ndarray) -> Point:
        """The call failed, perhaps because the law is no longer right beyond an event: look at less of the time."""
        if len(grid) > 2:
            self.block = max(1, (len(grid) - 1) // 8)
            return at
        for k in range(40):
            times = np.array([at.time, at.time + (grid[1] - at.time) / 2**k])
            if times[1] - times[0] <= self.locator.shortest:
                break
            stretch = passage(self.integrator, times, at.x, at.z, at.modes, hard=not k)
            try:
                crossing = self.locator.first(at, stretch, depth=1) if stretch else None
            except Failure:
                continue
            if stretch is None:
                continue
            if crossing:
                return self._event(at, stretch, crossing)
            self.integrator.keep(stretch)
            return replace(at, time=float(stretch.times[-1]), x=stretch.x[-1], z=stretch.z[-1], modes=stretch.modes)
        here = self.locator.row(at, at.time, at.x, at.z, at.modes)
        due = (here.rate < 0) & (here.value <= -here.rate * 1e-6 * self.instants.span)
        if not due.any():
            raise self.integrator.failure(float(grid[0]), float(grid[1]))
        return self._happen(at, event=True, due=due)

    def _event(self, at: Point, stretch: Stretch, crossing: Crossing) -> Point:
        """Keep what was before the event, let it happen, and go on from it."""
        after = crossing.after
        out = after.value <= 0
        width = self.instants.width(at)
        self.weak = self.weak + 1 if np.all(crossing.peak[out] <= width[out]) else 0
        delay = np.min(width[out] / np.maximum(np.abs(after.rate[out]), 1e-300), initial=np.inf)
        snap = min(float(delay), self.instants.span / (100 * (len(self.times) - 1)))
        times = np.array([*self.times, *self.breaks])
        near = times[np.argmin(np.abs(times - after.time))]
        on_output = abs(near - after.time) <= snap
        label = float(near) if on_output and near > at.time else after.time
        n = int(np.searchsorted(stretch.times, min(label, after.time)))
        if n:
            self.integrator.keep(stretch.rows(0, n))
        self._refuse_chattering(at, after.time, [int(k) for k in self.instants.watched[out]])
        last = (stretch.times[n - 1], stretch.x[n - 1], stretch.z[n - 1]) if n else (at.time, at.x, at.z)
        time, x, z = (np.array(pair) for pair in zip(last, (after.time, after.x, after.z), strict=True))
        gained = work_between(self.integrator, after.modes, time, x, z)
        reached = replace(at, time=max(label, after.time), x=after.x, z=after.z, modes=after.modes)
        new = self._happen(reached, event=True, crossed=out, label=label, energy=gained)
        if on_output and near == at.time:
            self.integrator.trace.put(-2, new.x, new.z, new.modes)
        self.block = 1
        if self.density > DENSEST:
            # Where there are many looks to an interval, there are many events: look no further than a few.
            self.piece = max(4 * (after.time - at.time), self.interval * DENSEST / self.density)
        return new

    def _happen(
        self,
        at: Point,
        event: bool,
        *,
        fired: list[int] | None = None,
        modes: np.ndarray | None = None,
        due: np.ndarray | None = None,
        crossed: np.ndarray | None = None,
        label: float | None = None,
        energy: np.ndarray | None = None,
    ) -> Point:
        """Let everything happen at an instant; record the values after it and what the stored energy lost."""
        try:
            new, changed = self.instants.settle(at, fired, modes, due, crossed)
        except Cycling as cycling:
            raise Chattering(self._text(at.time, cycling.guards, "switch back and forth")) from None
        except InitializationError as error:
            raise Failure(at.time, f"the equations have no solution after an event: {error}") from None
        if event and changed:
            self.events.append(at.time)
        gained = np.zeros(2) if energy is None else energy
        if self.integrator.settings.energy and changed:
            change = self._stored(new) - self._stored(at)
            gained = gained + np.array([max(change, 0.0), max(-change, 0.0)])
        if event:
            time = np.array([at.time if label is None else label])
            self.integrator.keep(Stretch(time, new.x[None], new.z[None], gained[None], new.modes, 0))
        elif fired:
            self.integrator.trace.put(-1, new.x, new.z, new.modes)
        self.integrator.trace.spend(np.zeros(2) if event else gained)
        return new

    def _stored(self, at: Point) -> float:
        return float(self.integrator.compiled.stored(at.x, at.z, self.p, at.time, at.modes)[0][0])

    def _refuse_chattering(self, at: Point, time: float, guards: list[int]) -> None:
        crowded = len(self.recent) == MOST and time - self.recent[0] <= WINDOW * self.instants.span
        self.recent.append(time)
        if crowded or self.weak >= MOST:
            raise Chattering(self._text(time, guards, f"changed {MOST} times with hardly any motion between"))

    def _text(self, time: float, guards: list[int], what: str) -> str:
        return (
            f"at t = {time:.6g} s the events do not come to an end; these conditions {what}:\n"
            f"{places_text(self.integrator.compiled, guards)}\n"
            "A body that bounces ever lower, or a force that changes sign with the speed, does that. Let a discrete "
            "variable hold it at rest (see rotational.Friction), add compliance (a spring and a damper), or use a law "
            "without a jump (smooth=True). What was computed is kept."
        )
