"""Integration by the core."""

from __future__ import annotations

from acausal.compiler.core_equations import core_equations
from acausal.core import End, Rodas
from acausal.policy import POLICY
from acausal.solve.integrate.integration import Integration, Request
from acausal.solve.integrate.ladder import Kind, Refusal
from acausal.solve.integrate.one_step import first_step, sizes
from acausal.solve.integrate.trace import Leg

REFUSALS = {End.MORE: Kind.STEPS, End.SHORT: Kind.ERROR_TEST, End.UNSOLVED: Kind.CORRECTOR}


class ByCore(Integration):
    """Integration by the one-step method of the core.

    Parameters
    ----------
    request : Request
        What it is asked for.
    """

    def __init__(self, request: Request) -> None:
        self.request = request
        problem, way, at = request.problem, request.way, request.at
        equations = core_equations(problem.compiled, request.works, way.moves)
        self._rodas = Rodas(equations)
        self._most = max(POLICY.rescue.fewest_long, way.max_steps) * (len(request.times) - 1)
        self._at_once = max(1, POLICY.calls.at_once // (equations.values.size + equations.slopes.size))
        self._found = self._rodas.begin(
            *(request.times, at.x, at.z, problem.p, at.constants.vector),
            size=sizes(request),
            tolerance=way.tolerance,
            first_step=first_step(request) * request.span,
        )

    @property
    def counts(self) -> tuple[int, int, int]:
        """Steps, factorisations and evaluations of the equations so far."""
        done = self._rodas.progress
        return done.steps, done.steps + done.refused, done.values

    def go(self) -> Refusal | None:
        """Integrate to the end, or as far as possible."""
        end, progress = End.MORE, self._rodas.progress
        while end == End.MORE and (left := self._most - progress.steps - progress.refused) > 0:
            end = self._rodas.go(min(left, self._at_once))
        return None if end == End.DONE else Refusal(REFUSALS[end], progress.time)

    def leg(self) -> Leg:
        """Return the values at all output times: nan at those that were not reached, integrals 0 where none were asked for."""
        found = self._found
        return self.request.leg(found.x, found.z, found.integral, self._rodas.progress.steps)
