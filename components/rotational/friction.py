"""Friction: Coulomb friction with stiction between two shaft ends."""

from __future__ import annotations

from components.rotational.sliding_torque import SlidingTorque
from components.rotational.slipping import Slipping


class Friction(SlidingTorque, Slipping):
    """Coulomb friction with stiction between two shaft ends."""
