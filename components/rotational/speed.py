"""Speed: drive with prescribed angular velocity."""

from __future__ import annotations

import numpy as np

from acausal import PREFER, Scalar, der, input, parameter, structural, variable
from components.rotational.one_flange import OneFlange


class Speed(OneFlange):
    """Drive that prescribes the angular velocity of the shaft."""

    w_ref: Scalar = input("angular velocity of the flange", unit="rad/s")
    exact: bool = structural(
        "whether the flange follows w_ref exactly",
        default=True,
        choices=(True, False),
        doc="False: first-order filter, for a speed without known derivative, such as an input of the model, or with "
        "jumps.",
    )
    f_crit: Scalar = parameter("critical frequency of the filter", unit="Hz", default=50, positive=True)
    phi: Scalar = variable("angle of the flange relative to the support", unit="rad", select=PREFER)
    a: Scalar = variable("der(w)", unit="rad/s2")

    def equations(self):
        yield from super().equations()
        yield self.a == der(self.w)
        if self.exact:
            yield self.w == self.w_ref
        else:
            yield self.a == (self.w_ref - self.w) * 2 * np.pi * self.f_crit

    def initial_equations(self):
        if not self.exact:
            yield self.w == self.w_ref
