"""Brake: friction brake of a rod."""

from __future__ import annotations

from acausal import Scalar, parameter
from components.pressed_friction import PressedFriction
from components.translational.rod_friction import RodFriction


class Brake(PressedFriction, RodFriction):
    """Friction brake of a rigid massless rod: slips until standstill, then holds up to the static friction force."""

    speed_unit = "m/s"
    cgeo: Scalar = parameter(
        "friction force over that of one face", unit="1", default=1, minimum=0, doc="Number of friction faces."
    )
