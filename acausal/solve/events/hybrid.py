"""Go on in the core, over events and planned instants, as far as it is sure what happens."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from acausal.compiler.core_equations import core_equations
from acausal.compiler.runtime import decides
from acausal.core import Back, Run, library
from acausal.core import Rows as Recorded
from acausal.errors import InitializationError
from acausal.policy import POLICY
from acausal.solve.events.ahead import Ahead
from acausal.solve.integrate.ladder import Way
from acausal.solve.integrate.methods import METHODS
from acausal.solve.integrate.one_step import at_once
from acausal.solve.integrate.stored import run_file
from acausal.solve.integrate.trace import Leg
from acausal.solve.point import Point, Rows

SAMPLING = POLICY.sampling


@dataclass(frozen=True)
class Passed:
    """What was passed.

    Attributes
    ----------
    legs : list of Leg
        Rows.
    at : Point
        After them.
    events : list of float
        Times of the events in s that happened meanwhile.
    peak : array
        Greatest excess of each watched condition since the last one.
    crossed : array of bool, optional
        Conditions that change at `at`, where an event is left to the caller.
    weak : int
        Events in a row with hardly any motion between.
    work : array, shape (2,)
        Supplied and dissipated energy in J since the last row.
    """

    legs: list[Leg]
    at: Point
    events: list[float]
    peak: np.ndarray
    crossed: np.ndarray | None
    weak: int
    work: np.ndarray


class Hybrid:
    """Runs of the core over segments.

    Parameters
    ----------
    ahead : Ahead
        Looks ahead wherever this does not.
    times : array
        Output times in s.
    """

    def __init__(self, ahead: Ahead, times: np.ndarray) -> None:
        self.ahead, self.integrator, self.times = ahead, ahead.integrator, times
        self._made: tuple[Way, Run] | None = None
        self._wait, self._next, self._worked = 0, 1, np.zeros(2)
        self._at: Point | None = None  # where a run pauses
        self._decides = decides(self.integrator.compiled)

    def go(self, at: Point, end: float, weak: int) -> Passed | None:
        """Go on towards the end of a segment, after so many weak events; None where it is in doubt what happens next."""
        way = self.integrator.way
        if at is not self._at and not self._begin(at, way, weak):
            return None
        run, self._at = self._run(at, way), None
        back, found = self._slice(run, end, way)
        if run.state.hasty:
            self.ahead.tell_of_haste(at.time)
        self._wait = self._next if back is Back.DOUBT else 0
        self._next = min(2 * self._next, SAMPLING.longest) if back is Back.DOUBT else 1
        if run.state.time <= at.time and back in (Back.END, Back.DOUBT):
            return None
        x, z, c, mode, peak, crossed = run.values()
        self.ahead.begin(run.state.step)
        self.ahead.locator.passed = np.maximum(self.ahead.locator.passed, peak)
        point = Point(run.state.time, x, z, self.integrator.compiled.layout.constants(c), mode)
        self._at = point if back in (Back.PAUSED, Back.FULL) else None
        legs = self._legs(found)
        work = np.array([run.state.supplied, run.state.dissipated]) - self._worked
        changes = crossed if back is Back.EVENT else None
        return Passed(legs, point, found.events.tolist(), peak, changes, run.state.weak, work)

    def _begin(self, at: Point, way: Way, weak: int) -> bool:
        """Stand at a point, if the core runs the model from there."""
        if self._wait or not self._fits(at, way):
            self._wait = max(0, self._wait - 1)
            return False
        integrator = self.integrator
        try:
            at = integrator.restarted(at, way.moves)
        except InitializationError:
            return False
        run, p = self._run(at, way), np.append(integrator.problem.p, integrator.settings.nominal)
        how = {"step": self.ahead.step, "tolerance": way.tolerance, "damps": METHODS[way.method].damps}
        run.begin(at.time, at.x, at.z, p, at.constants.vector, at.mode, **how)
        run.state.weak, self._worked = weak, np.zeros(2)
        return True

    def _slice(self, run: Run, end: float, way: Way) -> tuple[Back, Recorded]:
        """Take some steps, and count them."""
        integrator = self.integrator
        before = self._counts(run)

        def counts() -> list[int]:
            return (self._counts(run) - before).tolist()

        steps = at_once(core_equations(integrator.compiled, False, way.moves))
        evaluations = run.state.evaluations
        with integrator.trace.counting(way.method, counts):
            found = run.go(self.times, end, leaves=self._decides, steps=steps, longest=self._longest(way))
        integrator.consistent.evaluations += run.state.evaluations - evaluations
        return found.back, found

    @staticmethod
    def _counts(run: Run) -> np.ndarray:
        """Steps, factorisations, evaluations of the equations, and calls."""
        state = run.state
        return np.array([state.steps, state.steps + state.refused, state.values, state.begun])

    def _longest(self, way: Way) -> int:
        """Steps between two outputs after which vibrations count as in the way, or at most."""
        settings = self.integrator.settings
        ringing = settings.first(way, self.times[[0, -1]]).ringing
        return ringing.steps if ringing and settings.rings(ringing.interval) else way.max_steps

    def _legs(self, found: Recorded) -> list[Leg]:
        """Rows as the trace takes them."""
        if not len(found.times):
            return []
        constants = self.integrator.compiled.layout.constants(found.c[-1])
        work, self._worked = found.work - self._worked, found.work[-1]
        return [Leg(Rows(found.times, found.x, found.z, found.c), work, constants, 0)]

    def _fits(self, at: Point, way: Way) -> bool:
        """Whether the core runs the model in a way; which of redundant constraints are independent is decided in Python."""
        integrator = self.integrator
        compiled = integrator.compiled
        if not library() or not METHODS[way.method].marches or not compiled.nx:
            return False
        return not integrator.loops or (way.moves and at.constants.all_count)

    def _run(self, at: Point, way: Way) -> Run:
        """The run, made anew where the way changes."""
        if self._made is None or self._made[0] is not way:
            integrator = self.integrator
            c, problem = integrator.compiled, integrator.problem
            content = run_file(problem, integrator.settings, at, way.tolerance)
            sizes = c.nx, c.nz, len(at.constants.vector), len(c.guards.watched)
            room = min(SAMPLING.rows, 4 + SAMPLING.numbers // sum(sizes[:3]))
            self._made = way, Run(content, sizes, room)
        return self._made[1]
