"""IdealDiode: ideal diode."""

from __future__ import annotations

from acausal import Scalar, parameter, piecewise
from components.electrical.ideal_switch import IdealSwitch


class IdealDiode(IdealSwitch):
    """Ideal diode: conducts from p to n above its knee voltage."""

    Vknee: Scalar = parameter("forward threshold voltage", unit="V", default=0)

    def law(self, is_open):
        """The lines through the knee (Vknee, Goff Vknee)."""
        yield self.v == piecewise((self.s, is_open), self.Ron * self.s) + self.Vknee
        yield self.i == piecewise((self.Goff * self.s, is_open), self.s) + self.Goff * self.Vknee

    def open(self):
        """Below the knee."""
        return self.s < 0
