"""Switch: first input while the second one is true (above 0.5), else the third one."""

from __future__ import annotations

from acausal import Component, Scalar, input, output, piecewise


class Switch(Component):
    """First input while the second one is true (above 0.5), else the third one."""

    u1: Scalar = input("output while u2 is true")
    u2: Scalar = input("truth value, 0 or 1")
    u3: Scalar = input("output while u2 is false")
    y: Scalar = output("output")

    def equations(self):
        yield self.y == piecewise((self.u1, self.u2 > 0.5), self.u3)
