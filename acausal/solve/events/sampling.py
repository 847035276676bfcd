"""Go on over instants that discrete variables plan at one go, as the sampling of a controller does.

The core does what `Course` does from one instant to the next as long as nothing else happens and nothing is in doubt:
conditions stay clear of their changes, and what becomes true at an instant lets discrete variables jump.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from acausal.compiler.core_equations import core_equations, core_sampled
from acausal.core import Back, SampledState, Sampler, library
from acausal.errors import InitializationError
from acausal.policy import POLICY
from acausal.solve.events.agenda import part_of_time
from acausal.solve.events.ahead import Ahead
from acausal.solve.events.instant import Instants
from acausal.solve.initialization.independent_constraints import IndependentConstraints
from acausal.solve.initialization.newton import terms
from acausal.solve.integrate.flat import flat_time, looked_at, passes_flat
from acausal.solve.integrate.ladder import Way
from acausal.solve.integrate.methods import METHODS
from acausal.solve.integrate.one_step import at_once, error_test
from acausal.solve.integrate.trace import Leg
from acausal.solve.integrate.unfit import unfit_time
from acausal.solve.looks import spread
from acausal.solve.point import Point, Rows

SAMPLING = POLICY.sampling


@dataclass(frozen=True)
class Passed:
    """Instants that were passed: the rows up to the last one, the point after it, and the times of all."""

    leg: Leg
    at: Point
    events: list[float]


class Sampling:
    """Runs over planned instants.

    Parameters
    ----------
    ahead : Ahead
        Looks ahead wherever this does not.
    instants : Instants
        Watched conditions.
    times : array
        Output times in s.
    """

    def __init__(self, ahead: Ahead, instants: Instants, times: np.ndarray) -> None:
        self.ahead, self.integrator, self.instants, self.times = ahead, ahead.integrator, instants, times
        self._made: tuple[Way, Sampler | None] | None = None
        self._wait, self._next = 0, 1

    def go(self, at: Point, end: float) -> Passed | None:
        """Pass instants before the end of a segment, from one that has just happened; None where it is not sure what happens."""
        if self._wait or not (sampler := self._sampler()):
            self._wait = max(0, self._wait - 1)
            return None
        integrator = self.integrator
        trace, way = integrator.trace, integrator.way
        try:
            at = integrator.restarted(at, way.moves)
        except InitializationError:
            return None
        state = SampledState(time=at.time, step=self.ahead.step)
        with trace.counting(way.method, lambda: state.counts):
            found = sampler.go(
                *(state, at.x, at.z, at.constants.vector, at.mode),
                end=end,
                steps=at_once(sampler.sampled.equations),
                density=self.ahead.stride.density,
            )
        integrator.consistent.evaluations += state.evaluations
        rows = Rows(found.times, found.x, found.z, found.c)
        passed = Rows.joined([Rows.of(at), rows]) if integrator.loops else rows
        held = looked_at(integrator.problem, passed.times, passed.x, at.constants) if integrator.loops else None
        if held and (unfit := unfit_time(held, at.time)) is not None and unfit < end:
            return self.go(at, unfit)
        instants = np.isfinite(found.events)
        if not state.instants or not self._is_sure(held, passed, instants):
            if found.back is not Back.NO_INSTANT:
                self._wait, self._next = self._next, min(2 * self._next, SAMPLING.longest)
            return None
        self._next = 1
        self.ahead.begin(state.step)
        self.ahead.locator.passed = np.maximum(self.ahead.locator.passed, found.peak)
        constants = integrator.compiled.layout.constants(rows.constants[-1])
        leg = Leg(rows, found.work, constants, state.steps)
        return Passed(
            leg,
            replace(leg.end(at), time=state.time, mode=found.truth),
            found.events[instants].tolist(),
        )

    def _is_sure(self, held: IndependentConstraints | None, rows: Rows, instants: np.ndarray) -> bool:
        """Whether closed loops pass no flat position in rows; elsewhere, whether equations hold at the instants."""
        if held is None:
            return self._hold(rows[instants])
        if METHODS[self.integrator.way.method].damps:
            y = np.hstack([rows.x, rows.z])
            return flat_time(self.integrator.problem, rows.times, y, held.constants) is None
        return not passes_flat(held)

    def _hold(self, rows: Rows) -> bool:
        """Whether algebraic equations hold in rows: from far away, unknowns may come to rest where they do not."""
        problem, consistent = self.integrator.problem, self.integrator.consistent
        nx, nominal = problem.nx, problem.nominal
        some = [problem.point(rows, k) for k in spread(len(rows), POLICY.consistent.looks)]
        least = np.min([terms(problem.local(at), at.y, nominal)[nx : nx + problem.nz] for at in some], axis=0)
        values = core_equations(problem.compiled, False, self.integrator.way.moves).values
        left = values.rows(rows.x, rows.z, rows.times[:, None], problem.p, rows.constants)[:, nx:]
        doubtful = ~np.all(np.abs(left) <= POLICY.calls.holds * least, axis=1)
        return all(consistent.holds(rows, k, POLICY.calls.holds) for k in np.flatnonzero(doubtful).tolist())

    def _sampler(self) -> Sampler | None:
        """The core's, made anew where the way changes; None where there is none."""
        if self._made is None or self._made[0] is not self.integrator.way:
            self._made = self.integrator.way, self._make(self.integrator.way)
        return self._made[1]

    def _make(self, way: Way) -> Sampler | None:
        problem, settings, method = self.integrator.problem, self.integrator.settings, METHODS[way.method]
        if not library() or not method.marches:
            return None
        sampled, nominal = core_sampled(problem.compiled, settings.energy, way.moves), settings.nominal
        if not sampled or (self.integrator.loops and not way.moves):
            return None
        # Vibrations that one instant after the other does not show may cost more steps than the motion: the search decides.
        whole = self.times[[0, -1]]
        ringing = settings.first(way, whole).ringing
        ringing = ringing if ringing and settings.rings(ringing.interval) else None
        e = sampled.equations
        rows = min(SAMPLING.rows, 1 + SAMPLING.numbers // (e.nx + e.nz + e.nc))
        longest = min(SAMPLING.steps, max(POLICY.looks.steps, at_once(e)))
        thresholds = {
            "span": self.instants.span,
            "tolerance": self.instants.tolerance,
            "soon": POLICY.instants.short,
            "moves": POLICY.instants.moves,
            "level": POLICY.locate.level,
            "reach": POLICY.locate.reach,
            "error": POLICY.locate.error,
            "shortest": self.ahead.locator.shortest,
            "added": part_of_time(POLICY.agenda.added, *self.times[[0, -1]].tolist()),
            "crowded": POLICY.instants.window,
            "enough": POLICY.consistent.settled,
            "noise": POLICY.consistent.noise,
            "apart": POLICY.loops.apart,
        }
        return Sampler(
            *(sampled, rows, thresholds),
            p=problem.p,
            times=self.times,
            nominal=nominal,
            declared=problem.nominal[problem.nx :],
            **error_test(problem, settings, method.damps),
            tolerance=way.tolerance,
            fine=POLICY.looks.fine,
            longest=longest,
            ringing=min(longest, ringing.steps) if ringing else longest,
            calm=2 * np.pi / settings.spectrum.vibration if ringing else np.inf,
        )
