"""Integration with IDAS: one call for each smooth segment, chunks where a run is long or fails."""

from __future__ import annotations

import re
import time as clock
from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from acausal.compiler import CompiledModel
from acausal.solve.initialize import algebraic
from acausal.solve.projection import WORN, choose_projection, worn

CHUNKS = 25
LOOKS = 100
# Steps for all outputs together: before a run counts as long, and before a chunk or an output counts as hopeless.
LONG, HOPELESS = 100_000, 2_000_000
Progress = Callable[[float, int], None]


@dataclass
class Trace:
    """What was integrated: rows of states, algebraic unknowns, integrals of supplied and dissipated power, modes."""

    times: list[np.ndarray] = field(default_factory=list)
    x: list[np.ndarray] = field(default_factory=list)
    z: list[np.ndarray] = field(default_factory=list)
    energy: list[np.ndarray] = field(default_factory=list)
    modes: list[np.ndarray] = field(default_factory=list)
    steps: int = 0
    factorisations: int = 0
    residual_evaluations: int = 0
    calls: int = 0
    choices: int = 0
    seconds: float = 0.0
    before: np.ndarray = field(default_factory=lambda: np.zeros(2))

    def put(self, call: int, x: np.ndarray, z: np.ndarray, modes: np.ndarray) -> None:
        """Put other values into the last row of a call, if there is one."""
        if len(self.x) >= -call:
            self.x[call][-1], self.z[call][-1] = x, z
            self.modes[call] = np.vstack([self.modes[call][:-1], modes])

    def spend(self, energy: np.ndarray) -> None:
        """Add supplied and dissipated energy to all that follows, and to the last row."""
        if self.energy:
            self.energy[-1][-1] += energy
        else:
            self.before = self.before + energy


@dataclass(frozen=True)
class Stretch:
    """Rows of one call: times, states, algebraic unknowns, integrals of power since its start; modes and steps."""

    times: np.ndarray
    x: np.ndarray
    z: np.ndarray
    energy: np.ndarray
    modes: np.ndarray
    steps: int

    def rows(self, first: int, last: int) -> Stretch:
        """Return some of the rows, as if the call had begun at its start all the same."""
        part = slice(first, last)
        return Stretch(self.times[part], self.x[part], self.z[part], self.energy[part], self.modes, self.steps)


@dataclass(frozen=True)
class Settings:
    """How to integrate."""

    tolerance: float
    max_order: int
    energy: bool
    progress: Progress | None = None
    constraints: str = "auto"


class Failure(Exception):
    """The integrator gave up; `time` is where, `reason` what it said."""

    def __init__(self, time: float, reason: str) -> None:
        super().__init__(reason)
        self.time, self.reason = time, reason


class Integrator:
    """IDAS on one model with one set of parameters.

    Parameters
    ----------
    compiled : CompiledModel
        The model.
    p : array
        Parameter values.
    settings : Settings
        Tolerance, order limit and what else to compute.
    span : (float, float)
        Start and stop time of the whole run, for the progress.
    """

    def __init__(self, compiled: CompiledModel, p: np.ndarray, settings: Settings, span: tuple[float, float]) -> None:
        self.compiled, self.p, self.settings, self.span = compiled, p, settings, span
        self.hoisted = compiled.hoist(p)[0].copy()
        self.trace = Trace()
        self.complaint = ""
        self.moves, self.worn = settings.constraints == "projection", False

    def options(self, max_steps: int) -> dict[str, Any]:
        """Options of IDAS: order limit, algebraic variables out of the error test, weights from nominal values."""
        tolerance = self.settings.tolerance
        return {
            "reltol": tolerance,
            "abstolv": (tolerance * self.compiled.nominal).tolist(),
            "max_multistep_order": self.settings.max_order,
            "suppress_algebraic": True,
            "max_num_steps": max_steps,
            "disable_internal_warnings": True,
            "quad_err_con": False,
            # Errors of a loose Newton iteration excite lightly damped vibrations, which then cost steps.
            "nonlin_conv_coeff": 0.05,
            "show_eval_warnings": False,
        }

    def begin(self, time: float, span: float, x: np.ndarray, z: np.ndarray, modes: np.ndarray, careful: bool) -> dict:
        """Options for the start, where IDAS takes all first derivatives as 0 unless it computes them itself.

        The quick way lets it compute them, if any matter; the careful one starts with a step so short that they do not,
        and with the linear solver that does not rely on its pivots.
        """
        nx = self.compiled.nx
        rates = self.compiled.values(x, z, self.p, time, modes, 0.0)[0][:nx]
        weights = self.settings.tolerance * (np.abs(x) + self.compiled.nominal[:nx])
        steepest = float(np.max(np.abs(rates) * span / weights, initial=0.0))
        if not careful:
            return {"linear_solver": "csparse", "calc_ic": steepest > 1}
        start = {"linear_solver": "qr", "calc_ic": False}
        return start | {"step0": 10.0 ** -np.ceil(np.log10(10 * steepest))} if steepest > 1 else start

    def segment(
        self, times: np.ndarray, x: np.ndarray, z: np.ndarray, modes: np.ndarray
    ) -> tuple[np.ndarray, np.ndarray]:
        """Integrate from times[0] through all other times, without a break between them; return the last point.

        Raises
        ------
        Failure
            If the integrator gives up; the trace holds what was reached.
        """
        if not self.compiled.nx:
            self.keep(self._solve_everywhere(times, z, modes))
            return self._last()
        n = len(times) - 1
        if self._call(times, x, z, modes, max(1000, LONG // n), careful=False):
            return self._last()
        if self.rescue() and self._call(times, x, z, modes, max(1000, LONG // n), careful=False):
            return self._last()
        size = max(1, -(-n // CHUNKS))
        for first in range(0, n, size):
            part = times[first : first + size + 1]
            if not self._call(part, x, z, modes, HOPELESS // (len(part) - 1)):
                self._creep(part, x, z, modes)
            x, z = self._last()
            self.report(part[-1])
        return x, z

    def rescue(self) -> bool:
        """Let the projection move where the chosen states became unfit; False if that changes nothing."""
        moves = self.moves or (self.settings.constraints == "auto" and self.worn)
        changed, self.moves = moves != self.moves, moves
        return changed

    def _choose(
        self, time: float, x: np.ndarray, z: np.ndarray, modes: np.ndarray
    ) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """Start anew from where the constraints hold, with a projection that suits the position."""
        c = self.compiled
        if not c.closing.size:
            return x, z, modes
        x = c.closing.project(x, z, self.p, time, modes)
        z = z.copy()
        z[c.closing.multipliers] = 0.0
        self.trace.choices += 1
        return x, z, choose_projection(c, x, z, self.p, time, modes, self.moves)

    def _is_worn(self, times: np.ndarray, x: np.ndarray, modes: np.ndarray) -> bool:
        """Whether the chosen states became unfit on the way."""
        c = self.compiled
        if not c.closing.size or self.moves:
            return False
        some = np.unique(np.linspace(0, len(times) - 1, min(len(times), LOOKS)).astype(int))
        return any(worn(c, x[k], self.p, float(times[k]), modes) < WORN for k in some)

    def _solve_everywhere(self, times: np.ndarray, z: np.ndarray, modes: np.ndarray) -> Stretch:
        """Go from output to output where there is nothing to integrate."""
        found = []
        for time in times[1:]:
            z = algebraic(self.compiled, z, self.p, float(time), modes)
            found.append(z)
        n = len(found)
        return Stretch(np.array(times[1:]), np.zeros((n, 0)), np.array(found), np.zeros((n, 2)), modes, 0)

    def _creep(self, times: np.ndarray, x: np.ndarray, z: np.ndarray, modes: np.ndarray) -> None:
        """Go from output to output until the failure."""
        for k in range(len(times) - 1):
            if not self._call(times[k : k + 2], x, z, modes, HOPELESS):
                raise self.failure(times[k], times[k + 1])
            x, z = self._last()

    def _call(
        self,
        times: np.ndarray,
        x: np.ndarray,
        z: np.ndarray,
        modes: np.ndarray,
        max_steps: int,
        careful: bool = True,
    ) -> bool:
        stretch = self.attempt(times, x, z, modes, max_steps, careful)
        if stretch is None:
            return False
        self.keep(stretch)
        return True

    def attempt(
        self, times: np.ndarray, x: np.ndarray, z: np.ndarray, modes: np.ndarray, max_steps: int, careful: bool
    ) -> Stretch | None:
        """Integrate from times[0] through all other times in one call; None where the integrator gives up."""
        c, trace = self.compiled, self.trace
        if not c.nx:
            return self._solve_everywhere(times, z, modes)
        x, z, modes = self._choose(times[0], x, z, modes)
        span = times[-1] - times[0]
        grid = tuple(np.round((times[1:] - times[0]) / span, 12).tolist())
        options = self.options(max_steps) | self.begin(times[0], span, x, z, modes, careful)
        call = c.integrator(grid, options, self.settings.energy, self.moves)
        names = call.function.name_in()
        given = {"x0": x, "z0": z, "p": np.concatenate([[times[0], span], self.hoisted, modes])}
        for k, name in enumerate(names):
            if name in given:
                call.inputs[k][:] = given[name]
        started = clock.perf_counter()
        done, self.complaint = call.attempt()
        trace.seconds += clock.perf_counter() - started
        stats = call.stats
        trace.calls += 1
        trace.steps += stats.get("nsteps", 0)
        trace.factorisations += stats.get("nlinsetups", 0)
        trace.residual_evaluations += stats.get("nfevals", 0)
        if not done:
            self.worn = bool(c.closing.size) and "mxstep" not in self.complaint
            return None
        out = dict(zip(call.function.name_out(), call.outputs, strict=True))
        n = len(grid)
        energy = out["qf"].reshape(n, 2).copy() if self.settings.energy else np.zeros((n, 2))
        states, algebraics = out["xf"].reshape(n, c.nx).copy(), out["zf"].reshape(n, c.nz).copy()
        self.worn = n > 1 and self._is_worn(times[1:], states, modes)
        if self.worn:
            return None
        return Stretch(np.array(times[1:]), states, algebraics, energy, modes, stats.get("nsteps", 0))

    def keep(self, stretch: Stretch) -> None:
        """Append rows to the trace; integrals of power go on from the last one."""
        trace = self.trace
        before = trace.energy[-1][-1] if trace.energy else trace.before
        trace.times.append(stretch.times)
        trace.x.append(stretch.x)
        trace.z.append(stretch.z)
        trace.energy.append(before + stretch.energy)
        trace.modes.append(np.broadcast_to(stretch.modes, (len(stretch.times), len(stretch.modes))))

    def _last(self) -> tuple[np.ndarray, np.ndarray]:
        return self.trace.x[-1][-1], self.trace.z[-1][-1]

    def report(self, time: float) -> None:
        """Tell the progress."""
        if self.settings.progress:
            start, stop = self.span
            self.settings.progress((time - start) / (stop - start), self.trace.steps)

    def failure(self, start: float, end: float) -> Failure:
        """Read time and reason from what IDAS says, such as `At t = 0.5 and h = 1e-9, the error test failed`."""
        found = re.search(r"At t = ([-+.\deE]+)[^,]*,[\s,]*([^\n]*)", self.complaint)
        if not found:
            return Failure(float(start), "it gave no reason")
        return Failure(float(start + float(found[1]) * (end - start)), found[2].strip().rstrip("."))
