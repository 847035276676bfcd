"""Integration: one call for each smooth segment, chunks where a run is long or fails."""

from __future__ import annotations

import re
import time as clock
from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np

from acausal.compiler.call import Call
from acausal.compiler.constants import Constants
from acausal.solve.consistent import Consistent
from acausal.solve.energy import RESOLVED, ROWS, everywhere, refined
from acausal.solve.interrupted import keep_reached
from acausal.solve.methods import Way, multistep, one_step, rounding
from acausal.solve.passage import HOPELESS, LONG, creep
from acausal.solve.problem import Point, Problem
from acausal.solve.projection import WORN, choose_projection, worn
from acausal.solve.trace import Stretch, Trace

CHUNKS = 25
# Times in a call at which at least the choice of states is looked at.
FINE = 60
# Looks at the projection after a call cost about the cube of the number of constraints each.
WORK = 2e7
# What is integrated in place of a coordinate follows it; so far off, in parts of its size, it has lost it.
APART = 0.1
# Steps for all outputs together before vibrations count as in the way.
SHORT = 40_000
Progress = Callable[[float, int], None]


@dataclass(frozen=True)
class Settings:
    """How to integrate.

    `nominal` holds the sizes of states and algebraic unknowns, `fastest` the size of the largest eigenvalue at the start
    in 1/s.
    """

    nominal: np.ndarray
    tolerance: float
    max_order: int
    energy: bool
    progress: Progress | None = None
    constraints: str = "auto"
    method: str = "auto"
    fastest: float = 0.0


class Failure(Exception):
    """The integrator gave up; `time` is where, `reason` what it said."""

    def __init__(self, time: float, reason: str) -> None:
        super().__init__(reason)
        self.time, self.reason = time, reason


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
        Of an earlier run whose counts go on.
    """

    def __init__(self, problem: Problem, settings: Settings, span: tuple[float, float], before: Trace) -> None:
        self.problem, self.compiled, self.settings, self.span = problem, problem.compiled, settings, span
        self.hoisted = self.compiled.hoist(problem.p)[0].copy()
        self.trace = before.emptied()
        self.consistent = Consistent(problem)
        self.complaint, self.outputs = "", 1
        self.moves, self.worn = settings.constraints == "projection", False
        self.rings, self.rough = settings.method == "rosenbrock", False
        self._floor: np.ndarray | None = None
        self.tolerance = settings.tolerance

    def segment(self, at: Point, times: np.ndarray) -> Point:
        """Integrate from times[0] through all other times, without a break between them; return the last point.

        Raises
        ------
        Failure
            If the integrator gives up; the trace holds what was reached.
        """
        n = self.outputs = len(times) - 1
        while not (done := self._call(at, times, self.patience(times), careful=False)) and self.rescue(times):
            pass
        if done:
            return done
        self.rings = self.settings.method == "rosenbrock"
        size = max(1, -(-n // CHUNKS))
        for first in range(0, n, size):
            part = times[first : first + size + 1]
            at = self._call(at, part, HOPELESS // (len(part) - 1)) or creep(self, at, part)
            self.report(part[-1])
        return at

    def rounding(self, at: Point) -> np.ndarray:
        """Absolute errors that rounding causes, looked at once a run and only where the tolerance comes near them."""
        if self._floor is None:
            near = self.settings.tolerance < 1e-8 and self.compiled.nz
            c = self.compiled
            self._floor = rounding(self.problem, at) if near else np.zeros(c.nx + c.nz)
        return self._floor

    def patience(self, times: np.ndarray) -> int:
        """Steps for an output interval after which a first call is given up."""
        n = len(times) - 1
        return max(100, SHORT // n) if self._may_ring(times) else max(1000, LONG // n)

    def _may_ring(self, times: np.ndarray) -> bool:
        """Whether vibrations that outputs cannot show may cost more steps than the motion."""
        longest = float(np.max(np.diff(times)))
        return self.settings.method == "auto" and not self.rings and self.settings.fastest * longest > 2 * np.pi

    def rescue(self, times: np.ndarray) -> bool:
        """Change what made a first call fail; False if there is nothing to change.

        The projection moves where the chosen states became unfit. The one-step method damps vibrations that take the
        steps, and, without a Newton iteration, gets past positions where the equations are singular.
        """
        moves = self.moves or (self.settings.constraints == "auto" and self.worn)
        stuck = self.settings.method == "auto" and moves == self.moves and "corrector" in self.complaint
        rings = self.rings or stuck or ("mxstep" in self.complaint and self._may_ring(times))
        changed = (moves, rings) != (self.moves, self.rings)
        self.moves, self.rings = moves, rings
        return changed

    def _choose(self, at: Point) -> Point:
        """Start anew from where the constraints hold, with a projection that suits the position."""
        c = self.compiled
        if not c.closing.size:
            return at
        z = at.z.copy()
        z[c.closing.multipliers] = 0.0
        at = replace(self.problem.projected(at), z=z)
        self.trace.choices += 1
        return replace(at, constants=choose_projection(self.problem, at, moves=self.moves))

    def _is_worn(self, times: np.ndarray, x: np.ndarray, constants: Constants) -> bool:
        """Whether the chosen states became unfit on the way."""
        c = self.compiled
        if not c.closing.size or self.moves:
            return False
        looks = int(np.clip(WORK / c.closing.size**3, 8, 100))
        some = np.unique(np.linspace(0, len(times) - 1, min(len(times), looks)).astype(int))
        return bool(np.any(worn(self.problem, x[some], times[some], constants) < WORN))

    def _call(self, at: Point, times: np.ndarray, max_steps: int, careful: bool = True) -> Point | None:
        stretch = self.attempt(at, times, max_steps, careful)
        if stretch is None:
            return None
        self.trace.add(stretch)
        return stretch.end(at)

    def trial(self, at: Point, times: np.ndarray, max_steps: int) -> Stretch | None:
        """Integrate as `attempt` does, carefully where that fails; nobody asks for works."""
        tries = (self.attempt(at, times, max_steps, careful, works=False) for careful in (False, True))
        return next((stretch for stretch in tries if stretch is not None), None)

    def attempt(
        self, at: Point, times: np.ndarray, max_steps: int, careful: bool, works: bool = True
    ) -> Stretch | None:
        """Integrate from a point, at times[0], through all other times in one call; None where the integrator gives up.

        Works are 0 where they are not asked for.
        """
        c = self.compiled
        if not c.nx:
            return everywhere(self.consistent, at, times, self.tolerance if self.settings.energy else None)
        at = self._choose(at)
        parts = -(-FINE // (len(times) - 1)) if c.closing.size and not self.moves else 1
        works = works and self.settings.energy
        if works and not c.powers.is_zero():
            more = max(1, -(-ROWS // ((len(times) - 1) * parts)))
            parts, max_steps = parts * more, -(-max_steps // more)
        times = np.interp(np.arange((len(times) - 1) * parts + 1) / parts, np.arange(len(times)), times)
        span = times[-1] - times[0]
        grid = tuple(np.round((times[1:] - times[0]) / span, 12).tolist())
        way = (one_step if self.rings else multistep)(self, at, times, max_steps, careful)
        call = c.integrator(way.plugin, grid, way.options, works, self.moves)
        x_size, z_size = way.sizes
        given = {"x0": at.x / x_size, "z0": at.z / z_size}
        vector, own = at.constants.vector, x_size if way.plugin != "idas" else []
        given["p"] = np.concatenate([[times[0], span], self.hoisted, vector, own])
        for k, name in enumerate(call.function.name_in()):
            if name in given:
                call.inputs[k][:] = given[name]
        call.clear()
        try:
            return self._outcome(call, way, at, times, parts)
        except KeyboardInterrupt:
            keep_reached(self, call, way, times, at.constants, parts)
            raise

    def _outcome(self, call: Call, way: Way, at: Point, times: np.ndarray, parts: int) -> Stretch | None:
        """Evaluate a call, and return one row in so many that hold; None where it failed or went astray."""
        c, trace, n = self.compiled, self.trace, len(times) - 1
        started = clock.perf_counter()
        done, self.complaint = call.attempt()
        trace.seconds += clock.perf_counter() - started
        steps = trace.count(call.stats, way.plugin)
        if not done:
            self.worn = bool(c.closing.size) and "mxstep" not in self.complaint
            return None
        states, algebraics, energy = way.rows(call)
        self.worn = self._is_worn(times[1:], states, at.constants)
        if self.worn:
            return None
        few = RESOLVED if way.plugin == "idas" and self.settings.max_order <= 2 else 1
        if energy is not None and not c.powers.is_zero() and steps < n * few:
            rows = np.vstack([at.x, states]), np.vstack([at.z, algebraics]), times, at.constants.vector
            given = np.vstack([np.zeros((1, 2)), energy])
            work, known = refined(c, self.consistent, rows, given, self.tolerance, steps < n)
            energy, self.rough = work[1:], self.rough or not known
        energy = np.zeros((n, 2)) if energy is None else energy
        return self._settled(Stretch(times[1:], states, algebraics, energy, at.constants, steps).every(parts))

    def _settled(self, stretch: Stretch) -> Stretch | None:
        """What goes on from the last row starts on the equations; the other rows settle when somebody reads them."""
        last, vector = slice(-1, None), stretch.constants.vector
        z = self.consistent(stretch.x[last], stretch.z[last], stretch.times[last], vector)
        lost, self.consistent.unsolved = self.consistent.unsolved, []
        end = Point(float(stretch.times[-1]), stretch.x[-1], z[-1], stretch.constants)
        q = self.problem.projected(end).x
        if not np.all(np.abs(q - end.x) <= APART * (self.settings.nominal[: len(q)] + np.abs(q))):
            self.complaint, self.worn = "At t = 1.0, the loops came apart", True
            return None
        if lost and not self.consistent.holds(end.x, end.z, lost[0], vector, self.tolerance):
            self.complaint = "At t = 1.0, the algebraic equations have no solution there"
            self.worn = bool(self.compiled.closing.size)
            return None
        return replace(stretch, z=np.vstack([stretch.z[:-1], z]))

    def report(self, time: float) -> None:
        """Tell the progress."""
        if self.settings.progress:
            start, stop = self.span
            self.settings.progress((time - start) / (stop - start), self.trace.steps)

    def failure(self, start: float, end: float) -> Failure:
        """Read time and reason from what IDAS says, such as `At t = 0.5 and h = 1e-9, the error test failed`."""
        found = re.search(r"At t = ([-+.\deE]+)[^,]*,[\s,]*([^\n]*)", self.complaint)
        if not found:
            return Failure(float(start), "it found no step short enough, or needs more steps than it may take")
        return Failure(float(start + float(found[1]) * (end - start)), found[2].strip().rstrip("."))
