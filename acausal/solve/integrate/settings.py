"""How a run is to be integrated."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from acausal.core import library
from acausal.policy import POLICY
from acausal.solve.integrate.ladder import Rescues, Way

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
    max_order : int
        Limit of the order of the multistep method.
    energy : bool
        Whether to integrate the powers as well.
    progress : callable, optional
        Told the part that is done, and the steps.
    methods : tuple of str
        Methods that may be taken, the first one first.
    constraints : str
        As of `simulate`.
    fastest, vibration : float
        Size of the largest eigenvalue at the start in 1/s, and of the largest that oscillates.
    order_is_open : bool
        Whether a trial may decide on the highest order.
    """

    nominal: np.ndarray
    tolerance: float
    outputs: int
    max_order: int
    energy: bool
    methods: tuple[str, ...]
    progress: Progress | None = None
    constraints: str = "auto"
    fastest: float = 0.0
    vibration: float = 0.0
    order_is_open: bool = False

    @property
    def way(self) -> Way:
        """The way to begin with."""
        # Steps of the core are long, and states that are chosen once wear out.
        by_core = self.methods[0] != "idas" and library() is not None
        moves = self.constraints == "projection" or (self.constraints == "auto" and by_core)
        return Way(self.methods[0], moves, self.tolerance, RESCUE.long, self.max_order)

    @property
    def careful(self) -> str:
        """The method that goes on where a whole segment was refused: one with a Newton iteration, if it may be taken."""
        return "idas" if "idas" in self.methods else self.methods[0]

    def may_ring(self, times: np.ndarray) -> bool:
        """Whether vibrations that outputs at some times cannot show may cost more steps than the motion."""
        return len(self.methods) > 1 and self.vibration * float(np.max(np.diff(times))) > 2 * np.pi

    def rescues(self, times: np.ndarray, loops: bool) -> Rescues:
        """What may be changed between tries of a leg with these outputs."""
        return Rescues(self.methods, self.constraints == "auto", loops, self.may_ring(times), self.tolerance)

    def patience(self, way: Way, times: np.ndarray) -> int:
        """Steps for an output interval after which a first call is given up."""
        n = len(times) - 1
        if way.method == self.methods[-1] or not self.may_ring(times):
            return max(RESCUE.fewest_long, RESCUE.long // n)
        if way.method == "following":
            return max(RESCUE.fewest_following, int(RESCUE.following / np.sqrt(way.tolerance) / self.outputs))
        return max(RESCUE.fewest_short, RESCUE.short // n)
