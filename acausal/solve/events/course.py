"""A run with breaks and events: integrate while nothing changes, stop where a condition changes, continue from there."""

from __future__ import annotations

from collections import deque
from contextlib import suppress
from dataclasses import replace
from typing import Any

import numpy as np

from acausal.compiler.constants import Constants
from acausal.errors import InitializationError
from acausal.policy import POLICY
from acausal.solve.diagnosis.not_finite import cause
from acausal.solve.diagnosis.singularity import undetermined
from acausal.solve.diagnosis.undefined_conditions import undefined_conditions
from acausal.solve.events.agenda import Agenda
from acausal.solve.events.ahead import Ahead
from acausal.solve.events.between import work_between
from acausal.solve.events.chattering import Chattering
from acausal.solve.events.hybrid import Hybrid, Passed
from acausal.solve.events.instant import Cycling, Instants
from acausal.solve.events.locate import Crossing, Undecided
from acausal.solve.events.many import warn_of_many
from acausal.solve.events.rests import ends_of_rests
from acausal.solve.initialization.newton import NoConvergence
from acausal.solve.integrate.attempt import Integrator
from acausal.solve.integrate.ladder import Failure, Refusal, next_ways
from acausal.solve.integrate.segment import segment
from acausal.solve.integrate.trace import Leg
from acausal.solve.point import Point, Rows

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
        follow = set(declared)
        self.found = {b for b, known in zip(self.breaks, breaks, strict=True) if known not in follow}
        problem = integrator.problem
        self.guards, span = problem.compiled.guards, float(times[-1] - times[0])
        settings = integrator.settings
        self.instants = Instants(problem, settings.tolerance, span, settings.nominal)
        self.ahead = Ahead(integrator, self.instants, times)
        self.agenda = Agenda(self.guards, problem.p, np.union1d(times, self.breaks))
        self.hybrid = Hybrid(self.ahead, times)
        self.events: list[float] = []
        self.searched = 0  # those of them that were not passed at one go, which cost a hundred times as much
        self.recent: deque[float] = deque(maxlen=INSTANTS.most)
        self.weak = 0
        self.first: Point | None = None

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
            for rest in ends_of_rests(self.integrator, at, end, self.times):
                at = self._segment(at, rest)
                self.ahead.begin()
            at = self._segment(at, end)
        self._at_stop(at, held)

    def idle(self) -> list[str]:
        """Name statements that hold after the start, and whose condition nothing but they themselves makes false again."""
        at = self.first
        held = [] if at is None else [k for k in self.guards.self_scheduling if at.mode[self.guards.watched.index(k)]]
        return [
            f"{self.guards.guards[k].origin}: the condition holds after the start, t = {self.times[0]:g} s, and acts where it "
            "becomes true: it never does, as nothing else moves its instant. Give that a start= after the start time, "
            "or take at_start=True and plan the next instant after the present, reinit(due, time + period)."
            for k in held
        ]

    def _refuse_undecided(self, at: Point, end: float) -> None:
        """Refuse conditions of time alone that have no value up to the next break."""
        time = at.time + POLICY.agenda.after * (end - at.time)
        open_ = self.agenda.undecided(time)
        if open_ and (text := undefined_conditions(self.integrator.problem, replace(at, time=time), open_)):
            raise Undecided(at.time, text)

    def _at_break(self, at: Point, on: np.ndarray, held: np.ndarray) -> Point:
        """Switch what the clock switches: the timed guards that hold from now on, and that held before."""
        if at.time in self.found and bool((on != held).any()):
            self._count(at.time, [self.guards.timed[k] for k in np.flatnonzero(on != held)])
            self.ahead.stride.begin()
        return self._at_row(at, self.agenda.fired(on, held), self.agenda.constants(at.constants, on))

    def _at_row(self, at: Point, fired: list[int] | None = None, constants: Constants | None = None) -> Point:
        """Let happen what happens at the last row; an event if discrete variables have planned this instant."""
        planned = self.agenda.is_planned(at)
        new = self._happen(at, fired, constants)
        self.integrator.trace.put(-1, new)
        acted = new.differs(at if constants is None else replace(at, constants=constants))
        if acted and planned:
            self.ahead.stride.begin()
            if self.events[-1:] != [at.time]:
                self._count(at.time, self.guards.watched)
            self._refuse_chattering(at.time, self.guards.watched)
        return new

    def _at_stop(self, at: Point, held: np.ndarray) -> None:
        """Let happen what is true at the stop time itself, and show the laws that hold after it."""
        agenda = self.agenda
        now, after = agenda.on(at.time, agenda.near), agenda.on(at.time + 2 * agenda.near)
        fired = agenda.fired(now, held)
        switched = bool((now != held).any() and len(at.mode))
        if fired or switched or agenda.is_planned(at):
            at = self._at_row(agenda.held_back(at, self.instants), fired, agenda.constants(at.constants, now))
        constants = agenda.constants(at.constants, after)
        if (constants.vector != at.constants.vector).any():
            acts = ~self.instants.is_switch
            with suppress(Cycling, InitializationError, Failure):  # laws without values there do not matter
                # What acts is kept from becoming true.
                new = self.instants.settle(replace(at, mode=at.mode | acts), constants=constants, due=acts)[0]
                self.integrator.trace.put(-1, new)

    def _count(self, time: float, guards: list[int]) -> None:
        """Note an event at which some conditions change."""
        self.events.append(time)
        self.searched += 1
        if self.searched == INSTANTS.many:
            warn_of_many(self.integrator.compiled, time, self.times, guards)

    def _segment(self, at: Point, end: float) -> Point:
        while at.time < end:
            if passed := self.hybrid.go(at, end, self.weak):
                at = self._passed(passed)
                if passed.refusal is None or self._changes_way(passed.refusal):
                    continue
            if not self.guards.watched:
                at = segment(self.integrator, at, self.ahead.stride.grid(at.time, end))
                self.ahead.stride.lengthen()
                continue
            instant, row = self.agenda.planned(at, at.time + self.ahead.locator.shortest) or (np.inf, np.inf)
            target = min(instant, row, end)
            at = self._advance(at, target)
            if row <= end and target - self.ahead.locator.shortest <= at.time:
                self.integrator.trace.delay(row)
                at = replace(at, time=end) if row == end else self._at_row(replace(at, time=max(row, instant)))
            self.integrator.report(at.time)
        return at

    def _changes_way(self, refusal: Refusal) -> bool:
        """Go on in the next way after a refusal; return False if there is none."""
        rescues = self.integrator.settings.rescues(self.times, self.integrator.loops)
        following = next_ways(self.integrator.way, refusal, rescues)
        if following:
            self.integrator.take(following[0], refusal)
            self.hybrid.begin()
        return bool(following)

    def _passed(self, passed: Passed) -> Point:
        """Keep what the core has passed; let what it left to Python happen at its end."""
        for leg in passed.legs:
            self.integrator.trace.add(leg)
        self.events += passed.events
        self.recent.extend(passed.events)
        self.ahead.stride.begin()
        self.integrator.report(passed.at.time)
        crossed, at, self.weak = passed.crossed, passed.at, passed.weak
        if crossed is None:
            return at
        self.ahead.locator.passed = 0.0
        self._refuse_chattering(at.time, self.instants.watched[crossed].tolist() or self.guards.watched)
        return self._jump(at, at.time, passed.work, crossed=crossed)

    def _advance(self, at: Point, end: float) -> Point:
        """Go as far as one looks ahead at once, or to the first event."""
        found = self.ahead.look(at, end)
        if found.due is not None:
            return self._jump(at, at.time, np.zeros(2), due=found.due)
        if found.leg is None:
            return found.at
        if found.crossing:
            return self._event(at, found.leg, found.crossing)
        self.integrator.trace.add(found.leg)
        return found.leg.end(at)

    def _event(self, at: Point, leg: Leg, crossing: Crossing) -> Point:
        """Keep what was before the event, apply it, and continue from it."""
        after = crossing.after
        out = after.value <= 0
        width = self.instants.width(at)
        # An event at an output may be found only from there on: what the legs before it have shown counts as well.
        peak, self.ahead.locator.passed = np.maximum(crossing.peak, self.ahead.locator.passed), 0.0
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
        self.ahead.stride.begin(after.time - at.time)
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
            why = cause(self.integrator.problem, error.at) if isinstance(error, NoConvergence) else ""
            raise Failure(at.time, f"the equations have no solution after an event: {why or error}") from None
        if changed and (text := undetermined(self.integrator.problem, new)):
            raise Failure(at.time, text)
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
