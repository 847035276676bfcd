"""How a run goes on where an integrator refuses: in three rungs."""

from __future__ import annotations

import numpy as np

from acausal.policy import POLICY
from acausal.solve.integrate.integrator import Integrator
from acausal.solve.integrate.ladder import Failure, Kind, Refusal, Way, next_way, rescue_ways

RESCUE = POLICY.rescue
ENDS = (Kind.UNSOLVABLE, Kind.CORRECTOR)


class Rescue:
    """Three rungs after a refusal.

    The next method goes on from the last accepted point; where none does, other methods and larger tolerances are tried for one
    output interval, a few times in a run; at last the run fails.

    Parameters
    ----------
    integrator : Integrator
        Its way is changed.
    times : array
        Output times in s.

    Attributes
    ----------
    until : float
        Time in s at which a way of one output interval ends; inf where the way is that of the run.
    """

    def __init__(self, integrator: Integrator, times: np.ndarray) -> None:
        self.integrator, self.times, self.until = integrator, times, np.inf
        self._ways, self._before = list[Way](), integrator.way
        self._refusals = list[Refusal]()
        self._ended = False  # the solution of the algebraic equations, as far as a method tells

    def go_on(self, refusal: Refusal, end: float) -> None:
        """Choose the way to go on after a refusal.

        Raises
        ------
        Failure
            If there is none.
        """
        integrator = self.integrator
        self._ended = self._ended or (refusal.kind in ENDS and not integrator.loops)
        rescues = integrator.settings.rescues(self.times, integrator.loops)
        if not self._refusals:
            if following := next_way(integrator.way, refusal, rescues):
                integrator.take(following, refusal)
                return
            self._before = integrator.way
            # Beyond the end of a solution a larger tolerance would find another one.
            if len(integrator.trace.loosened) < RESCUE.loosened and not self._ended:
                self._ways = rescue_ways(integrator.way, rescues)
            after = np.searchsorted(self.times, refusal.time, "right")
            self.until = min(end, float(self.times[min(after, len(self.times) - 1)]))
        self._refusals.append(refusal)
        if not self._ways:
            raise Failure.of(self._last_word())
        integrator.way = self._ways.pop(0)

    def reached(self, time: float) -> None:
        """Go on in the way of the run where that of one output interval has come to its end."""
        if time < self.until:
            return
        trace, way = self.integrator.trace, self.integrator.way
        if way.tolerance > self._before.tolerance:
            trace.loosened.append(self._refusals[0].time)
        self.integrator.way = self._before
        self.until, self._ways, self._refusals = np.inf, [], []

    def _last_word(self) -> Refusal:
        """Return the refusal to tell: where a solution ended, by a Newton iteration, else the one that came farthest."""
        ended = [one for one in self._refusals if one.kind is Kind.CORRECTOR]
        return min(ended, key=_time) if ended else max(self._refusals, key=_time)


def _time(refusal: Refusal) -> float:
    return refusal.time
