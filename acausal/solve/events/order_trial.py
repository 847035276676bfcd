"""Order limit by trial: where eigenvalues leave it open and many steps are needed, a trial of both limits decides.

Whether fast oscillations matter depends on how much they are excited. At rest, an order limit of 2 is the best; where the
motion needs many steps all the same, high orders may take fewer, as long as these are short enough to be stable.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from acausal.policy import POLICY
from acausal.solve.events.aside import integrate_aside
from acausal.solve.integrate.integrator import Integrator
from acausal.solve.integrate.ladder import Refusal, Way
from acausal.solve.integrate.order_doubt import is_open, patience
from acausal.solve.integrate.trace import Trace
from acausal.solve.point import Point

ORDER = POLICY.order


class OrderTrial:
    """Trials of the order limit in a run.

    Parameters
    ----------
    integrator : Integrator
        Its way takes the order limit that wins.
    times : array
        Output times in s.

    Attributes
    ----------
    until : float
        Time in s up to which the limit is not in doubt; inf where it may be.
    """

    def __init__(self, integrator: Integrator, times: np.ndarray) -> None:
        self.integrator, self.times, self.until = integrator, times, np.inf
        self._waited = False

    def decides(self, at: Point) -> bool:
        """Decide on the limit where the present one needs many steps; return whether the run may go on."""
        integrator, n = self.integrator, len(self.times) - 1
        if at.time < self.until < np.inf or not is_open(integrator, self.times):
            return False
        first, head = int(np.searchsorted(self.times, at.time, "right")), max(1, n // ORDER.heads)
        if self._waited:
            self._choose(at, np.append(at.time, self.times[first : first + head + 1]))
        # What vibrates at a start may be damped soon.
        most = (
            patience(integrator, self.times)
            if self._waited
            else integrator.settings.patience(integrator.way, self.times)
        )
        self.until = float(self.times[min(first - 1 + (max(1, n // ORDER.chunks) if self._waited else head), n)])
        self._waited, integrator.way = True, replace(integrator.way, max_steps=most)
        return True

    def reached(self, time: float) -> None:
        """Let the limit be in doubt again from a time on."""
        if time >= self.until:
            self.until, self.integrator.way = np.inf, replace(self.integrator.way, max_steps=None)

    def _choose(self, at: Point, times: np.ndarray) -> None:
        """Integrate a short way with both limits, and take the one with fewer evaluations of the equations.

        The highest order must win by far: a limit of 2 damps what it does not follow, and what is costly at first becomes cheap.
        """
        integrator = self.integrator
        low, high = integrator.settings.max_order, ORDER.highest
        before, most = replace(integrator.way, order=integrator.order), patience(integrator, self.times)
        gain = ORDER.gain if before.order == low else 1
        found = self._tried(at, times, before, most)
        other = replace(before, order=high if before.order == low else low)
        steps = (
            max(1, found.steps // gain)
            if found
            else integrator.settings.patience(before, self.times) * (len(times) - 1)
        )
        rival = self._tried(at, times[[0, -1]], other, steps)
        if rival is None or (found and gain * rival.residual_evaluations >= found.residual_evaluations):
            return
        integrator.way = replace(integrator.way, order=other.order)
        than = f"{found.residual_evaluations}" if found else f"more than {most} steps for an output"
        integrator.trace.orders.append(
            f"{other.order} from t = {at.time:.6g} s on: a trial took {rival.residual_evaluations} evaluations, "
            f"where order {before.order} took {than}"
        )

    def _tried(self, at: Point, times: np.ndarray, way: Way, most: int) -> Trace | None:
        """Return the counts of a trial, None if it is refused."""
        aside = self.integrator.aside()
        aside.way = way
        found = integrate_aside(aside, at, times, most)
        self.integrator.trace.include(aside.trace)
        return None if isinstance(found, Refusal) else aside.trace
