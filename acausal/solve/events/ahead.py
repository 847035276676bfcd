"""What lies ahead of a point in a segment: a leg of it, and the first event in that."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from acausal.errors import InitializationError, caution
from acausal.policy import POLICY
from acausal.solve.events.instant import Instants
from acausal.solve.events.locate import Crossing, Locator, TooCoarse, Undecided
from acausal.solve.events.stride import Stride
from acausal.solve.initialization.initial_modes import origins_text
from acausal.solve.integrate.attempt import Integrator
from acausal.solve.integrate.ladder import Failure, Kind, Refusal, accepted, next_ways
from acausal.solve.integrate.march import March
from acausal.solve.integrate.order_trial import choose, is_open
from acausal.solve.integrate.segment import passage
from acausal.solve.integrate.trace import Leg
from acausal.solve.point import Point

LOOKS = POLICY.looks


@dataclass(frozen=True)
class Found:
    """What lies ahead.

    Attributes
    ----------
    at : Point
        Where the leg begins; without one, where to try again.
    leg : Leg, optional
        What was integrated.
    crossing : Crossing, optional
        The first event in it, which may lie before its end.
    due : array of bool, optional
        Watched conditions that change at the point itself, as nothing leads on from it.
    """

    at: Point
    leg: Leg | None = None
    crossing: Crossing | None = None
    due: np.ndarray | None = None


class Ahead:
    """Looks ahead in the segments of a run.

    Parameters
    ----------
    integrator : Integrator
        Integrates the run.
    instants : Instants
        Watched conditions.
    times : array
        Output times in s.

    Attributes
    ----------
    locator : Locator
        Finds the events.
    stride : Stride
        How far one looks at once, and how closely.
    step : float
        First step in s of what follows; chosen if 0.
    """

    def __init__(self, integrator: Integrator, instants: Instants, times: np.ndarray) -> None:
        self.integrator, self.instants = integrator, instants
        self.locator, self.stride = Locator(integrator, instants), Stride(times)
        self._march: March | None = None
        self.step, self._hasty = 0.0, False

    def begin(self, step: float = 0.0) -> None:
        """Try a step first in what follows, or choose it anew."""
        self.step = step

    def look(self, at: Point, end: float) -> Found:
        """Integrate some way towards the end of a segment, and look for an event there."""
        if self.integrator.compiled.nx:
            return self._marched(at, end)
        integrator = self.integrator
        grid = integrator.next_call(at, self.stride.grid(at.time, end))[0]
        way = integrator.settings.first(integrator.way, grid)
        leg = integrator.attempt(at, self.stride.looks(grid), way)
        if isinstance(leg, Refusal) and leg.kind is Kind.UNFIT:
            integrator.reach.ended(leg.time - at.time)
            return Found(at)
        if isinstance(leg, Refusal):
            return self._otherwise(at, grid, leg)
        if not self.stride.is_enough(leg, grid):
            return Found(at)
        try:
            crossing = self._crossing(at, leg)
        except TooCoarse:
            self._look_closer(at)
            return Found(at)
        except Undecided:
            raise
        except Failure as failure:
            return self._shorter(at, grid, failure)
        if crossing is None:
            self.stride.lengthen()
            integrator.lasted(float(grid[-1] - grid[0]))
        return Found(at, leg, crossing)

    def _marched(self, at: Point, end: float) -> Found:
        """Take some steps of the core and look at them."""
        march = self._march
        if march is None or not march.goes_on(at, end):
            outputs = self.stride.outputs(at.time, end)
            try:
                march = self._march = March(self.integrator, at, outputs, self.step)
            except InitializationError:
                return self._otherwise(at, self.stride.grid(at.time, end), Refusal(Kind.UNSOLVABLE, at.time))
        leg = march.go(self.stride.density)
        while leg:
            try:
                crossing = self._crossing(at, leg)
            except TooCoarse:
                self._look_closer(at)
                leg = march.leg(self.stride.density)
                continue
            if crossing and march.is_coarse(crossing.after.time):
                self.step, self._march = LOOKS.fine * (crossing.after.time - at.time), None
                return Found(at)
            kept = march.keep(leg, crossing.after.time if crossing else np.inf)
            if kept:
                self.step, self._march = march.step, None if crossing or march.unfit else march
                return Found(at, kept, crossing)
            break
        return self._refused(at, end, march)

    def _refused(self, at: Point, end: float, march: March) -> Found:
        """Where to go on from when the core gave up."""
        integrator, before = self.integrator, self.integrator.way.method
        self._march, careful = None, integrator.settings.careful
        refusal = march.refusal or Refusal(Kind.OTHER, at.time)
        if march.unfit:
            self.step = (refusal.time - at.time) / 2 or march.step
            return Found(at)
        found = self._otherwise(at, self.stride.grid(at.time, end), refusal)
        if not integrator.loops or found.leg or found.due is not None:
            return found
        if integrator.way.method == before != careful:
            integrator.take(replace(integrator.way, method=careful), refusal)
        # Near a flat position of a loop no method can begin: another one takes the whole segment.
        return Found(march.withdrawn()) if integrator.way.method != before else found

    def _crossing(self, at: Point, leg: Leg) -> Crossing | None:
        """The first event in a leg; its rows are kept up to where a condition has no value."""
        try:
            return self.locator.first(at, leg, content=self._hasty)
        except Undecided as failure:
            if n := int(np.searchsorted(leg.times, failure.time)):
                self.integrator.trace.add(leg.part(0, n))
            raise

    def _look_closer(self, at: Point) -> None:
        if not self.stride.look_closer():
            self.tell_of_haste(at.time)

    def tell_of_haste(self, time: float) -> None:
        """Warn once that samples may miss a change of a condition."""
        if self._hasty:
            return
        self._hasty = True
        caution(
            f"from t = {time:.6g} s on, conditions change faster than they are checked, {2 * self.stride.density} times an "
            "interval; a change that reverts in between is missed. One of these:\n"
            f"{origins_text(self.integrator.compiled, self.instants.watched.tolist())}\n"
            "More intervals mean more checks: simulate(..., intervals=...)."
        )

    def _otherwise(self, at: Point, grid: np.ndarray, refusal: Refusal) -> Found:
        """Try in another way, or over a shorter time, as the law may no longer be valid beyond an event."""
        integrator, settings = self.integrator, self.integrator.settings
        if refusal.kind is Kind.STEPS and is_open(integrator, grid) and integrator.order == settings.max_order:
            choose(integrator, at, grid[:2])
            if integrator.order != settings.max_order:
                return Found(at)
        following = next_ways(integrator.way, refusal, settings.rescues(grid, integrator.loops))
        if integrator.loops and refusal.kind is Kind.CORRECTOR and integrator.way.method == settings.careful:
            # Beside a flat position a shorter time helps, and there each method in turn; no other one is taken for good.
            following = tuple(way for way in following if way.method == settings.careful)
        if integrator.loops and not following and integrator.way.method == settings.methods[0] != settings.careful:
            following = (replace(integrator.way, method=settings.careful),)
        if not following:
            return self._shorter(at, grid, Failure.of(refusal))
        integrator.take(following[0], refusal)
        return Found(at)

    def _closely(self, at: Point, times: np.ndarray, passes: bool) -> Leg | Refusal | None:
        """Integrate an interval carefully, and look as closely into it as its steps ask for; None where it is to be shorter.

        By every means, if it `passes` in no other way: then its ends alone are seen.
        """
        integrator = self.integrator
        way = replace(integrator.way, max_steps=POLICY.rescue.long, careful=True)
        while True:
            density = self.stride.density
            leg = integrator.attempt(at, self.stride.looks(times), way)
            passed = passes and isinstance(leg, Refusal)
            leg = passage(integrator, at, times, 1) if passed else leg
            if isinstance(leg, Refusal) or self.stride.is_enough(leg, times):
                return leg
            if passed and self.stride.piece > LOOKS.fine * self.locator.shortest:
                return None
            if self.stride.density == density:
                return leg

    def _shorter(self, at: Point, grid: np.ndarray, failure: Failure) -> Found:
        """Shorten the time: the law may no longer be valid beyond an event."""
        if self.stride.shorten(grid):
            return Found(at)
        if failure.kind is Kind.STEPS and self.stride.cut(failure.time - at.time, self.locator.shortest):
            return Found(at)
        for k in range(POLICY.locate.halvings):
            times = np.array([at.time, at.time + (grid[1] - at.time) / 2**k])
            if times[1] - times[0] <= self.locator.shortest:
                break
            leg = self._closely(at, times, passes=not k)
            if leg is None:
                return Found(at)
            try:
                return Found(at, accepted(leg), self.locator.first(at, accepted(leg), depth=1))
            except Failure as later:
                failure = later
        here = self.locator.sample(at, at)
        due = (here.rate < 0) & (here.value <= -here.rate * POLICY.instants.due * self.instants.span)
        if not due.any():
            raise failure
        return Found(at, due=due)
