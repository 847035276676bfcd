"""Integration by the core."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from acausal.compiler.constants import Constants
from acausal.compiler.core_equations import core_equations
from acausal.core import Curve, End, Stepper, idas
from acausal.policy import POLICY
from acausal.solve.initialization.independent_constraints import IndependentConstraints
from acausal.solve.integrate.branches import first_jump
from acausal.solve.integrate.consistent import Consistent
from acausal.solve.integrate.flat import flat_time, looked_at, passes_flat
from acausal.solve.integrate.integration import Integration, Request
from acausal.solve.integrate.ladder import Kind, Refusal
from acausal.solve.integrate.one_step import at_once, error_test, multistep_settings
from acausal.solve.integrate.trace import Leg
from acausal.solve.integrate.unfit import unfit_time
from acausal.solve.problem import Problem

REFUSALS = {
    End.MANY: Kind.STEPS,
    End.SHORT: Kind.ERROR_TEST,
    End.UNSOLVED: Kind.CORRECTOR,
    End.ROUNDING: Kind.ROUNDING,
}


class ByCore(Integration):
    """Integration by a stepper of the core.

    Parameters
    ----------
    request : Request
        What it is asked for.
    damps : bool, optional
        Whether Rodas5P sees rates only as far as they change coordinates, see `sizes`; else errors of rates count, but for
        vibrations that its steps do not resolve. Then, loops that may pass a flat position are left to another method;
        where it damps, it tells that they passed one.
    multistep : bool, optional
        Whether IDAS integrates, whose Newton iteration keeps to the motion in flat positions.
    """

    def __init__(self, request: Request, damps: bool = False, multistep: bool = False) -> None:
        self.request = request
        problem, way, at = request.problem, request.way, request.at
        equations = core_equations(problem.compiled, request.works, way.moves)
        self._at_once = at_once(equations)
        most = max(POLICY.rescue.fewest_long, way.max_steps) if damps else way.max_steps
        self._ringing = None if damps or multistep else way.ringing
        loops = bool(problem.compiled.constraints.size)
        self._loops, self._damps, self._returns = loops, damps, loops and way.moves
        self._multistep = multistep
        self.ended, self._keeps = False, loops or request.curves
        self._window, self._stride, self._crept = (0, 0, at.time), 0.0, 0
        self._again: ByCore | None = None
        self._looks = POLICY.calls.few
        self._stepper = idas(equations) if multistep else Stepper(equations)
        settings = request.settings
        if multistep:
            test = vars(multistep_settings(problem, settings, way, request.floor))
        else:
            test = error_test(problem, settings, damps)
        self._found = self._stepper.begin(
            *(request.times, at.x, at.z, problem.p, at.constants.vector),
            **test,
            tolerance=way.tolerance,
            first_step=min(request.first_step, request.span),
            room=POLICY.calls.steps if self._keeps else 0,
            curves=request.curves,
            most=min(most, self._ringing.steps) if self._ringing else most,
            share=request.share,
        )

    @property
    def counts(self) -> tuple[int, int, int]:
        """Steps, factorisations and evaluations of the equations so far."""
        done = self._stepper.progress
        return done.steps, done.factors, done.values

    def follows(self) -> bool:
        """Return whether residuals between steps are small and their Jacobian stayed regular, as by Newton iterations."""
        if self._multistep:
            return True
        done, (tolerances, most) = self._stepper.progress, POLICY.calls.left
        return done.left <= min(tolerances * self.request.way.tolerance, most) and not done.turned

    def jump(self, consistent: Consistent) -> float | None:
        """Time in s of the first jump of an algebraic unknown since it was asked last: all steps are taken again.

        Loops are looked at in other ways; what keeps them closed leaves more between steps.
        """
        if self._loops:
            return None
        again = self._again = self._again or ByCore(replace(self.request, curves=True), self._damps)
        refusal = None
        while not (refusal or again.ended or again.reached >= self.reached):
            refusal = again.advance(POLICY.calls.steps)
            found = first_jump(consistent, again.curve, self.request.at.constants.vector)
            if found is not None:
                return found
        return None

    @property
    def reached(self) -> float:
        """Time in s after the last step."""
        return self._stepper.progress.time

    @property
    def taken(self) -> np.ndarray | None:
        """Steps up to the start and each output, with parts of steps."""
        return np.append(0.0, self._found.taken)

    def go(self) -> Refusal | None:
        """Integrate to the end, or as far as possible."""
        refusal = None
        while not (refusal or self.ended):
            refusal = self.advance(POLICY.calls.steps if self._loops else 2**62)
        return refusal

    def advance(self, steps: int) -> Refusal | None:
        """Take some steps at most, refused ones among them; where they are kept, as many as take some hundredths of a second."""
        steps = min(steps, self._at_once) if self._keeps else steps
        if not self.request.at.constants.all_count:
            steps, self._looks = min(steps, self._looks), 2 * self._looks
        if self._returns and self._stepper.progress.steps:
            self._return()
        end, time = self._stepper.go(steps, self._at_once), self._stepper.progress.time
        self.ended = end == End.DONE
        if end == End.MANY and self._ringing:
            rings = self.request.settings.rings(self._ringing.interval)
            self._stepper.allow(self._ringing.steps if rings else self.request.way.max_steps)
            self._ringing, end = None, End.MORE
        held = self._held() if self._loops else None
        if held and (unfit := unfit_time(held, self.request.times[0])) is not None:
            return Refusal(Kind.UNFIT, unfit)
        if held and self._damps:
            self.flat = flat_time(*self._last_steps) if self.flat is None else self.flat
        elif (held and not self._multistep) and (
            passes_flat(held)
            or (self.request.way.moves and end in (End.SHORT, End.UNSOLVED))
            or (end == End.MORE and self._creeps())
        ):
            return Refusal(Kind.FLAT, time)
        return Refusal(REFUSALS[end], time) if end in REFUSALS else None

    @property
    def curve(self) -> Curve:
        """The motion in the last steps."""
        return self._stepper.curve

    def _return(self) -> None:
        """Go on from where the constraints have the states: errors that lead away from there would add up."""
        time, x, z = self._stepper.last
        there = self.request.problem.projected(replace(self.request.at, time=time, x=x, z=z))
        self._stepper.move(there.x, there.z)

    def _held(self) -> IndependentConstraints:
        """The constraints of loops at the last steps."""
        problem, times, y, constants = self._last_steps
        return looked_at(problem, times, y[:, : problem.nx], constants)

    def _creeps(self) -> bool:
        """Whether some steps bring it hardly forward, and many of them are taken again, shorter, twice in a row.

        Once, that may be a long step that is shortened to what begins to move.
        """
        done, calls, (steps, refused, time) = self._stepper.progress, POLICY.calls, self._window
        taken, again, forward = done.steps - steps, done.refused - refused, done.time - time
        if taken + again < calls.window:
            return False
        self._window, self._stride = (done.steps, done.refused, done.time), max(self._stride, forward)
        creeps = forward < calls.creeps * self._stride and again > calls.often * (taken + again)
        self._crept = self._crept + 1 if creeps else 0
        return self._crept > 1

    @property
    def _last_steps(self) -> tuple[Problem, np.ndarray, np.ndarray, Constants]:
        return self.request.problem, *self._stepper.steps, self.request.at.constants

    def leg(self) -> Leg:
        """Return the values at all output times: nan at those that were not reached, integrals 0 where none were asked for."""
        found = self._found
        return self.request.leg(found.x, found.z, found.integral, self._stepper.progress.steps)
