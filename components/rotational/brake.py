"""Brake: friction brake of a shaft."""

from __future__ import annotations

from components.rotational.pressed_shaft import PressedShaft
from components.rotational.shaft_friction import ShaftFriction


class Brake(PressedShaft, ShaftFriction):
    """Friction brake of a rigid massless shaft: slips until standstill, then holds up to the static friction torque."""
