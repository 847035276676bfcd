"""Integration with IDAS: one call for each smooth segment, chunks where a run is long or fails."""

from __future__ import annotations

import time as clock
from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from acausal.compiler import CompiledModel

FIRST_TRY = 5000
CHUNKS = 25
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
    seconds: float = 0.0


@dataclass(frozen=True)
class Settings:
    """How to integrate."""

    tolerance: float
    max_order: int
    energy: bool
    progress: Progress | None = None


class Failure(Exception):
    """The integrator gave up; `time` is the last output time that was reached."""

    def __init__(self, time: float) -> None:
        super().__init__()
        self.time = time


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

    def options(self, max_steps: int, solver: str, moving: bool) -> dict[str, Any]:
        """Options of IDAS: order limit, algebraic variables out of the error test, weights from nominal values."""
        tolerance = self.settings.tolerance
        return {
            "reltol": tolerance,
            "abstolv": (tolerance * self.compiled.nominal).tolist(),
            "max_multistep_order": self.settings.max_order,
            "suppress_algebraic": True,
            "calc_ic": moving,
            "linear_solver": solver,
            "max_num_steps": max_steps,
            "disable_internal_warnings": True,
            "quad_err_con": False,
            "show_eval_warnings": False,
        }

    def segment(self, times: np.ndarray, x: np.ndarray, z: np.ndarray, modes: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Integrate from times[0] through all other times, without a break between them; return the last point.

        Raises
        ------
        Failure
            If the integrator gives up; the trace holds what was reached.
        """
        if self._call(times, x, z, modes, FIRST_TRY):
            return self._last()
        n = len(times) - 1
        size = max(1, -(-n // CHUNKS))
        for first in range(0, n, size):
            part = times[first : first + size + 1]
            if not self._call(part, x, z, modes, 10**8, "qr"):
                self._creep(part, x, z, modes)
            x, z = self._last()
            self._report(part[-1])
        return x, z

    def _creep(self, times: np.ndarray, x: np.ndarray, z: np.ndarray, modes: np.ndarray) -> None:
        """Go from output to output until the failure."""
        for k in range(len(times) - 1):
            if not self._call(times[k : k + 2], x, z, modes, 10**6, "qr"):
                raise Failure(float(times[k]))
            x, z = self._last()

    def _moving(self, time: float, x: np.ndarray, z: np.ndarray, modes: np.ndarray, span: float) -> bool:
        """Tell whether IDAS must find the first derivatives of the states; it starts from 0."""
        nx = self.compiled.nx
        rates = self.compiled.values(x, z, self.p, time, modes, 0.0)[0][:nx]
        return bool(np.any(np.abs(rates) * span > self.settings.tolerance * self.compiled.nominal[:nx]))

    def _call(
        self,
        times: np.ndarray,
        x: np.ndarray,
        z: np.ndarray,
        modes: np.ndarray,
        max_steps: int,
        solver: str = "csparse",
    ) -> bool:
        c, trace = self.compiled, self.trace
        span = times[-1] - times[0]
        grid = tuple(np.round((times[1:] - times[0]) / span, 12).tolist())
        options = self.options(max_steps, solver, self._moving(times[0], x, z, modes, span))
        call = c.integrator(grid, options, self.settings.energy)
        names = call.function.name_in()
        given = {"x0": x, "z0": z, "p": np.concatenate([[times[0], span], self.hoisted, modes])}
        for k, name in enumerate(names):
            if name in given:
                call.inputs[k][:] = given[name]
        started = clock.perf_counter()
        done = call.succeeds()
        trace.seconds += clock.perf_counter() - started
        stats = call.stats
        trace.calls += 1
        trace.steps += stats.get("nsteps", 0)
        trace.factorisations += stats.get("nlinsetups", 0)
        trace.residual_evaluations += stats.get("nfevals", 0)
        if not done:
            return False
        out = dict(zip(call.function.name_out(), call.outputs, strict=True))
        n = len(grid)
        trace.times.append(np.array(times[1:]))
        trace.x.append(out["xf"].reshape(n, c.nx).copy())
        trace.z.append(out["zf"].reshape(n, c.nz).copy())
        trace.modes.append(np.broadcast_to(modes, (n, len(modes))))
        if self.settings.energy:
            before = trace.energy[-1][-1] if trace.energy else np.zeros(2)
            trace.energy.append(before + out["qf"].reshape(n, 2))
        return True

    def _last(self) -> tuple[np.ndarray, np.ndarray]:
        return self.trace.x[-1][-1], self.trace.z[-1][-1]

    def _report(self, time: float) -> None:
        if self.settings.progress:
            start, stop = self.span
            self.settings.progress((time - start) / (stop - start), self.trace.steps)
