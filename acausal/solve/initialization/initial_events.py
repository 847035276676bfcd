"""Event iteration at the start time."""

from __future__ import annotations

import numpy as np

from acausal.errors import InitializationError
from acausal.policy import POLICY
from acausal.solve.events.agenda import Agenda
from acausal.solve.events.chattering import Chattering
from acausal.solve.events.clock_times import clock_times
from acausal.solve.events.instant import Cycling, Instants
from acausal.solve.initialization.initial_modes import origins_text, start
from acausal.solve.initialization.steady_rotation import is_steady
from acausal.solve.point import Point
from acausal.solve.problem import Problem

SPAN = 1.0  # s, horizon of time events: later ones do not matter at the start


class InitialEvents:
    """Events at the start.

    Parameters
    ----------
    problem : Problem
        The model.
    time, later : float
        Start time, and a time before the next time event, in s.
    """

    def __init__(self, problem: Problem, time: float, later: float) -> None:
        self.problem, self.later = problem, later
        self.instants = Instants(problem, POLICY.defaults.tolerance, SPAN, problem.nominal)
        self.agenda = Agenda(problem.compiled.guards, problem.p, np.array([time, time + SPAN]))

    def after(self, at: Point) -> Point:
        """Return the first point of a run, from consistent values.

        Raises
        ------
        InitializationError
            If the event iteration does not converge.
        """
        at, acts = self.agenda.at_start(at, self.agenda.on(self.later), self.instants)
        return self._after_events(at, acts)

    def refuse_transient(self, at: Point) -> None:
        """Raise InitializationError if an event that the states trigger at once ends an equilibrium.

        Time events and scheduled events may end it.
        """
        guards = self.problem.compiled.guards
        before, _ = self.agenda.at_start(at, self.agenda.on(self.later), self.instants)
        if not len(before.mode):
            return
        scheduled = {k for k, _ in guards.scheduled_guards}
        begins = (self.instants.rates(before)[0] < 0) & ~before.mode & ~self.instants.is_switch
        acts = [k for k in self.instants.watched[begins].tolist() if k not in scheduled]
        if acts and not is_steady(self.problem, self._after_events(before, [])):
            raise InitializationError(
                f"the equilibrium at t = {at.time:g} s does not last: this condition is true there, and its event starts "
                f"a motion:\n{origins_text(self.problem.compiled, acts)}\nGive guesses near another one, or hold the model."
            )

    def _after_events(self, at: Point, acts: list[int]) -> Point:
        try:
            return self.instants.settle(at, fired=acts)[0]
        except Cycling as cycling:
            text = str(Chattering(self.problem.compiled, at.time, cycling.guards, "switch back and forth"))
            raise InitializationError(text) from None


def first_point(problem: Problem, time: float, initial: str) -> Point:
    """Return the first point of runs.

    Parameters
    ----------
    problem : Problem
        The model.
    time : float
        Start time in s.
    initial : "fixed", "guesses" or "steady"
        See `initialize`.

    Raises
    ------
    InitializationError
        If there are no consistent values, or the event iteration does not converge.
    """
    guards, p, stop = problem.compiled.guards, problem.p, time + SPAN
    changes = [*guards.breaks(p)[0].tolist(), *clock_times(problem.compiled, p, time, stop)]
    later = (time + min((t for t in changes if time < t < stop), default=stop)) / 2
    at = start(problem, time, later, initial).point
    events = InitialEvents(problem, time, later)
    if initial == "steady":
        events.refuse_transient(at)
    return events.after(at)
