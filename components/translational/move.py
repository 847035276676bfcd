"""Move: a drive that prescribes position, speed and acceleration."""

from __future__ import annotations

from typing import Any

from acausal import Scalar, input, variable
from components.translational.one_flange import OneFlange


class Move(OneFlange):
    """Drive that moves the rod by signals of its position, speed and acceleration.

    Notes
    -----
    Speed and acceleration are used as the signals give them, where Position differentiates its signal.
    """

    u: Any = input(
        "position, speed and acceleration of the flange relative to the support", unit=("m", "m/s", "m/s2"), shape=(3,)
    )
    s_ref: Scalar = variable("position as given", unit="m")
    v_ref: Scalar = variable("speed as given, which stands for der(s_ref)", unit="m/s")
    a_ref: Scalar = variable("acceleration as given, which stands for der(v_ref)", unit="m/s2")

    def declared_derivatives(self):
        yield self.s_ref, self.v_ref
        yield self.v_ref, self.a_ref

    def equations(self):
        yield from super().equations()
        yield self.s == self.s_ref
        yield self.s_ref == self.u[0]
        yield self.v_ref == self.u[1]
        yield self.a_ref == self.u[2]
