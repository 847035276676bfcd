"""Integrator: integral of the input: der(y) = k u."""

from __future__ import annotations

from acausal import Scalar, der, input, parameter, reinit, structural, variable, when
from components.blocks.siso import SISO


class Integrator(SISO):
    """Integral of the input: der(y) = k u."""

    k: Scalar = parameter("gain", default=1)
    y_start: Scalar = parameter("initial output", default=0)
    use_reset: bool = structural("whether there is a reset", default=False, choices=(True, False))
    use_set: bool = structural(
        "whether a reset sets the output to `set`, else to y_start", default=False, choices=(True, False)
    )
    reset: Scalar = input("reset, where it becomes true (above 0.5)", default=0)
    set: Scalar = input("output after a reset", default=0)
    x: Scalar = variable("integral")

    def equations(self):
        yield der(self.x) == self.rate()
        yield self.y == self.x
        if self.use_reset:
            yield when(self.reset > 0.5, reinit(self.x, self.set if self.use_set else self.y_start))

    def rate(self):
        """Derivative of the output."""
        return self.k * self.u

    def initial_equations(self):
        yield self.x == self.y_start
