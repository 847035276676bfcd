"""Add3: weighted sum of three inputs."""

from __future__ import annotations

from acausal import Component, Scalar, input, output, parameter


class Add3(Component):
    """Weighted sum of three inputs."""

    u1: Scalar = input("first input")
    u2: Scalar = input("second input")
    u3: Scalar = input("third input")
    k1: Scalar = parameter("gain of the first input", default=1)
    k2: Scalar = parameter("gain of the second input", default=1)
    k3: Scalar = parameter("gain of the third input", default=1)
    y: Scalar = output("output")

    def equations(self):
        yield self.y == self.k1 * self.u1 + self.k2 * self.u2 + self.k3 * self.u3
