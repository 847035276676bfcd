"""LineForceWithMass: a line force of parts of one-dimensional translation."""

from __future__ import annotations

from typing import Any

from acausal import port
from components.mass_on_line import MassOnLine
from components.translational.flange import TranslationalFlange


class LineForceWithMass(MassOnLine):
    """What is connected between flange_a and flange_b, a spring for instance, acts along the line from frame_a to frame_b.

    Notes
    -----
    flange_a stands at 0, flange_b at the length of the line; connect both.
    """

    flange_a: TranslationalFlange = port(TranslationalFlange, "at frame_a")
    flange_b: TranslationalFlange = port(TranslationalFlange, "at frame_b")

    def law(self):
        """Flanges that move with the ends."""
        yield self.flange_a.s == 0
        yield self.flange_b.s == self.s
        yield self.f == self.flange_a.f

    def pulls(self) -> tuple[Any, Any]:
        """Forces of the flanges."""
        return self.f, -self.flange_b.f
