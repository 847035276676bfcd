"""Speed: drive with prescribed speed."""

from __future__ import annotations

import numpy as np

from acausal import PREFER, Scalar, der, input, parameter, structural, variable
from components.translational.one_flange import OneFlange


class Speed(OneFlange):
    """Drive that prescribes the speed of the rod."""

    v_ref: Scalar = input("speed of the flange", unit="m/s")
    exact: bool = structural(
        "whether the flange follows v_ref exactly",
        default=True,
        choices=(True, False),
        doc="False: first-order filter, for a speed without known derivative, such as an input of the model, or with "
        "jumps.",
    )
    f_crit: Scalar = parameter("critical frequency of the filter", unit="Hz", default=50, positive=True)
    s: Scalar = variable("position of the flange relative to the support", unit="m", select=PREFER)
    a: Scalar = variable("der(v)", unit="m/s2")

    def equations(self):
        yield from super().equations()
        yield self.a == der(self.v)
        if self.exact:
            yield self.v == self.v_ref
        else:
            yield self.a == (self.v_ref - self.v) * 2 * np.pi * self.f_crit

    def initial_equations(self):
        if not self.exact:
            yield self.v == self.v_ref
