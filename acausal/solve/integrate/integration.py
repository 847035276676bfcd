"""What one integration is asked for, and what it gives."""

from __future__ import annotations

from abc import ABC, abstractmethod
from dataclasses import dataclass

import numpy as np

from acausal.solve.integrate.consistent import Consistent
from acausal.solve.integrate.ladder import Refusal, Way
from acausal.solve.integrate.settings import Settings
from acausal.solve.integrate.trace import Leg
from acausal.solve.point import Point, Rows
from acausal.solve.problem import Problem


@dataclass(frozen=True)
class Request:
    """What one integration is asked for.

    Attributes
    ----------
    problem : Problem
        The model.
    settings : Settings
        How the run is to be integrated.
    way : Way
        How this leg is.
    at : Point
        Where it begins.
    times : array, shape (n + 1,)
        Its start and output times in s.
    works : bool
        Whether to integrate the powers.
    floor : array
        Errors that rounding causes, see `rounding`.
    first_step : float
        Step in s with which to begin, where one is known; else 0.
    curves : bool
        Whether the motion between steps is looked at, in place of outputs.
    share : int
        Number of outputs that share the steps of the way.
    """

    problem: Problem
    settings: Settings
    way: Way
    at: Point
    times: np.ndarray
    works: bool
    floor: np.ndarray
    first_step: float = 0.0
    curves: bool = False
    share: int = 1

    @property
    def span(self) -> float:
        """Length of the leg in s."""
        return float(self.times[-1] - self.times[0])

    def leg(self, x: np.ndarray, z: np.ndarray, energy: np.ndarray, steps: int) -> Leg:
        """Return a leg with values at the output times."""
        constants = self.at.constants
        return Leg(Rows.within(self.times[1:], x, z, constants.vector), energy, constants, steps)


class Integration(ABC):
    """One integration from a point through all output times, prepared.

    Attributes
    ----------
    request : Request
        What it was asked for.
    flat : float or None
        Time in s of the first flat position of loops that it passed where it may have left the motion, if it looks for them.
    """

    request: Request
    flat: float | None = None

    def follows(self) -> bool:
        """Whether it is sure that algebraic equations hold between its steps, and that their solution went on."""
        return False

    def jump(self, consistent: Consistent) -> float | None:
        """Time in s of the first jump of an algebraic unknown where it is not sure; None if it knows of none."""
        return None

    @property
    def taken(self) -> np.ndarray | None:
        """Steps up to the start and each output, with parts of steps; None if it does not count them."""
        return None

    @property
    @abstractmethod
    def counts(self) -> tuple[int, int, int]:
        """Steps, factorisations and evaluations of the equations so far."""

    @abstractmethod
    def go(self) -> Refusal | None:
        """Integrate to the end, or as far as possible."""

    @abstractmethod
    def leg(self) -> Leg:
        """Return the values at all output times: nan at those that were not reached, integrals 0 where none were asked for."""
