"""What is known in advance: conditions that the clock decides, and instants that discrete variables plan."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from acausal.compiler.constants import Constants
from acausal.compiler.event_conditions import EventConditions
from acausal.policy import POLICY
from acausal.solve.events.instant import Instants
from acausal.solve.point import Point


def part_of_time(part: float, begin: float, end: float) -> float:
    """Return what part of the time is rounding in a run, given that of a run which begins at 0.

    Parameters
    ----------
    part : float
        One of `POLICY.agenda`.
    begin, end : float
        Of the run in s.
    """
    return part * min(1.0, max((end - begin) / max(abs(begin), abs(end)), POLICY.agenda.late))


class Agenda:
    """Conditions by the clock in one run.

    Parameters
    ----------
    guards : EventConditions
        Conditions of the model.
    p : array
        Parameter values.
    times : array
        Output times, and breaks.
    """

    def __init__(self, guards: EventConditions, p: np.ndarray, times: np.ndarray) -> None:
        self.guards, self.p, self.times = guards, p, times
        ends = float(times[0]), float(times[-1])
        self.near = part_of_time(POLICY.agenda.apart, *ends) * max(map(abs, ends))
        self.added = part_of_time(POLICY.agenda.added, *ends)
        self._timed = np.array(guards.timed, dtype=int)
        self._is_switch = self._timed < guards.n_switches
        self._plans = bool(guards.scheduled.function.numel_out(0))

    def on(self, time: float, near: float = 0.0) -> np.ndarray:
        """Which timed guards hold at a time; comparisons that would be 0 within the span `near` are 0."""
        return self._holds(time, near) > 0.5

    def reach(self, time: float) -> float:
        """How far from a row the instant that is on it may be, in s."""
        return max(self.near, self.added * abs(time))

    def undecided(self, time: float) -> list[int]:
        """Timed guards whose conditions have no value at a time."""
        return self._timed[np.isnan(self._holds(time, 0.0))].tolist()

    def _holds(self, time: float, near: float) -> np.ndarray:
        return self.guards.holds_at(self.p, time, near)[0] if self.guards.timed else np.empty(0)

    def between(self, begin: float, end: float) -> np.ndarray:
        """Which timed guards hold between two breaks."""
        return self.on((begin + end) / 2)

    def constants(self, constants: Constants, on: np.ndarray) -> Constants:
        """Return constants with the switches that the clock decides."""
        return constants.switched(self._timed[self._is_switch], on[self._is_switch])

    def fired(self, on: np.ndarray, before: np.ndarray) -> list[int]:
        """Timed guards with jumps whose condition becomes true."""
        return self._timed[on & ~before & ~self._is_switch].tolist()

    def at_start(self, at: Point, held: np.ndarray, instants: Instants) -> tuple[Point, list[int]]:
        """Return the start with the watched conditions that held at that very instant, and the timed guards that act.

        Parameters
        ----------
        at : Point
            The first point, with the constants that hold after the start.
        held : array of bool
            Timed guards that hold after the start.
        instants : Instants
            Watched conditions.
        """
        on = self.on(float(self.times[0]), self.near)
        known = zip(self.guards.timed, on | held, strict=True)
        acts = [k for k, holds in known if holds and self.guards.guards[k].at_start]
        if len(at.mode):
            # Before the clock switches anything; what is but a rounding error away from its instant is there.
            value, rate = instants.rates(replace(at, constants=self.constants(at.constants, on)))
            slack = np.maximum(-rate, 0) * self.near
            before = np.where(self._inclusive(at), value <= slack, value < -slack)
            before &= ~np.array([self.guards.guards[k].at_start for k in self.guards.watched])
            at = replace(at, mode=np.where(instants.is_switch, at.mode, before))
        return at, sorted({*acts, *self.fired(held, on)})

    def planned(self, at: Point, since: float) -> tuple[float, float] | None:
        """Return the next instant later than `since` that discrete variables plan, and the output time or break that it is on.

        That is the instant itself if none is so near that rounding alone is between them.
        """
        if not self._plans:
            return None
        instants = self.guards.scheduled(self.p, at.constants.vector)[0]
        ahead = instants[np.isfinite(instants) & (instants > since)]
        if not len(ahead):
            return None
        instant = float(np.min(ahead))
        near = float(self.times[np.argmin(np.abs(self.times - instant))])
        on_output = abs(near - instant) <= self.reach(instant) and near > at.time
        return instant, near if on_output else instant

    def is_planned(self, at: Point) -> bool:
        """Whether discrete variables plan the present instant."""
        reach = self.reach(at.time)
        plan = self.planned(at, at.time - reach)
        return plan is not None and plan[0] <= at.time + reach

    def held_back(self, at: Point, instants: Instants) -> Point:
        """Return a point at the stop time at which what becomes true only after it does not act.

        `time > due` is not true where time is `due`: a run that continues from there begins with that.
        """
        if not len(at.mode):
            return at
        value, rate = instants.rates(at)
        later = ~self._inclusive(at) & ~instants.is_switch & (np.abs(value) <= -rate * 2 * self.reach(at.time))
        return replace(at, mode=at.mode | later)

    def _inclusive(self, at: Point) -> np.ndarray:
        """Which watched conditions hold where they are 0; where a planned comparison just changes, that tells."""
        found = {k: self.guards.guards[k].inclusive for k in self.guards.watched}
        for (k, inclusive), instant in zip(
            self.guards.scheduled_guards, self.guards.scheduled(self.p, at.constants.vector)[0], strict=True
        ):
            if abs(instant - at.time) <= 2 * self.reach(at.time):
                found[k] = inclusive
        return np.array([found[k] for k in self.guards.watched], dtype=bool)
