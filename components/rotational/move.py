"""Move: a drive that prescribes angle, speed and acceleration."""

from __future__ import annotations

from typing import Any

from acausal import Scalar, input, variable
from components.rotational.one_flange import OneFlange


class Move(OneFlange):
    """Drive that moves the shaft by signals of its angle, speed and acceleration.

    Notes
    -----
    Speed and acceleration are used as the signals give them, where Position differentiates its signal.
    """

    u: Any = input(
        "angle, speed and acceleration of the flange relative to the support",
        unit=("rad", "rad/s", "rad/s2"),
        shape=(3,),
    )
    phi_ref: Scalar = variable("angle as given", unit="rad")
    w_ref: Scalar = variable("speed as given, which stands for der(phi_ref)", unit="rad/s")
    a_ref: Scalar = variable("acceleration as given, which stands for der(w_ref)", unit="rad/s2")

    def declared_derivatives(self):
        yield self.phi_ref, self.w_ref
        yield self.w_ref, self.a_ref

    def equations(self):
        yield from super().equations()
        yield self.phi == self.phi_ref
        yield self.phi_ref == self.u[0]
        yield self.w_ref == self.u[1]
        yield self.a_ref == self.u[2]
