"""Thresholds of the symbolic elimination of unknowns."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class Elimination:
    """Explicit solution of an equation for an unknown, which divides by its coefficient."""

    # Coefficient, relative to the largest of an unknown of the same unit in the equation: its inverse amplifies round-off, and
    # errors of states that determine the unknown. Gears of ratio 100 remain explicit. The entry 6e-17 of an axis
    # (cos t, sin t, 0) with t = pi/2 is round-off.
    pivot: float = 1e-2
