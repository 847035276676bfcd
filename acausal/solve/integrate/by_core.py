"""Integration by the core."""

from __future__ import annotations

import numpy as np

from acausal.compiler.core_equations import core_equations
from acausal.core import End, Rodas
from acausal.policy import POLICY
from acausal.solve.integrate.flat import passes_flat
from acausal.solve.integrate.integration import Integration, Request
from acausal.solve.integrate.ladder import Kind, Refusal
from acausal.solve.integrate.one_step import first_step, sizes
from acausal.solve.integrate.trace import Leg

REFUSALS = {End.MANY: Kind.STEPS, End.SHORT: Kind.ERROR_TEST, End.UNSOLVED: Kind.CORRECTOR}


class ByCore(Integration):
    """Integration by the one-step method of the core.

    Parameters
    ----------
    request : Request
        What it is asked for.
    damps : bool
        Whether it sees rates only as far as they change coordinates, see `sizes`; else errors of rates count, but for
        vibrations that its steps do not resolve. Then, loops that may pass a flat position are left to another method.
    """

    def __init__(self, request: Request, damps: bool) -> None:
        self.request = request
        problem, way, at = request.problem, request.way, request.at
        equations = core_equations(problem.compiled, request.works, way.moves)
        self._at_once = max(1, POLICY.calls.at_once // (equations.values.size + equations.slopes.size))
        is_rate = np.zeros(problem.nx, dtype=np.int32)
        is_rate[[rate for _, rate in problem.rates]] = 1
        self._wary = bool(problem.compiled.constraints.size) and not damps
        self._last = np.array([at.time]), at.x[None]
        self._rodas = Rodas(equations)
        self._found = self._rodas.begin(
            *(request.times, at.x, at.z, problem.p, at.constants.vector),
            size=sizes(request) if damps else request.settings.nominal[: problem.nx],
            tolerance=way.tolerance,
            first_step=first_step(request) * request.span,
            smooth=None if damps else is_rate,
            room=POLICY.calls.steps if self._wary else 0,
            most=max(POLICY.rescue.fewest_long, way.max_steps) if damps else way.max_steps,
        )

    @property
    def counts(self) -> tuple[int, int, int]:
        """Steps, factorisations and evaluations of the equations so far."""
        done = self._rodas.progress
        return done.steps, done.steps + done.refused, done.values

    def go(self) -> Refusal | None:
        """Integrate to the end, or as far as possible."""
        end, steps = End.MORE, min(self._at_once, POLICY.calls.steps) if self._wary else 2**62
        while end == End.MORE:
            end = self._rodas.go(steps, self._at_once)
            if self._wary and self._passed_flat():
                return Refusal(Kind.FLAT, self._rodas.progress.time)
        if self._wary and self.request.way.moves and end in (End.SHORT, End.UNSOLVED):
            return Refusal(Kind.FLAT, self._rodas.progress.time)
        return None if end == End.DONE else Refusal(REFUSALS[end], self._rodas.progress.time)

    def _passed_flat(self) -> bool:
        """Whether loops may have passed a flat position in the last steps."""
        times, x = (np.concatenate([last, now]) for last, now in zip(self._last, self._rodas.steps, strict=True))
        self._last = times[-1:], x[-1:]
        return passes_flat(self.request.problem, times, x, self.request.at.constants)

    def leg(self) -> Leg:
        """Return the values at all output times: nan at those that were not reached, integrals 0 where none were asked for."""
        found = self._found
        return self.request.leg(found.x, found.z, found.integral, self._rodas.progress.steps)
