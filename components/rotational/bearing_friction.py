"""BearingFriction: Coulomb friction with stiction of a shaft in its bearing."""

from __future__ import annotations

from components.rotational.shaft_friction import ShaftFriction
from components.rotational.sliding_torque import SlidingTorque


class BearingFriction(SlidingTorque, ShaftFriction):
    """Coulomb friction with stiction of a rigid massless shaft in its bearing."""
