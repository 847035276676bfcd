"""Run the core's hybrid loop over a segment, as far as it decides what happens at events."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from acausal.compiler.core_equations import core_equations
from acausal.compiler.runtime import decides
from acausal.core import Back, End, Run
from acausal.core import Rows as Recorded
from acausal.errors import InitializationError
from acausal.policy import POLICY
from acausal.solve.events.ahead import Ahead
from acausal.solve.integrate.ladder import Kind, Refusal, Way, next_ways
from acausal.solve.integrate.methods import METHODS
from acausal.solve.integrate.one_step import at_once, multistep_settings
from acausal.solve.integrate.stored import run_file
from acausal.solve.integrate.trace import Leg
from acausal.solve.point import Point, Rows

SAMPLING = POLICY.sampling


@dataclass(frozen=True)
class Passed:
    """Result of one slice of the hybrid loop.

    Attributes
    ----------
    legs : list of Leg
        Rows at outputs and after events; empty or one leg.
    at : Point
        Point that was reached.
    events : list of float
        Times of the events in s.
    crossed : array of bool, optional
        Conditions that change at `at`, if the event there is left to the caller.
    weak : int
        Consecutive events with hardly any motion between them.
    work : array, shape (2,)
        Supplied and dissipated energy in J since the last row.
    """

    legs: list[Leg]
    at: Point
    events: list[float]
    crossed: np.ndarray | None
    weak: int
    work: np.ndarray


class Hybrid:
    """Hybrid loop of the core, segment by segment.

    Parameters
    ----------
    ahead : Ahead
        Search for events in Python, which takes over where the loop is in doubt.
    times : array
        Output times in s.
    """

    def __init__(self, ahead: Ahead, times: np.ndarray) -> None:
        self.ahead, self.integrator, self.times = ahead, ahead.integrator, times
        self._made: tuple[Way, Run] | None = None
        self._wait, self._next, self._worked = 0, 1, np.zeros(2)
        self._limits: dict[str, int] = {}  # steps of a slice, and between two outputs
        self._at: Point | None = None  # where the run pauses
        self._decides = decides(self.integrator.compiled)

    def go(self, at: Point, end: float, weak: int) -> Passed | None:
        """Run one slice towards the end of a segment, after `weak` weak events; return None if the loop made no progress."""
        way = self.integrator.way
        if at is not self._at and not self._begin(at, way, weak):
            return None
        run, self._at = self._run(at, way), None
        found = self._slice(run, end, way)
        back = found.back
        if run.state.hasty:
            self.ahead.tell_of_haste(at.time)
        self._wait = self._next if back is Back.DOUBT else 0
        self._next = min(2 * self._next, SAMPLING.longest) if back is Back.DOUBT else 1
        if run.state.time <= at.time and back in (Back.END, Back.DOUBT):
            return None
        x, z, c, mode, peak, crossed = run.values()
        if run.state.why == End.FLAT and self._takes_next(way, Refusal(Kind.FLAT, run.state.time)):
            return self._since_last_event(found, at, mode)
        if self._is_worn(found, at) and self._takes_next(way, Refusal(Kind.WORN, at.time)):
            return Passed([], at, [], None, weak, np.zeros(2))
        self.ahead.begin(run.state.step)
        self.ahead.locator.passed = np.maximum(self.ahead.locator.passed, peak)
        point = Point(run.state.time, x, z, self.integrator.compiled.layout.constants(c), mode)
        self._at = point if back in (Back.PAUSED, Back.FULL) else None
        legs = self._legs(found)
        work = np.array([run.state.supplied, run.state.dissipated]) - self._worked
        changes = crossed if back is Back.EVENT else None
        return Passed(legs, point, found.events.tolist(), changes, run.state.weak, work)

    def _begin(self, at: Point, way: Way, weak: int) -> bool:
        """Begin at a point; return whether the core runs the model from there."""
        if self._wait or not self._fits(at, way):
            self._wait = max(0, self._wait - 1)
            return False
        integrator = self.integrator
        try:
            at = integrator.restarted(at, way.moves)
        except InitializationError:
            return False
        run = self._run(at, way)
        method, problem = METHODS[way.method], integrator.problem
        how = (
            multistep_settings(problem, integrator.settings, way, integrator.rounding(at)) if method.multistep else None
        )
        run.begin(
            *(at.time, at.x, at.z, problem.p, at.constants.vector, at.mode),
            **{"step": self.ahead.step, "tolerance": way.tolerance, "damps": method.damps, "multistep": how},
        )
        run.state.weak, self._worked = weak, np.zeros(2)
        return True

    def _slice(self, run: Run, end: float, way: Way) -> Recorded:
        """Run a slice and add its counts."""
        integrator = self.integrator
        before, evaluations = self._counts(run), run.state.evaluations

        def counts() -> list[int]:
            return (self._counts(run) - before).tolist()

        with integrator.trace.counting(way.method, counts):
            found = run.go(self.times, end, leaves=self._decides, **self._limits)
        integrator.consistent.evaluations += run.state.evaluations - evaluations
        return found

    @staticmethod
    def _counts(run: Run) -> np.ndarray:
        """Return the numbers of steps, factorisations, residual evaluations and restarts."""
        state = run.state
        return np.array([state.steps, state.factors, state.values, state.begun])

    def _longest(self, way: Way) -> int:
        """Return the largest number of steps between outputs, or the number after which vibrations are damped instead."""
        settings = self.integrator.settings
        if METHODS[way.method].multistep:
            return settings.patience(way, self.times)
        ringing = settings.first(way, self.times[[0, -1]]).ringing
        return ringing.steps if ringing and settings.rings(ringing.interval) else way.max_steps

    def _is_worn(self, found: Recorded, at: Point) -> bool:
        """Return whether the states chosen for closed loops became unfit in a slice."""
        rows = Rows(found.times, found.x, found.z, found.c)
        return len(rows) > 0 and self.integrator.is_worn(rows, at.constants)

    def _takes_next(self, way: Way, refusal: Refusal) -> bool:
        """Go on in the next way after a refusal; return whether there is one."""
        following = next_ways(way, refusal, self.integrator.settings.rescues(self.times, True))
        if following:
            self.integrator.take(following[0], refusal)
            self._wait, self._next = 0, 1
            self.ahead.begin()
        return bool(following)

    def _since_last_event(self, found: Recorded, at: Point, mode: np.ndarray) -> Passed:
        """Go back to the last event of a slice, or to its start: no method can begin near a singular configuration."""
        n = int(np.searchsorted(found.times, found.events[-1], side="right")) if len(found.events) else 0
        kept = (part[:n] for part in (found.times, found.x, found.z, found.c, found.work))
        times, x, z, c, work = kept
        legs = self._legs(replace(found, times=times, x=x, z=z, c=c, work=work))
        if legs:
            at = replace(legs[0].end(at), mode=mode)
        return Passed(legs, at, found.events.tolist(), None, 0, np.zeros(2))

    def _legs(self, found: Recorded) -> list[Leg]:
        """Return the recorded rows as legs of the trace."""
        if not len(found.times):
            return []
        constants = self.integrator.compiled.layout.constants(found.c[-1])
        work, self._worked = found.work - self._worked, found.work[-1]
        return [Leg(Rows(found.times, found.x, found.z, found.c), work, constants, 0)]

    def _fits(self, at: Point, way: Way) -> bool:
        """Return whether the core runs the model; independent subsets of redundant constraints are selected in Python."""
        integrator = self.integrator
        compiled = integrator.compiled
        if not compiled.nx:
            return False
        return not integrator.loops or bool(at.constants.all_count)

    def _run(self, at: Point, way: Way) -> Run:
        """Return the run, created anew if the configuration has changed."""
        if self._made is None or self._made[0] is not way:
            integrator = self.integrator
            c, problem = integrator.compiled, integrator.problem
            content = run_file(problem, integrator.settings, at, way)
            sizes = c.nx, c.nz, len(at.constants.vector), len(c.guards.watched)
            room = min(SAMPLING.rows, 4 + SAMPLING.numbers // sum(sizes[:3]))
            self._made = way, Run(content, sizes, room)
            steps = at_once(core_equations(c, False, way.moves))
            self._limits = {"steps": steps, "longest": self._longest(way)}
        return self._made[1]
