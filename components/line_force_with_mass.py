"""LineForceWithMass: line force defined by one-dimensional translational parts."""

from __future__ import annotations

from typing import Any

from acausal import port
from components.mass_on_line import MassOnLine
from components.translational.flange import TranslationalFlange


class LineForceWithMass(MassOnLine):
    """Force of the parts between flange_a and flange_b, such as a spring, along the line from frame_a to frame_b.

    Notes
    -----
    The position of flange_a is 0, that of flange_b the length of the line; connect both.
    """

    flange_a: TranslationalFlange = port(TranslationalFlange, "at frame_a")
    flange_b: TranslationalFlange = port(TranslationalFlange, "at frame_b")

    def law(self):
        """Flange positions from the line, and the force."""
        yield self.flange_a.s == 0
        yield self.flange_b.s == self.s
        yield self.f == self.flange_a.f

    def pulls(self) -> tuple[Any, Any]:
        """Flange forces."""
        return self.f, -self.flange_b.f
