"""Position: a drive that prescribes the angle."""

from __future__ import annotations

from acausal import Scalar, input
from components.rotational.one_flange import OneFlange


class Position(OneFlange):
    """Drive that moves the shaft exactly as prescribed.

    Parameters
    ----------
    phi_ref : float or expression of time
        Angle of the flange in rad; where its second derivative jumps, torques do.
    """

    phi_ref: Scalar = input("angle of the flange", unit="rad")

    def equations(self):
        yield from super().equations()
        yield self.flange.phi == self.phi_ref
