"""Clutch: friction clutch between two shafts."""

from __future__ import annotations

from components.rotational.pressed_shaft import PressedShaft
from components.rotational.slipping import Slipping


class Clutch(PressedShaft, Slipping):
    """Friction clutch: slips until both shafts have equal speeds, then locks up to the static friction torque."""
