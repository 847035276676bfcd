"""Position: drive with prescribed position."""

from __future__ import annotations

import numpy as np

from acausal import PREFER, Scalar, der, input, parameter, structural, variable
from components.rotational.position import AF, BF
from components.translational.one_flange import OneFlange


class Position(OneFlange):
    """Drive that prescribes the position of the rod."""

    s_ref: Scalar = input("position of the flange", unit="m", doc="The force jumps with its second derivative.")
    exact: bool = structural(
        "whether the flange follows s_ref exactly",
        default=True,
        choices=(True, False),
        doc="False: second-order filter, initially at rest, for a position without known derivatives, such as an input "
        "of the model, or with jumps.",
    )
    f_crit: Scalar = parameter("critical frequency of the filter", unit="Hz", default=50, positive=True)
    s: Scalar = variable("position of the flange relative to the support", unit="m", select=PREFER)
    a: Scalar = variable("der(v)", unit="m/s2")

    def equations(self):
        yield from super().equations()
        yield self.a == der(self.v)
        if self.exact:
            yield self.s == self.s_ref
        else:
            w_crit = 2 * np.pi * self.f_crit
            yield self.a == ((self.s_ref - self.s) * w_crit - AF * self.v) * w_crit / BF

    def initial_equations(self):
        if not self.exact:
            yield self.s == self.s_ref
            yield self.v == 0
