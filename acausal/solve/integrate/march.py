"""An integration that is told to go on a few steps at a time, and is known everywhere in them."""

from __future__ import annotations

import time as clock
from dataclasses import replace

import numpy as np

from acausal.policy import POLICY
from acausal.solve.integrate.attempt import Integrator
from acausal.solve.integrate.by_core import ByCore
from acausal.solve.integrate.energy import along
from acausal.solve.integrate.integration import Request
from acausal.solve.integrate.ladder import Kind, Refusal
from acausal.solve.integrate.methods import METHODS
from acausal.solve.integrate.trace import Leg
from acausal.solve.looks import uneven
from acausal.solve.points import Point, Rows

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
    at : Point
        The last one that was accepted.
    end : float
        Where the segment ends, in s.
    """

    def __init__(self, integrator: Integrator, at: Point, outputs: np.ndarray, first_step: float) -> None:
        self.integrator, self.outputs, self.at, self.end = integrator, outputs, at, float(outputs[-1])
        way, self._steps, self._calls = integrator.way, LOOKS.steps, 1
        self._start, self._pieces = at, len(integrator.trace.pieces)
        self._way = replace(way, max_steps=integrator.settings.patience(way, outputs))
        start = integrator.restarted(at, way.moves)
        request = Request(
            *(integrator.problem, integrator.settings, self._way, start, outputs, False),
            *(integrator.rounding(start), first_step, True),
        )
        self._integration = ByCore(request, METHODS[way.method].damps)
        self._counted = np.zeros(3, dtype=int)

    def go(self) -> Refusal | None:
        """Take some steps, twice as many as before."""
        trace, started = self.integrator.trace, clock.perf_counter()
        refusal = self._integration.advance(self._steps)
        trace.seconds += clock.perf_counter() - started
        counts = np.array(self._integration.counts)
        trace.count(self._way.method, *(counts - self._counted).tolist(), calls=self._calls)
        self._counted, self._calls = counts, 0
        self._steps = min(2 * self._steps, POLICY.calls.steps)
        self._curve = self._integration.curve
        return refusal

    def leg(self, density: int) -> Leg | None:
        """Return the last steps, with so many pairs of looks in each, and between two outputs; None if there are no steps."""
        ends = self._curve.times
        if len(ends) == 1:
            return None
        inside = self.outputs[(self.outputs > ends[0]) & (self.outputs < ends[-1])]
        grid = np.union1d(ends, inside)
        parts = 2 ** max(1 + int(np.ceil(np.log2(density))), int(np.log2(LOOKS.fine / (len(grid) - 1))))
        times = uneven(grid, parts)
        energy, own = np.zeros((len(times), 2)), self.integrator
        if own.settings.energy and not own.compiled.powers.is_zero():
            energy = along(own.consistent, self.rows, times)
        constants = self._integration.request.at.constants
        return Leg(self.rows(times[1:]), energy[1:], constants, len(ends) - 1, self.rows)

    def rows(self, times: np.ndarray) -> Rows:
        """Rows at times in the last steps, algebraic unknowns nearly right."""
        y, nx = self._curve(times), self.integrator.problem.nx
        return Rows.within(times, y[:, :nx], y[:, nx:], self._integration.request.at.constants.vector)

    def accepted(self, leg: Leg) -> Leg | Refusal:
        """Return a part of a leg of this march whose last row satisfies the equations, or why it is of no use."""
        if self.integrator.is_worn(leg.rows, leg.constants):
            return Refusal(Kind.WORN, float(leg.times[0]))
        return self.integrator.settled(leg, self._way)

    def withdrawn(self) -> Point:
        """Return where it began, and let nothing be kept of what it has integrated."""
        del self.integrator.trace.pieces[self._pieces :]
        return self._start

    def step(self, time: float) -> float:
        """Length in s of the longer of two steps, the one that a time lies in and the one before it."""
        k = int(np.searchsorted(self._curve.times, time))
        return float(np.max(np.diff(self._curve.times[max(k - 2, 0) : k + 1]), initial=0.0))
