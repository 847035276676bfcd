"""Fixed: fixed rod end."""

from __future__ import annotations

from acausal import Component, Scalar, parameter, port
from components.translational.flange import TranslationalFlange


class Fixed(Component):
    """Rod end fixed at a constant position."""

    ends = ("flange", "flange")
    s0: Scalar = parameter("position of the flange", unit="m", default=0)
    flange: TranslationalFlange = port(TranslationalFlange, "fixed rod end")

    def equations(self):
        yield self.flange.s == self.s0
