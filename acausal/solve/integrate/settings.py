"""How a run is to be integrated."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from acausal.policy import POLICY
from acausal.solve.integrate.ladder import Rescues, Way
from acausal.solve.integrate.order import Spectrum, order_limit

RESCUE = POLICY.rescue

Progress = Callable[[float, int], None]


@dataclass(frozen=True)
class Settings:
    """How to integrate.

    Attributes
    ----------
    nominal : array
        Sizes of states and algebraic unknowns.
    tolerance : float
        Relative tolerance.
    outputs : int
        Output intervals of the whole run.
    spectrum : Spectrum
        Eigenvalues at the start.
    span : float
        Length of the whole run in s.
    given_order : int or None
        Limit of the order of the multistep method; None where eigenvalues tell.
    energy : bool
        Whether to integrate the powers as well.
    progress : callable, optional
        Told the part that is done, and the steps.
    methods : tuple of str
        Methods that may be taken, the first one first.
    constraints : str
        As of `simulate`.
    """

    nominal: np.ndarray
    tolerance: float
    outputs: int
    spectrum: Spectrum
    span: float
    given_order: int | None
    energy: bool
    methods: tuple[str, ...]
    progress: Progress | None = None
    constraints: str = "auto"

    @cached_property
    def limit(self) -> tuple[int, str]:
        """Limit of the order of the multistep method, and why."""
        return (self.given_order, "given") if self.given_order else order_limit(self.spectrum.values, self.span)

    @property
    def max_order(self) -> int:
        """Limit of the order of the multistep method."""
        return self.limit[0]

    def order(self, way: Way) -> int:
        """Highest order of the multistep method in a way."""
        return way.order or self.max_order

    @property
    def order_is_open(self) -> bool:
        """Whether a trial may decide on the highest order."""
        return self.given_order is None and self.max_order < POLICY.order.highest

    @property
    def way(self) -> Way:
        """The way to begin with."""
        # With IDAS the projection is fixed: updating it excites elastic vibrations, which IDAS would then resolve.
        moves = self.constraints == "projection" or (self.constraints == "auto" and self.methods[0] != "idas")
        return Way(self.methods[0], moves, self.tolerance)

    def may_ring(self, times: np.ndarray) -> bool:
        """Whether vibrations that outputs at some times cannot show may cost more steps than the motion."""
        return self.rings(float(np.max(np.diff(times))))

    def rings(self, interval: float) -> bool:
        """The same for the longest distance of outputs, in s."""
        return len(self.methods) > 1 and self.vibrates(interval)

    def vibrates(self, interval: float) -> bool:
        """Whether there are vibrations that outputs at this distance, in s, cannot show."""
        return self.spectrum.vibration * interval > 2 * np.pi

    def rescues(self, times: np.ndarray, loops: bool) -> Rescues:
        """What may be changed between tries of a leg with these outputs."""
        return Rescues(self.methods, self.constraints == "auto", loops, self.may_ring(times), self.tolerance)

    def patience(self, way: Way, times: np.ndarray) -> int:
        """Steps for an output interval after which a first call is given up."""
        n = len(times) - 1
        if way.method in ("following", self.methods[-1]) or not self.may_ring(times):
            return max(RESCUE.fewest_long, RESCUE.long // n)
        return max(RESCUE.fewest_short, RESCUE.short // n)

    def ringing(self, way: Way) -> int:
        """Return the steps for an output interval after which vibrations that outputs cannot show are damped."""
        return max(RESCUE.fewest_following, int(RESCUE.following / np.sqrt(way.tolerance) / self.outputs))
