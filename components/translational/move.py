"""Move: drive with prescribed position, speed and acceleration."""

from __future__ import annotations

from typing import Any

from acausal import input
from components.prescribed_motion import PrescribedMotion
from components.translational.one_flange import OneFlange


class Move(PrescribedMotion, OneFlange):
    """Drive that prescribes position, speed and acceleration of the rod by signals, without differentiating any."""

    u: Any = input("position, speed and acceleration relative to the support", unit=("m", "m/s", "m/s2"), shape=(3,))

    def equations(self):
        yield from super().equations()
        yield self.s == self.motion[0]
        yield self.motion == self.u
