"""A run with breaks and events: integrate while nothing changes, stop where a condition changes, continue from there."""

from __future__ import annotations

from collections import deque
from collections.abc import Sequence
from contextlib import suppress
from dataclasses import replace
from typing import Any

import numpy as np

from acausal.compiler.constants import Constants
from acausal.errors import InitializationError
from acausal.policy import POLICY
from acausal.solve.diagnosis.not_finite import cause
from acausal.solve.diagnosis.singularity import undetermined
from acausal.solve.diagnosis.undefined_conditions import NO_VALUE, undefined_conditions
from acausal.solve.events.agenda import Agenda
from acausal.solve.events.chattering import Chattering
from acausal.solve.events.hybrid import Hybrid, Passed
from acausal.solve.events.instant import Cycling, Instants
from acausal.solve.events.many import warn_of_many
from acausal.solve.events.order_trial import OrderTrial
from acausal.solve.events.rests import ends_of_rests
from acausal.solve.initialization.newton import NoConvergence
from acausal.solve.integrate.functions import Functions
from acausal.solve.integrate.integrator import Integrator
from acausal.solve.integrate.ladder import Failure, Kind
from acausal.solve.integrate.rescue import Rescue
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
        functions = Functions(problem.compiled)
        self.instants = Instants(problem, settings.tolerance, span, settings.nominal, settings.energy, functions)
        self.agenda = Agenda(self.guards, problem.p, np.union1d(times, self.breaks))
        self.hybrid = Hybrid(integrator, self.instants, times)
        self.rescue, self.orders = Rescue(integrator, times), OrderTrial(integrator, times)
        self.events: list[float] = []
        self.searched = 0  # those of them that were not passed at one go, which cost a hundred times as much
        self.recent: deque[float] = deque(maxlen=INSTANTS.most)
        self.weak = 0
        self.crossed: np.ndarray | None = None  # conditions that change at the last row, as of `Passed`
        self.first: Point | None = None

    def go(self, at: Point, passed: Sequence[Point] = ()) -> None:
        """Go from break to break; the law of each segment holds up to its end.

        Points at outputs before the first one are those of a start in a singular configuration.
        """
        ends = [*self.breaks, float(self.times[-1])]
        held = self.agenda.between(at.time, ends[0])
        at, acts = self.agenda.at_start(at, held, self.instants)
        self.first = at = self._happen(at, fired=acts)
        self.integrator.trace.before = np.zeros(2)  # the first row is the point after it
        for point in passed:
            self.integrator.trace.add(Leg(Rows.of(point), np.zeros((1, 2)), point.constants))
        for place, end in enumerate(ends):
            if place:
                self.hybrid.restart()
                now = self.agenda.between(at.time, end)
                at, held = self._at_break(at, now, held), now
            self._refuse_undecided(at, end)
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
            raise Failure(at.time, text)

    def _at_break(self, at: Point, on: np.ndarray, held: np.ndarray) -> Point:
        """Switch what the clock switches: the timed guards that hold from now on, and that held before."""
        if at.time in self.found and bool((on != held).any()):
            self._count(at.time, [self.guards.timed[k] for k in np.flatnonzero(on != held)])
        return self._at_row(at, self.agenda.fired(on, held), self.agenda.constants(at.constants, on))

    def _at_row(self, at: Point, fired: list[int] | None = None, constants: Constants | None = None) -> Point:
        """Let happen what happens at the last row; an event if conditions change there, or discrete variables have planned it."""
        planned, crossed = self.agenda.is_planned(at), self.crossed
        self.crossed = None
        new = self._happen(at, fired=fired, constants=constants, crossed=crossed)
        self.integrator.trace.put(-1, new)
        acted = new.differs(at if constants is None else replace(at, constants=constants))
        if acted and (planned or crossed is not None):
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
        if fired or switched or self.crossed is not None or agenda.is_planned(at):
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
        """Go to the next break; where laws of time end a rest, steps begin anew."""
        for stop in (*ends_of_rests(self.integrator, at, end, self.times), end):
            while at.time < stop:
                if self.integrator.limits:
                    self.integrator.limits.check(at, self.integrator.trace)
                passed = self.hybrid.go(at, min(stop, self.rescue.until, self.orders.until), self.weak)
                at = self._passed(passed, stop)
                self.rescue.reached(at.time)
                self.orders.reached(at.time)
                self.integrator.report(at.time)
                acts = self.crossed is not None or (passed.ends and self.agenda.is_planned(at))
                if acts and at.time < end:
                    at = self._at_row(at)
            if stop < end:
                self.hybrid.restart()
        return at

    def _passed(self, passed: Passed, end: float) -> Point:
        """Keep what the core has passed; let happen what it did not decide, or go on in another way."""
        if passed.leg:
            self.integrator.trace.add(passed.leg)
        self.events += passed.events
        self.recent.extend(passed.events)
        crossed, at, self.weak = passed.crossed, passed.at, passed.weak
        if passed.ends:
            self.crossed = crossed
        elif crossed is not None:
            self._refuse_chattering(at.time, self.instants.watched[crossed].tolist() or self.guards.watched)
            return self._jump(at, at.time, passed.work, crossed=crossed)
        if passed.refusal:
            if passed.refusal.kind is Kind.UNDEFINED:
                self._refuse_undefined(self.hybrid.undefined(at))
            if passed.refusal.kind is not Kind.STEPS or not self.orders.decides(at):
                self.rescue.go_on(passed.refusal, end)
            self.hybrid.restart()
        return at

    def _refuse_undefined(self, at: Point) -> None:
        """Refuse watched conditions that have no value."""
        lost = self.instants.watched[np.isnan(self.instants.rates(at)[0])].tolist()
        raise Failure(at.time, undefined_conditions(self.integrator.problem, at, lost) or NO_VALUE)

    def _happen(self, at: Point, **causes: Any) -> Point:
        """Let everything happen at an instant that has a row already."""
        new, gained, _ = self._settled(at, **causes)
        self.integrator.trace.spend(gained)
        return new

    def _jump(self, at: Point, label: float, gained: np.ndarray, **causes: np.ndarray) -> Point:
        """Let everything happen at an event; record the values after it and what energy was gained since the last row."""
        new, stored, changed = self._settled(at, **causes)
        if changed:
            crossed = causes.get("crossed", causes.get("due"))
            self._count(at.time, self.guards.watched if crossed is None else self.instants.watched[crossed].tolist())
        rows = Rows.of(replace(new, time=label))
        self.integrator.trace.add(Leg(rows, (gained + stored)[None], new.constants))
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
