"""RSFlipFlop: memory that R resets and S sets; R wins."""

from __future__ import annotations

from acausal import Component, Scalar, discrete, input, output, parameter, reinit, when


class RSFlipFlop(Component):
    """Memory that R resets and S sets; R wins."""

    R: Scalar = input("reset, a truth value")
    S: Scalar = input("set, a truth value")
    q_start: Scalar = parameter("output before the start", default=0)
    Q: Scalar = output("1 after S, 0 after R")
    QI: Scalar = output("the negation of Q")
    on: Scalar = discrete("1 after S, 0 after R", start=q_start)

    def equations(self):
        yield when((self.S > 0.5) & (self.R <= 0.5), reinit(self.on, 1), at_start=True)
        yield when(self.R > 0.5, reinit(self.on, 0), at_start=True)
        yield self.on == self.Q
        yield 1 - self.on == self.QI
