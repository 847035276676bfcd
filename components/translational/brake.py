"""Brake: holds a rod by friction."""

from __future__ import annotations

from acausal import Scalar, parameter
from components.pressed_friction import PressedFriction
from components.translational.rod_friction import RodFriction


class Brake(PressedFriction, RodFriction):
    """Friction brake of a rigid massless rod: slips until the rod stands still, then holds it up to its greatest force."""

    speed_unit = "m/s"
    cgeo: Scalar = parameter(
        "force over the friction force of one face", unit="1", default=1, minimum=0, doc="Number of friction faces."
    )
