"""Gas in a cylinder of an engine, as in Modelica.Mechanics.MultiBody.Examples.Loops."""

from __future__ import annotations

from math import pi

from acausal import Scalar, parameter, piecewise, variable
from components.translational import Compliant


def polynomial(x, *coefficients):
    """Value by Horner's rule, the coefficient of the highest power first."""
    value = 0
    for c in coefficients:
        value = value * x + c
    return value


class GasForce(Compliant):
    """Gas in a cylinder of an engine: the pressure follows one curve at compression and another one at expansion."""

    L: Scalar = parameter("length of the cylinder", unit="m")
    d: Scalar = parameter("diameter", unit="m")
    k0: Scalar = parameter("volume at the top", unit="m3", default=0.01)
    k1: Scalar = parameter("swept volume", unit="m3", default=1)
    k: Scalar = parameter("pressure times volume over temperature", unit="J/K", default=1)
    press: Scalar = variable("pressure", unit="Pa")
    V: Scalar = variable("volume", unit="m3")
    T: Scalar = variable("temperature", unit="K")

    def law(self):
        x = 1 - self.s_rel / self.L
        compression = piecewise(
            (polynomial(x, 177.4132, -287.2189, 151.8252, -24.9973, 2.4), x < 0.986061),
            polynomial(x, 2836360, -10569296, 14761814, -9158505, 2129670),
        )
        expansion = piecewise(
            (polynomial(x, -3929704, 14748765, -20747000, 12964477, -3036495), x > 0.933),
            polynomial(x, 145.930, -131.707, 17.3438, 17.9272, 2.4),
        )
        yield self.press == 1e5 * piecewise((compression, self.v_rel < 0), expansion)
        yield self.f == -self.press * pi * self.d**2 / 4
        yield self.V - self.k0 == self.k1 * (1 - x)
        yield self.press * self.V == self.k * self.T
