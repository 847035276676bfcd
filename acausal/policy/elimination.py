"""Thresholds of the symbolic elimination of unknowns."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class Elimination:
    """An equation that is solved for an unknown is divided by its coefficient."""

    # Coefficient, over the largest in the equation of an unknown of the same unit: its inverse amplifies rounding, and errors of
    # states where the unknown follows from these. Gears of ratio 100 are solved as they are written. The entry 6e-17 of an axis
    # (cos t, sin t, 0) with t = pi/2 is rounding itself.
    pivot: float = 1e-2
