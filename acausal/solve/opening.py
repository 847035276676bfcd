"""Where the runs from a time on begin: consistent values, after what happens at that very instant."""

from __future__ import annotations

import numpy as np

from acausal.errors import InitializationError
from acausal.policy import POLICY
from acausal.solve.events.agenda import Agenda
from acausal.solve.events.chattering import Chattering
from acausal.solve.events.clock_times import clock_times
from acausal.solve.events.instant import Cycling, Instants
from acausal.solve.points import Point
from acausal.solve.problem import Problem
from acausal.solve.start.start import start

SPAN = 1.0  # s: conditions by the clock that change later do not matter at the start


def opening(problem: Problem, time: float, initial: str) -> Point:
    """Return the first point of runs.

    Parameters
    ----------
    problem : Problem
        The model.
    time : float
        When they start, in s.
    initial : "fixed", "guesses" or "steady"
        See `initialize`.

    Raises
    ------
    InitializationError
        If no values are found, or what happens at the start does not settle.
    """
    guards, p, stop = problem.compiled.guards, problem.p, time + SPAN
    changes = [*guards.breaks(p)[0].tolist(), *clock_times(problem.compiled, p, time, stop)]
    end = min((t for t in changes if time < t < stop), default=stop)
    instants = Instants(problem, POLICY.defaults.tolerance, SPAN, problem.nominal)
    agenda = Agenda(guards, p, np.array([time, stop]))
    at = start(problem, time, (time + end) / 2, initial).point
    at, acts = agenda.at_start(at, agenda.between(time, end), instants)
    try:
        return instants.settle(at, fired=acts)[0]
    except Cycling as cycling:
        text = str(Chattering(problem.compiled, time, cycling.guards, "switch back and forth"))
        raise InitializationError(text) from None
