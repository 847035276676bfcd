"""A run with breaks and events: integrate while nothing changes, stop where a condition changes, continue from there."""

from __future__ import annotations

from collections import deque
from contextlib import suppress
from dataclasses import replace
from typing import Any

import numpy as np

from acausal.compiler.constants import Constants
from acausal.errors import InitializationError, caution
from acausal.policy import POLICY
from acausal.solve.causes import cause
from acausal.solve.events.agenda import Agenda
from acausal.solve.events.between import work_between
from acausal.solve.events.chattering import Chattering
from acausal.solve.events.instant import Cycling, Instants
from acausal.solve.events.locate import Crossing, Locator, TooCoarse, Undecided
from acausal.solve.events.many import warn_of_many
from acausal.solve.events.stride import Stride
from acausal.solve.integrate.attempt import Integrator
from acausal.solve.integrate.ladder import Failure, Kind, Refusal, accepted, next_ways
from acausal.solve.integrate.march import March
from acausal.solve.integrate.methods import METHODS
from acausal.solve.integrate.order_trial import choose, is_open
from acausal.solve.integrate.segment import passage, segment
from acausal.solve.integrate.trace import Leg
from acausal.solve.points import Point, Rows
from acausal.solve.start.newton import Lost
from acausal.solve.start.start import places_text
from acausal.solve.undecided import undecided

INSTANTS = POLICY.instants


class Course:
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
        Those of them that are not events, as they follow from parameters.
    """

    def __init__(self, integrator: Integrator, times: np.ndarray, breaks: list[float], declared: list[float]) -> None:
        self.integrator, self.times = integrator, times
        # A rounding error apart from an output, a break is on it.
        near = [float(times[np.argmin(np.abs(times - b))]) for b in breaks]
        self.breaks = [n if abs(n - b) <= POLICY.agenda.same * abs(b) else b for n, b in zip(near, breaks, strict=True)]
        self.found = {b for b, known in zip(self.breaks, breaks, strict=True) if known not in set(declared)}
        problem = integrator.problem
        self.guards, span = problem.compiled.guards, float(times[-1] - times[0])
        settings = integrator.settings
        self.instants = Instants(problem, settings.tolerance, span, settings.nominal)
        self.locator = Locator(integrator, self.instants)
        self.agenda = Agenda(self.guards, problem.p, times)
        self.events: list[float] = []
        self.recent: deque[float] = deque(maxlen=INSTANTS.most)
        self.stride = Stride(times)
        self.weak, self.hasty = 0, False
        self.first: Point | None = None
        self.march: March | None = None
        self.step = 0.0

    def go(self, at: Point) -> None:
        """Go from break to break; the law of each segment holds up to its end."""
        ends = [*self.breaks, float(self.times[-1])]
        held = self.agenda.between(at.time, ends[0])
        at, acts = self.agenda.at_start(at, held, self.instants)
        self.first = at = self._happen(at, acts)
        self.integrator.trace.before = np.zeros(2)  # the first row is the point after it
        for end in ends:
            if at.time != self.times[0]:
                now = self.agenda.between(at.time, end)
                at, held = self._at_break(at, now, held), now
            self._refuse_undecided(at, end)
            at = self._segment(at, end)
        self._at_stop(at, held)

    def _refuse_undecided(self, at: Point, end: float) -> None:
        """Refuse conditions of time alone that have no value up to the next break."""
        time = at.time + POLICY.agenda.after * (end - at.time)
        open_ = self.agenda.undecided(time)
        if open_ and (text := undecided(self.integrator.problem, replace(at, time=time), open_)):
            raise Undecided(at.time, text)

    def _at_break(self, at: Point, on: np.ndarray, held: np.ndarray) -> Point:
        """Switch what the clock switches: the timed guards that hold from now on, and that held before."""
        if at.time in self.found and bool((on != held).any()):
            self._count(at.time, [self.guards.timed[k] for k in np.flatnonzero(on != held)])
            self.stride.begin()
        return self._at_row(at, self.agenda.fired(on, held), self.agenda.constants(at.constants, on))

    def _at_row(self, at: Point, fired: list[int] | None = None, constants: Constants | None = None) -> Point:
        """Let happen what happens at the last row; an event if discrete variables have planned this instant."""
        plan = self.agenda.planned(at, at.time - self.agenda.near)
        new = self._happen(at, fired, constants)
        self.integrator.trace.put(-1, new)
        acted = new.differs(at if constants is None else replace(at, constants=constants))
        if acted and plan and plan[0] <= at.time + self.agenda.near:
            self.stride.begin()
            if self.events[-1:] != [at.time]:
                self._count(at.time, self.guards.watched)
            self._refuse_chattering(at.time, self.guards.watched)
        return new

    def _at_stop(self, at: Point, held: np.ndarray) -> None:
        """Let happen what is true at the stop time itself, and show the laws that hold after it."""
        agenda = self.agenda
        now, after = agenda.on(at.time, agenda.near), agenda.on(at.time + 2 * agenda.near)
        plan, fired = agenda.planned(at, at.time - agenda.near), agenda.fired(now, held)
        switched = bool((now != held).any() and len(at.truth))
        if fired or switched or (plan and plan[0] <= at.time + agenda.near):
            at = self._at_row(agenda.held_back(at, self.instants), fired, agenda.constants(at.constants, now))
        constants = agenda.constants(at.constants, after)
        if (constants.vector != at.constants.vector).any():
            acts = ~self.instants.is_switch
            with suppress(Cycling, InitializationError, Failure):  # laws without values there do not matter
                # What acts is kept from becoming true.
                new = self.instants.settle(replace(at, truth=at.truth | acts), constants=constants, due=acts)[0]
                self.integrator.trace.put(-1, new)

    def _count(self, time: float, guards: list[int]) -> None:
        """Note an event at which some conditions change."""
        self.events.append(time)
        if len(self.events) == INSTANTS.many:
            warn_of_many(self.integrator.compiled, time, self.times, guards)

    def _segment(self, at: Point, end: float) -> Point:
        if not self.guards.watched:
            while at.time < end:
                at = segment(self.integrator, at, self.stride.grid(at.time, end))
                self.stride.lengthen()
        while at.time < end:
            instant, row = self.agenda.planned(at, at.time + self.locator.shortest) or (np.inf, np.inf)
            target = min(instant, row, end)
            at = self._advance(at, target)
            if row <= end and target - self.locator.shortest <= at.time:
                self.integrator.trace.delay(row)
                at = replace(at, time=end) if row == end else self._at_row(replace(at, time=max(row, instant)))
            self.integrator.report(at.time)
        return at

    def _marched(self, at: Point, end: float) -> Point:
        """Take some steps and go to their end, or to the first event in them."""
        if self.march is None or self.march.at is not at or self.march.end != end:
            self.march = March(self.integrator, at, self.stride.outputs(at.time, end), self.step)
        march, integrator = self.march, self.integrator
        refusal = march.go()
        leg = None if refusal and refusal.kind is Kind.FLAT else march.leg(self.stride.density)
        if leg:
            crossing = self._crossing(at, march, leg)
            last = int(np.searchsorted(leg.times, crossing.after.time)) if crossing else len(leg.times)
            kept = march.accepted(leg.part(0, last)) if last else leg
            if isinstance(kept, Refusal):
                refusal = kept
            elif crossing:
                self.step, self.march = march.step(crossing.after.time), None
                return self._event(at, kept, crossing)
            else:
                integrator.trace.add(kept)
                at = march.at = kept.end(at)
        if refusal:
            self.march, before = None, integrator.way.method
            here = self._otherwise(at, self.stride.grid(at.time, end), refusal)
            # Near a flat position of a loop no method can begin: another one takes the whole segment.
            return march.withdrawn() if integrator.loops and integrator.way.method != before else here
        self.step = march.step(at.time)
        return at

    def _crossing(self, at: Point, march: March, leg: Leg) -> Crossing | None:
        """The first event in some steps, which are looked at as closely as that needs."""
        while True:
            try:
                return self.locator.first(at, leg, content=self.hasty)
            except TooCoarse:
                if not self.stride.look_closer():
                    self._warn_of_haste(at)
                leg = march.leg(self.stride.density) or leg
            except Undecided as failure:
                if n := int(np.searchsorted(leg.times, failure.time)):
                    self.integrator.trace.add(leg.part(0, n))
                raise

    def _advance(self, at: Point, end: float) -> Point:
        """Integrate one leg and go to its end, or to the first event in it."""
        if METHODS[self.integrator.way.method].marches and self.integrator.compiled.nx:
            return self._marched(at, end)
        grid = self.stride.grid(at.time, end)
        integrator = self.integrator
        way = replace(integrator.way, max_steps=integrator.settings.patience(integrator.way, grid))
        leg = integrator.attempt(at, self.stride.looks(grid), way)
        if isinstance(leg, Refusal):
            return self._otherwise(at, grid, leg)
        if not self.stride.is_enough(leg, grid):
            return at
        try:
            crossing = self.locator.first(at, leg, content=self.hasty)
        except TooCoarse:
            if not self.stride.look_closer():
                self._warn_of_haste(at)
            return at
        except Undecided as failure:
            if n := int(np.searchsorted(leg.times, failure.time)):
                self.integrator.trace.add(leg.part(0, n))
            raise
        except Failure as failure:
            return self._shorter(at, grid, failure)
        if crossing is None:
            self.stride.lengthen()
        return self._passed(at, leg, crossing)

    def _warn_of_haste(self, at: Point) -> None:
        self.hasty = True
        caution(
            f"from t = {at.time:.6g} s on, conditions change faster than they are checked, {2 * self.stride.density} times an "
            "interval; a change that reverts in between is missed. One of these:\n"
            f"{places_text(self.integrator.compiled, self.instants.watched.tolist())}\n"
            "More intervals mean more checks: simulate(..., intervals=...)."
        )

    def _otherwise(self, at: Point, grid: np.ndarray, refusal: Refusal) -> Point:
        """Try in another way, or over a shorter time, as the law may no longer be valid beyond an event."""
        integrator = self.integrator
        if (
            refusal.kind is Kind.STEPS
            and is_open(integrator, grid)
            and integrator.way.order == integrator.settings.max_order
        ):
            choose(integrator, at, grid[:2])
            if integrator.way.order != integrator.settings.max_order:
                return at
        settings = integrator.settings
        following = next_ways(integrator.way, refusal, settings.rescues(grid, integrator.loops))
        if integrator.loops and not following and integrator.way.method == settings.methods[0] != settings.careful:
            following = (replace(integrator.way, method=settings.careful),)
        if not following:
            return self._shorter(at, grid, Failure.of(refusal))
        integrator.take(following[0], refusal)
        return at

    def _shorter(self, at: Point, grid: np.ndarray, failure: Failure) -> Point:
        """Shorten the time: the law may no longer be valid beyond an event."""
        integrator = self.integrator
        if self.stride.shorten(grid):
            return at
        for k in range(POLICY.locate.halvings):
            times = np.array([at.time, at.time + (grid[1] - at.time) / 2**k])
            if times[1] - times[0] <= self.locator.shortest:
                break
            way = replace(integrator.way, max_steps=POLICY.rescue.long, careful=True)
            leg = integrator.attempt(at, times, way) if k else passage(integrator, at, times, 1)
            try:
                crossing = self.locator.first(at, accepted(leg), depth=1)
            except Failure as later:
                failure = later
                continue
            return self._passed(at, accepted(leg), crossing)
        here = self.locator.sample(at, at)
        due = (here.rate < 0) & (here.value <= -here.rate * INSTANTS.due * self.instants.span)
        if not due.any():
            raise failure
        return self._jump(at, at.time, np.zeros(2), due=due)

    def _passed(self, at: Point, leg: Leg, crossing: Crossing | None) -> Point:
        """Keep a leg, up to the first event in it."""
        if crossing:
            return self._event(at, leg, crossing)
        self.integrator.trace.add(leg)
        return leg.end(at)

    def _event(self, at: Point, leg: Leg, crossing: Crossing) -> Point:
        """Keep what was before the event, apply it, and continue from it."""
        after = crossing.after
        out = after.value <= 0
        width = self.instants.width(at)
        # An event at an output may be found only from there on: what the legs before it have shown counts as well.
        peak, self.locator.passed = np.maximum(crossing.peak, self.locator.passed), 0.0
        self.weak = self.weak + 1 if np.all(peak[out] <= width[out]) else 0
        delay = np.min(width[out] / np.maximum(np.abs(after.rate[out]), np.finfo(float).tiny), initial=np.inf)
        snap = min(float(delay), POLICY.locate.snap * self.instants.span / (len(self.times) - 1))
        times = np.array([*self.times, *self.breaks])
        near = times[np.argmin(np.abs(times - after.time))]
        on_output = abs(near - after.time) <= snap
        label = float(near) if on_output and near > at.time else after.time
        n = int(np.searchsorted(leg.times, min(label, after.time)))
        last = at
        if n:
            before = leg.part(0, n)
            self.integrator.trace.add(before)
            last = before.end(at)
        self._refuse_chattering(after.time, [int(k) for k in self.instants.watched[out]])
        gained = work_between(self.integrator, replace(last, constants=after.at.constants), after.at)
        reached = replace(after.at, time=max(label, after.time))
        new = self._jump(reached, label, gained, crossed=out)
        if on_output and near == at.time:
            self.integrator.trace.put(-2, new)
        self.stride.begin(after.time - at.time)
        return new

    def _happen(self, at: Point, fired: list[int] | None = None, constants: Constants | None = None) -> Point:
        """Let everything happen at an instant that has a row already."""
        new, gained, _ = self._settled(at, fired=fired, constants=constants)
        self.integrator.trace.spend(gained)
        return new

    def _jump(self, at: Point, label: float, gained: np.ndarray, **causes: np.ndarray) -> Point:
        """Let everything happen at an event; record the values after it and what energy was gained since the last row."""
        new, stored, changed = self._settled(at, **causes)
        if changed:
            crossed = causes.get("crossed", causes.get("due"))
            self._count(at.time, self.guards.watched if crossed is None else self.instants.watched[crossed].tolist())
        rows = Rows.of(replace(new, time=label))
        self.integrator.trace.add(Leg(rows, (gained + stored)[None], new.constants, 0))
        return new

    def _settled(self, at: Point, **causes: Any) -> tuple[Point, np.ndarray, bool]:
        """Return the values after an instant, what stored energy it gained and lost, and whether anything changed."""
        try:
            new, changed = self.instants.settle(at, **causes)
        except Cycling as cycling:
            raise Chattering(self.integrator.compiled, at.time, cycling.guards, "switch back and forth") from None
        except InitializationError as error:
            why = cause(self.integrator.problem, error.at) if isinstance(error, Lost) else ""
            raise Failure(at.time, f"the equations have no solution after an event: {why or error}") from None
        stored = self.integrator.settings.energy and changed
        energy = self.integrator.problem.stored
        change = energy(new) - energy(at) if stored else 0.0
        return new, np.array([max(change, 0.0), max(-change, 0.0)]), changed

    def _refuse_chattering(self, time: float, guards: list[int]) -> None:
        crowded = len(self.recent) == INSTANTS.most and time - self.recent[0] <= INSTANTS.window * self.instants.span
        self.recent.append(time)
        if crowded or self.weak >= INSTANTS.most:
            what = f"changed {INSTANTS.most} times with hardly any motion between"
            raise Chattering(self.integrator.compiled, time, guards, what)
