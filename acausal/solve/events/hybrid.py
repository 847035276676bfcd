"""Run the core's hybrid loop over a segment, slice by slice."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from acausal.compiler.core_equations import core_equations
from acausal.core import Back, Doubt, End, Equations, Run
from acausal.core import Rows as Recorded
from acausal.errors import InitializationError, caution
from acausal.policy import POLICY
from acausal.solve.events.instant import Instants
from acausal.solve.initialization.initial_modes import origins_text
from acausal.solve.integrate.core_run import make_run
from acausal.solve.integrate.integrator import Integrator
from acausal.solve.integrate.ladder import Kind, Refusal, Way
from acausal.solve.integrate.methods import METHODS, multistep_settings
from acausal.solve.integrate.order_doubt import doubt, is_open
from acausal.solve.integrate.trace import Leg
from acausal.solve.point import Point, Rows

SAMPLING, RESCUE, CALLS = POLICY.sampling, POLICY.rescue, POLICY.calls
REASONS = {
    End.MANY: Kind.STEPS,
    End.SHORT: Kind.ERROR_TEST,
    End.UNSOLVED: Kind.CORRECTOR,
    End.ROUNDING: Kind.ROUNDING,
    Doubt.SINGULAR: Kind.FLAT,
    Doubt.FOLD: Kind.UNSOLVABLE,
    Doubt.UNDEFINED: Kind.UNDEFINED,
}


@dataclass(frozen=True)
class Passed:
    """Result of one slice of the hybrid loop.

    Attributes
    ----------
    leg : Leg or None
        Rows at outputs and after events.
    at : Point
        Point that was reached.
    events : list of float
        Times of the events in s.
    crossed : array of bool or None
        Conditions that change at `at`, and are left to the caller: at the end, or where the iteration of the event failed.
    ends : bool
        Whether the slice is at its end, which has a row.
    weak : int
        Consecutive events with hardly any motion between them.
    work : array, shape (2,)
        Supplied and dissipated energy in J between the last row and an event.
    refusal : Refusal or None
        Why the loop cannot go on from there.
    """

    leg: Leg | None
    at: Point
    events: list[float]
    crossed: np.ndarray | None
    ends: bool
    weak: int
    work: np.ndarray
    refusal: Refusal | None


def at_once(equations: Equations) -> int:
    """Return how many steps of the core take some hundredths of a second, for which an interrupt may wait."""
    return max(1, CALLS.at_once // max(equations.values.size + equations.slopes.size, CALLS.least))


class Hybrid:
    """Hybrid loop of the core.

    Parameters
    ----------
    integrator : Integrator
        Integrates the run.
    instants : Instants or None
        Watched conditions and set-valued laws; None to integrate without events.
    times : array
        Output times in s.

    Attributes
    ----------
    step : float
        First step in s of what follows; chosen if 0.
    """

    def __init__(self, integrator: Integrator, instants: Instants | None, times: np.ndarray) -> None:
        self.integrator, self.instants, self.times, self.step = integrator, instants, times, 0.0
        self._functions = instants.functions if instants else None
        self._made: tuple[Way, Run] | None = None
        self._worked = np.zeros(2)  # supplied and dissipated energy of the run of the core up to the last row, in J
        self._since = np.zeros(2)  # and from there to the last point
        self._hasty = False
        self._steps = 0  # of a slice
        self._led = float(times[0])  # how far steps led when their number was last exceeded
        self._rings: bool | None = None  # whether outputs cannot show vibrations, once that is asked
        self._at: Point | None = None  # where the run pauses

    def go(self, at: Point, end: float, weak: int) -> Passed:
        """Run one slice towards the end of a segment, after `weak` weak events."""
        way = self.integrator.way
        goes_on = at is self._at and self._is_made(way)
        if not goes_on and not self._begin(at, way, weak):
            return Passed(None, at, [], None, False, weak, np.zeros(2), Refusal(Kind.UNSOLVABLE, at.time))
        run, self._at = self._run(at, way), None
        if self._functions and self.integrator.loops:
            self._functions.save()  # for `_before_unfit`
        found = self._slice(run, end, way)
        back = found.back
        if self.instants:
            redundant = self.instants.redundant
            redundant.name(run.redundant(len(redundant.laws)))
            self._tell_of_haste(at.time, bool(run.state.hasty))
        x, z, c, mode, crossed = run.values()
        self.step = run.state.step
        constants = self.integrator.compiled.layout.constants(c)
        point = Point(run.state.time, x, z, constants, mode)
        self._at = point if back in (Back.PAUSED, Back.FULL, Back.END) else None
        if not self.integrator.are_fit(point):
            return self._before_unfit(at, point, goes_on, weak)
        leg = self._leg(found)
        since = np.array([run.state.supplied, run.state.dissipated]) - self._worked
        ends = back is Back.END
        changes = crossed if back is Back.EVENT or (ends and crossed.any()) else None
        self._since = since if changes is None else np.zeros(2)  # an event has a row
        refusal = self._refusal(run, way, point) if back is Back.DOUBT else None
        if refusal and refusal.kind is Kind.STEPS and self._may_go_on(way, refusal.time):
            refusal = None
        return Passed(leg, point, found.events.tolist(), changes, ends, run.state.weak, since, refusal)

    def restart(self) -> None:
        """Choose the next first step anew."""
        self._at, self.step = None, 0.0

    def undefined(self, at: Point) -> Point:
        """Return the point near another one at which a condition has no value."""
        assert self._made is not None
        time, x, z = self._made[1].undefined()
        return replace(at, time=time, x=x, z=z)

    def _refusal(self, run: Run, way: Way, at: Point) -> Refusal:
        """Return why the loop came back in doubt."""
        kind = REASONS.get(run.state.why, Kind.OTHER)
        if self.integrator.loops and way.method == "following" and kind in (Kind.ERROR_TEST, Kind.CORRECTOR):
            kind = Kind.FLAT  # multipliers grow without end near a singular configuration
        return Refusal(kind, run.state.time, at)

    def _begin(self, at: Point, way: Way, weak: int) -> bool:
        """Begin at a point; return whether the equations have a solution there."""
        integrator, problem, method = self.integrator, self.integrator.problem, METHODS[way.method]
        try:
            at = integrator.restarted(at, way.moves)
        except InitializationError:
            return False
        run, how = self._run(at, way), None
        if method.multistep and problem.nx:
            how = multistep_settings(problem, integrator.settings, way, integrator.rounding(at))
        given = at.time, at.x, at.z, problem.p, at.constants.vector, at.mode
        run.begin(
            *given,
            step=self.step,
            tolerance=way.tolerance,
            damps=method.damps,
            multistep=how,
            events=self.instants is not None,
        )
        run.state.weak, self._worked = weak, -self._since
        return True

    def _slice(self, run: Run, end: float, way: Way) -> Recorded:
        """Run a slice and add its counts."""
        integrator = self.integrator
        before, evaluations = self._counts(run), run.state.evaluations

        def counts() -> list[int]:
            return (self._counts(run) - before).tolist()

        limits = integrator.limits
        steps = limits.left(integrator.trace, self._steps) if limits else self._steps
        with integrator.trace.counting(way.method, counts):
            found = run.go(self.times, end, steps=steps, longest=self._longest(way))
        integrator.consistent.evaluations += run.state.evaluations - evaluations
        return found

    def _counts(self, run: Run) -> np.ndarray:
        """Return the numbers of steps, factorisations, residual evaluations and restarts; none where no states are integrated."""
        state = run.state
        return np.array([state.steps, state.factors, state.values, state.begun]) * (self.integrator.problem.nx > 0)

    def _longest(self, way: Way) -> int:
        """Return the largest number of steps between two outputs or events."""
        settings = self.integrator.settings
        if way.max_steps is None and is_open(self.integrator, self.times):
            return doubt(self.integrator, self.times)
        most = way.max_steps or settings.patience(way, self.times)
        if way.method != "following":
            return most
        ringing = settings.ringing(way)
        return min(most, ringing) if self._rings is None else ringing if self._rings else most

    def _may_go_on(self, way: Way, time: float) -> bool:
        """Return whether more steps are allowed than were taken: none where vibrations are the cause that outputs cannot show.

        Else as long as the steps lead on.
        """
        if way.max_steps is None and is_open(self.integrator, self.times):
            return False
        if way.method == "following" and self._rings is None:
            most = self._longest(way)
            self._rings = self.integrator.settings.may_ring(self.times)
            return not self._rings or self._longest(way) > most
        before, self._led = self._led, time
        return not (way.method == "following" and self._rings) and time - before > RESCUE.stalled * np.ptp(self.times)

    def _leg(self, found: Recorded) -> Leg | None:
        """Return the recorded rows as a leg of the trace."""
        if not len(found.times):
            return None
        constants = self.integrator.compiled.layout.constants(found.c[-1])
        work, self._worked = found.work - self._worked, found.work[-1]
        return Leg(Rows(found.times, found.x, found.z, found.c), work, constants)

    def _before_unfit(self, at: Point, reached: Point, goes_on: bool, weak: int) -> Passed:
        """Go back to the begin of a slice at whose end the states chosen for loops are unfit, to choose others."""
        self._at, refusal = None, None
        if self._functions:
            self._functions.restore(at.time)
        if not goes_on:
            least = RESCUE.shortest * float(np.max(np.diff(self.times)))
            if self.integrator.settings.constraints != "auto" and reached.time - at.time > least:
                return self.go(at, float(at.time + reached.time) / 2, weak)
            refusal = Refusal(Kind.WORN, at.time)
        return Passed(None, at, [], None, False, weak, np.zeros(2), refusal)

    def _tell_of_haste(self, time: float, hasty: bool) -> None:
        """Warn once where samples may miss a change of a condition."""
        if self._hasty or not hasty:
            return
        self._hasty, compiled = True, self.integrator.compiled
        caution(
            f"from t = {time:.6g} s on, conditions change faster than they are checked; a change that reverts in between is "
            f"missed. One of these:\n{origins_text(compiled, compiled.guards.watched)}\n"
            "Shorter steps mean more checks: simulate(..., tolerance=...)."
        )

    def _run(self, at: Point, way: Way) -> Run:
        """Return the run, created anew if the configuration has changed."""
        if not self._is_made(way):
            integrator = self.integrator
            c, problem = integrator.compiled, integrator.problem
            own, numbers = integrator.settings, c.nx + c.nz + len(at.constants.vector)
            run = make_run(
                *(problem, at, own.nominal, own.span, way.tolerance),
                energy=own.energy,
                moves=way.moves,
                vibration=own.spectrum.vibration if METHODS[way.method].damps else 0.0,
                functions=self._functions,
                room=min(SAMPLING.rows, 4 + SAMPLING.numbers // numbers),
            )
            self._made = way, run
            self._steps = at_once(core_equations(c, way.moves)) if way.moves or not integrator.loops else CALLS.few
        assert self._made is not None
        return self._made[1]

    def _is_made(self, way: Way) -> bool:
        """Return whether the run is that of a way, but for the steps after which that is given up."""
        return self._made is not None and replace(self._made[0], max_steps=way.max_steps) == way
