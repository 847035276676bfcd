"""Move: drive with prescribed angle, speed and acceleration."""

from __future__ import annotations

from typing import Any

from acausal import input
from components.prescribed_motion import PrescribedMotion
from components.rotational.one_flange import OneFlange


class Move(PrescribedMotion, OneFlange):
    """Drive that prescribes angle, speed and acceleration of the shaft by signals, without differentiating any of them."""

    motion_units = ("rad", "rad/s", "rad/s2")
    u: Any = input("angle, speed and acceleration relative to the support", unit=("rad", "rad/s", "rad/s2"), shape=(3,))

    def equations(self):
        yield from super().equations()
        yield self.phi == self.motion[0]
        yield self.motion == self.u
