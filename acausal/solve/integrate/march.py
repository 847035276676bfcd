"""An integration that is told to go on a few steps at a time, and is known everywhere in them."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from acausal.policy import POLICY
from acausal.solve.initialization.independent_constraints import IndependentConstraints
from acausal.solve.integrate.attempt import Integrator
from acausal.solve.integrate.by_core import ByCore
from acausal.solve.integrate.energy import along
from acausal.solve.integrate.integration import Request
from acausal.solve.integrate.ladder import Kind, Refusal
from acausal.solve.integrate.methods import METHODS
from acausal.solve.integrate.trace import Leg
from acausal.solve.integrate.unfit import fit_rows
from acausal.solve.looks import uneven
from acausal.solve.point import Point, Rows

LOOKS = POLICY.looks


class March:
    """An integration of a segment by the core.

    Parameters
    ----------
    integrator : Integrator
        Integrates the run; its counts go on.
    at : Point
        Where it begins.
    outputs : array, shape (n + 1,)
        Start and output times up to the end of the segment, in s.
    first_step : float
        Step in s with which to begin; chosen if 0.

    Attributes
    ----------
    refusal : Refusal or None
        Why it does not go on.
    step : float
        Length in s of the longer of the last two steps that were kept.
    """

    def __init__(self, integrator: Integrator, at: Point, outputs: np.ndarray, first_step: float) -> None:
        self.integrator, self._outputs, self._start, self._at = integrator, outputs, at, at
        way, self._steps = integrator.way, LOOKS.steps
        self._pieces = len(integrator.trace.pieces)
        self.refusal: Refusal | None = None
        self.step = first_step
        self._way = integrator.settings.first(way, outputs)
        start = integrator.restarted(at, way.moves)
        request = Request(
            *(integrator.problem, integrator.settings, self._way, start, outputs, False),
            *(integrator.rounding(start), first_step, True),
        )
        method = METHODS[way.method]
        self._integration = ByCore(request, method.damps, method.multistep)
        self._counted = np.zeros(4, dtype=int)

    def goes_on(self, at: Point, end: float) -> bool:
        """Whether it has come to a point, on its way to an end."""
        return end == self._outputs[-1] and at.time == self._at.time and not at.differs(self._at)

    def go(self, density: int) -> Leg | None:
        """Take some steps, twice as many as before, and return them as `leg` does; None if it is refused at once."""
        leg = None
        while not (leg or self.refusal):
            self._advance()
            if not (self.refusal and self.refusal.kind is Kind.FLAT):
                leg = self.leg(density)
        return leg

    def _advance(self) -> None:
        with self.integrator.trace.counting(self._way.method, self._more):
            self.refusal = self._integration.advance(self._steps)
        self._steps = min(2 * self._steps, POLICY.calls.steps)
        self._curve = self._integration.curve

    def _more(self) -> list[int]:
        """What was counted since the last time, all of it in one call."""
        before, self._counted = self._counted, np.array([*self._integration.counts, 1])
        return (self._counted - before).tolist()

    def leg(self, density: int) -> Leg | None:
        """Return the last steps, with so many pairs of looks in each, and between two outputs; None if there are none.

        Only those in which the constraints that are kept stay fit.
        """
        ends = self._curve.times
        if len(ends) == 1:
            return None
        inside = self._outputs[(self._outputs > ends[0]) & (self._outputs < ends[-1])]
        grid = np.union1d(ends, inside)
        parts = 2 ** max(1 + int(np.ceil(np.log2(density))), int(np.log2(LOOKS.fine / (len(grid) - 1))))
        times = uneven(grid, parts)
        energy, own = np.zeros((len(times), 2)), self.integrator
        if own.settings.energy and not own.compiled.powers.is_zero():
            energy = along(own.consistent, self.rows, times)
        constants, rows = self._integration.request.at.constants, self.rows(times)
        n = fit_rows(IndependentConstraints(own.problem, times, rows.x, constants)) if self.unfit else len(rows) - 1
        return Leg(rows[1 : n + 1], energy[1 : n + 1], constants, len(ends) - 1, self.rows) if n else None

    def rows(self, times: np.ndarray) -> Rows:
        """Rows at times in the last steps, algebraic unknowns nearly right."""
        y, nx = self._curve(times), self.integrator.problem.nx
        return Rows.within(times, y[:, :nx], y[:, nx:], self._integration.request.at.constants.vector)

    def is_coarse(self, time: float) -> bool:
        """Whether a time is so early in the first of the last steps that errors of that drown what moved until then."""
        begin, end = self._curve.times[:2]
        return LOOKS.roundings * np.spacing(abs(time)) < (time - begin) < LOOKS.early * (end - begin)

    def keep(self, leg: Leg, time: float) -> Leg | None:
        """Return a leg up to a time: outputs, some ends of steps, and a last row that satisfies the equations.

        None if it is refused.
        """
        last = int(np.searchsorted(leg.times, time))
        part = leg.part(0, last)
        part = replace(part, rows=part.rows.with_z(part.rows.z.copy()))
        kept = self.integrator.settled(part, self._integration) if last else leg
        if self.integrator.is_worn(leg.rows, leg.constants):
            kept = Refusal(Kind.WORN, float(leg.times[0]))
        if isinstance(kept, Refusal):
            self.refusal = kept
            return None
        flat = self._integration.flat
        if flat is not None and flat <= kept.times[-1]:
            self.integrator.trace.flat.append(flat)
        k = int(np.searchsorted(self._curve.times, min(time, leg.times[-1])))
        self.step = float(np.max(np.diff(self._curve.times[max(k - 2, 0) : max(k, 1) + 1])))
        self._at = kept.end(self._at)
        shown = np.concatenate([self._outputs, self._curve.times[:: LOOKS.steps_a_row], kept.times[-1:]])
        some = np.isin(kept.times, shown)
        return replace(kept, rows=kept.rows[some], energy=kept.energy[some])

    @property
    def unfit(self) -> bool:
        """Whether other constraints are to be kept from the end of the last leg on."""
        return self.refusal is not None and self.refusal.kind is Kind.UNFIT

    def withdrawn(self) -> Point:
        """Return where it began, and let nothing be kept of what it has integrated."""
        del self.integrator.trace.pieces[self._pieces :]
        return self._start
