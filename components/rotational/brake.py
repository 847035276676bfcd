"""Brake: holds a shaft by friction."""

from __future__ import annotations

from components.rotational.pressed_shaft import PressedShaft
from components.rotational.shaft_friction import ShaftFriction


class Brake(PressedShaft, ShaftFriction):
    """Friction brake of a rigid massless shaft: slips until the shaft stands still, then holds it up to its greatest torque."""
