"""IdealThyristor: ideal thyristor."""

from __future__ import annotations

from acausal import Scalar, discrete, input, parameter, piecewise, reinit, when
from components.electrical.ideal_switch import IdealSwitch


class IdealThyristor(IdealSwitch):
    """Ideal thyristor: a diode that conducts only after it was fired."""

    Vknee: Scalar = parameter("forward threshold voltage", unit="V", default=0)
    fire: Scalar = input("truth value: fires while the voltage is positive")
    on: Scalar = discrete("1 while it conducts")

    def equations(self):
        yield from super().equations()
        yield when((self.fire > 0.5) & (self.s > 0), reinit(self.on, 1), at_start=True)
        yield when(self.s < 0, reinit(self.on, 0), at_start=True)

    def law(self, is_open):
        """The lines through the knee (Vknee, Goff Vknee)."""
        yield self.v == piecewise((self.s, is_open), self.Ron * self.s) + self.Vknee
        yield self.i == piecewise((self.Goff * self.s, is_open), self.s) + self.Goff * self.Vknee

    def open(self):
        """Unless it conducts."""
        return self.on < 0.5
