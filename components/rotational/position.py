"""Position: drive with prescribed angle."""

from __future__ import annotations

import numpy as np

from acausal import PREFER, Scalar, der, input, parameter, structural, variable
from components.rotational.one_flange import OneFlange

# Coefficients of the second-order Bessel filter with -3 dB at its critical frequency.
AF, BF = 1.3617, 0.6180


class Position(OneFlange):
    """Drive that prescribes the angle of the shaft."""

    phi_ref: Scalar = input("angle of the flange", unit="rad", doc="The torque jumps with its second derivative.")
    exact: bool = structural(
        "whether the flange follows phi_ref exactly",
        default=True,
        choices=(True, False),
        doc="False: second-order filter, initially at rest, for an angle without known derivatives, such as an input "
        "of the model, or with jumps.",
    )
    f_crit: Scalar = parameter("critical frequency of the filter", unit="Hz", default=50, positive=True)
    phi: Scalar = variable("angle of the flange relative to the support", unit="rad", select=PREFER)
    a: Scalar = variable("der(w)", unit="rad/s2")

    def equations(self):
        yield from super().equations()
        yield self.a == der(self.w)
        if self.exact:
            yield self.phi == self.phi_ref
        else:
            w_crit = 2 * np.pi * self.f_crit
            yield self.a == ((self.phi_ref - self.phi) * w_crit - AF * self.w) * w_crit / BF

    def initial_equations(self):
        if not self.exact:
            yield self.phi == self.phi_ref
            yield self.w == 0
