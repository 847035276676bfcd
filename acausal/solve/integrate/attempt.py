"""One call of an integrator, and what is made of it."""

from __future__ import annotations

import time as clock
from dataclasses import replace

import numpy as np

from acausal.compiler.constants import Constants
from acausal.compiler.memo import memo_seconds
from acausal.errors import InitializationError
from acausal.policy import POLICY
from acausal.solve.initialization.coordinate_partitioning import (
    choose_projection,
    least_cosine,
    partitioned,
    projection_cosine,
    projection_is_valid,
)
from acausal.solve.initialization.independent_constraints import reselected
from acausal.solve.initialization.minimum_norm_reactions import minimum_norm_reactions
from acausal.solve.initialization.newton import algebraic
from acausal.solve.integrate.consistent import Consistent
from acausal.solve.integrate.energy import refined
from acausal.solve.integrate.flat import looked_at
from acausal.solve.integrate.integration import Integration, Request
from acausal.solve.integrate.interrupted import reached
from acausal.solve.integrate.ladder import Kind, Refusal, Way
from acausal.solve.integrate.methods import METHODS, rounding
from acausal.solve.integrate.settings import Settings
from acausal.solve.integrate.stateless import everywhere
from acausal.solve.integrate.trace import Leg, Trace
from acausal.solve.integrate.unfit import Reach, unfit_time
from acausal.solve.looks import spread
from acausal.solve.point import Point, Rows
from acausal.solve.problem import Problem


class Integrator:
    """Integration of one model with one set of parameters.

    Parameters
    ----------
    problem : Problem
        The model.
    settings : Settings
        Tolerance, order limit and what else to compute.
    span : (float, float)
        Start and stop time of the whole run, for the progress.
    before : Trace
        Of an earlier run whose counts continue.
    fresh : Constants, optional
        Those of the start, whose projection was chosen there.
    """

    def __init__(
        self,
        problem: Problem,
        settings: Settings,
        span: tuple[float, float],
        before: Trace,
        fresh: Constants | None = None,
    ) -> None:
        self._fresh = fresh
        self.problem, self.compiled, self.settings, self.span = problem, problem.compiled, settings, span
        self.trace = before.emptied()
        self.consistent = Consistent(problem)
        self.way = settings.way
        self.reach = Reach()
        self._floor: np.ndarray | None = None
        self._chosen: tuple[Point, bool, Point] | None = None  # the last choice: where, whether it moves, and what

    def aside(self) -> Integrator:
        """Return an integrator that goes on in the same way, and counts for itself."""
        other = Integrator(self.problem, self.settings, self.span, Trace())
        other.way, other._floor = self.way, self._floor
        return other

    @property
    def tolerance(self) -> float:
        """Relative tolerance of the run."""
        return self.settings.tolerance

    @property
    def order(self) -> int:
        """Highest order of the multistep method in the way of now."""
        return self.settings.order(self.way)

    @property
    def loops(self) -> bool:
        """Whether there are constraints."""
        return bool(self.compiled.constraints.size)

    def rounding(self, at: Point) -> np.ndarray:
        """Absolute errors that rounding causes, computed once a run and only where the tolerance is near them."""
        if self._floor is None:
            near = self.settings.tolerance < POLICY.calls.near_rounding and self.compiled.nz
            c = self.compiled
            self._floor = rounding(self.problem, at) if near else np.zeros(c.nx + c.nz)
        return self._floor

    def take(self, way: Way, refusal: Refusal) -> None:
        """Go on in another way, as the present one was refused."""
        if way.method != self.way.method:
            method = METHODS[way.method]
            damped = ", which damps vibrations that positions do not show" if method.damps else ""
            self.trace.changes.append(f"{method.name} from t = {refusal.time:.6g} s on{damped}: {refusal.kind.value}")
        self.way = replace(way, ringing=None)

    def next_call(self, at: Point, times: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Return the times of the next call, and the rest, see `Reach`."""
        return self.reach.parts(self.problem, at, times, not METHODS[self.way.method].multistep)

    def lasted(self, time: float) -> None:
        """Note for how long in s the constraints that are kept lasted in a call."""
        self.reach.lasted(time, not METHODS[self.way.method].multistep)

    def restarted(self, at: Point, moves: bool) -> Point:
        """Return a point where the constraints hold, with a projection that suits the position.

        Raises
        ------
        InitializationError
            If the equations have no solution there with the constraints that are to be kept.
        """
        if not self.loops:
            return at
        if self._chosen is None or self._chosen[0] is not at or self._chosen[1] != moves:
            self._chosen = at, moves, self._suited(self._refitted(self.problem.projected(at)), moves)
        return self._chosen[2]

    def _refitted(self, at: Point) -> Point:
        """Return the point with other constraints kept, where those that are do not suit it."""
        constants = reselected(self.problem, at)
        if np.array_equal(constants.closures, at.constants.closures):
            return at
        self.trace.choices += 1
        there = replace(at, constants=constants)
        there = replace(there, constants=minimum_norm_reactions(self.problem, there))
        there = replace(there, constants=choose_projection(self.problem, there, spare=False, moves=True))
        return algebraic(self.problem, self.problem.completed(there))

    def _suited(self, at: Point, moves: bool) -> Point:
        """Return the point with a projection that suits it: its own, if that moves along."""
        fits = (at.constants is self._fresh and at.time == self.span[0]) or projection_is_valid(self.problem, at)
        if fits and moves:
            return at
        self.trace.choices += 1
        return replace(
            at, constants=partitioned(self.problem, at) if fits else choose_projection(self.problem, at, moves=moves)
        )

    def is_worn(self, rows: Rows, constants: Constants) -> bool:
        """Whether the chosen states became unfit on the way."""
        if not self.loops or constants.moves:
            return False
        looks = int(np.clip(POLICY.calls.work / self.compiled.constraints.size**3, *POLICY.calls.looks))
        some = rows[spread(len(rows), looks)]
        return bool(np.any(projection_cosine(self.problem, some, constants) < least_cosine(self.problem)))

    def trial(self, at: Point, times: np.ndarray, max_steps: int) -> Leg | Refusal:
        """Integrate in the current way, without works and through jumps."""
        return self.attempt(at, times, replace(self.way, max_steps=max_steps), works=False, leaps=True)

    def attempt(
        self, at: Point, times: np.ndarray, way: Way, works: bool = True, keep: bool = False, leaps: bool = False
    ) -> Leg | Refusal:
        """Integrate from a point, at times[0], through all other times in one call.

        Works are 0 unless requested; a refusal holds what was reached if `keep`; algebraic unknowns may jump if `leaps`.
        """
        c = self.compiled
        if not c.nx:
            return everywhere(self.consistent, at, times, self.tolerance if self.settings.energy else None)
        try:
            at = self.restarted(at, way.moves)
        except InitializationError:
            return Refusal(Kind.UNSOLVABLE, at.time)
        looked_at = self.loops and not way.moves
        parts = share = -(-POLICY.calls.fine // (len(times) - 1)) if looked_at else 1
        works = works and self.settings.energy
        if works and not c.powers.is_zero():
            more = max(1, -(-POLICY.energy.rows // ((len(times) - 1) * parts)))
            parts, way = parts * more, way.shared(more)
        times = np.interp(np.arange((len(times) - 1) * parts + 1) / parts, np.arange(len(times)), times)
        request = Request(self.problem, self.settings, way, at, times, works, self.rounding(at), share=share)
        started, made = clock.perf_counter(), memo_seconds(c)
        try:
            integration = METHODS[way.method].prepare(request)
        except RuntimeError:
            # An entry of the Jacobian that is 0 everywhere leaves an unknown undetermined.
            return Refusal(Kind.UNSOLVABLE, at.time)
        finally:
            self.trace.building += clock.perf_counter() - started - (memo_seconds(c) - made)
        try:
            found = self._outcome(integration)
            if isinstance(found, Leg):
                return self.settled(found.every(parts), integration, leaps)
        except KeyboardInterrupt:
            self._keep_reached(integration, parts)
            raise
        rows = self._reached(integration, parts) if keep else None
        settled = rows and self.settled(rows, integration)
        return replace(found, reached=settled) if isinstance(settled, Leg) else found

    def _outcome(self, integration: Integration) -> Leg | Refusal:
        """Integrate; return the rows, unless that failed or left the solution."""
        request, trace = integration.request, self.trace
        way, at, n = request.way, request.at, len(request.times) - 1
        with trace.counting(way.method, lambda: integration.counts):
            refusal = integration.go()
        if refusal:
            return refusal
        found = integration.leg()
        if self.is_worn(found.rows, at.constants):
            return Refusal(Kind.WORN, at.time)
        trace.flat += [integration.flat] if integration.flat is not None else []
        few, taken = (
            POLICY.energy.resolved if METHODS[way.method].multistep and self.order <= 2 else 1,
            integration.taken,
        )
        if request.works and not self.compiled.powers.is_zero() and (taken is not None or found.steps < n * few):
            given, smooth = np.vstack([np.zeros((1, 2)), found.energy]), taken is not None or found.steps < n
            work, known = refined(self.consistent, found.since(at), given, way.tolerance, taken, smooth)
            found, trace.rough = replace(found, energy=work[1:]), trace.rough or not known
        return found

    def _keep_reached(self, integration: Integration, parts: int) -> None:
        """Keep the rows that an interrupted integration had written, unless it was a trial on the way."""
        begin, end = self.span
        last = self.trace.pieces[-1].rows.times[-1] if self.trace.pieces else begin
        here = np.isclose(
            integration.request.at.time, last, rtol=POLICY.calls.here, atol=POLICY.calls.here * (end - begin)
        )
        found = self._reached(integration, parts) if here else None
        if found and (not self.settings.energy or integration.request.works):
            self.trace.add(found)

    def _reached(self, integration: Integration, parts: int) -> Leg | None:
        """Return the rows that an integration had written before it ended, if they can be used."""
        found = reached(self.consistent, integration)
        if found is None or self.is_worn(found.rows, found.constants):
            return None
        if not found.constants.all_count:
            held = looked_at(self.problem, found.times, found.rows.x, found.constants)
            unfit = unfit_time(held, integration.request.at.time)
            found = found if unfit is None else found.part(0, int(np.searchsorted(found.times, unfit)))
        return found.every(parts) if len(found.rows) >= parts else None

    def settled(self, leg: Leg, integration: Integration, leaps: bool = False) -> Leg | Refusal:
        """Let the last row of a leg, whose arrays are its own, satisfy the equations, as the next call starts from it.

        The other rows are solved when they are read.
        Without a Newton iteration an integration may go on where the equations have no solution, or with another one: if it
        is not sure, some rows tell, and what is between its steps.
        """
        way = integration.request.way
        sure = METHODS[way.method].multistep or integration.follows()
        given = leg.rows[-1:] if sure else leg.rows[spread(len(leg.rows), POLICY.calls.settled)]
        found, lost = self.consistent(given)
        last = found[-1:]
        end = self.problem.point(last, 0)
        q = self.problem.projected(end).x if self.loops else end.x
        if not np.all(np.abs(q - end.x) <= POLICY.loops.apart * (self.settings.nominal[: len(q)] + np.abs(q))):
            return Refusal(Kind.APART, end.time)
        for k in np.flatnonzero(np.isin(given.times, lost)).tolist() if lost else ():
            if not self.consistent.holds(given, k, way.tolerance):
                return Refusal(Kind.UNSOLVABLE, float(given.times[k]))
        # From far away, unknowns may come to rest where the equations do not hold.
        ends = (last, given[-1:])
        if not (sure or self.loops or any(self.consistent.holds(row, 0, POLICY.calls.holds) for row in ends)):
            return Refusal(Kind.UNSOLVABLE, end.time)
        jump = None if sure or leaps else integration.jump(self.consistent)
        if jump is not None and jump <= end.time:
            return Refusal(Kind.UNSOLVABLE, jump)
        leg.rows.z[-1] = last.z[0]
        return leg

    def report(self, time: float) -> None:
        """Report the progress."""
        if self.settings.progress:
            start, stop = self.span
            self.settings.progress((time - start) / (stop - start), self.trace.steps)
