"""Clutch: couples two shafts by friction."""

from __future__ import annotations

from components.rotational.pressed_shaft import PressedShaft
from components.rotational.slipping import Slipping


class Clutch(PressedShaft, Slipping):
    """Friction clutch: slips until both shafts turn alike, then locks up to its greatest torque."""
