"""Speed: a drive that prescribes the angular velocity."""

from __future__ import annotations

from acausal import PREFER, Scalar, input, variable
from components.rotational.one_flange import OneFlange


class Speed(OneFlange):
    """Drive that turns the shaft exactly at the prescribed speed.

    Parameters
    ----------
    w_ref : float or expression of time
        Angular velocity of the flange in rad/s.
    """

    w_ref: Scalar = input("angular velocity of the flange", unit="rad/s")
    phi: Scalar = variable("angle of the flange", unit="rad", select=PREFER)

    def equations(self):
        yield from super().equations()
        yield self.phi == self.flange.phi
        yield self.w == self.w_ref
