"""Scenes: each a file that can be copied and changed."""

from acausal import Model
from models.free_vibration import FreeVibration
from models.pendulum import FlexiblePendulum
from models.simple_pendulum import SimplePendulum
from models.spin_up import SpinUp

SCENES: dict[str, type[Model]] = {
    "free-vibration": FreeVibration,
    "pendulum": FlexiblePendulum,
    "spin-up": SpinUp,
    "simple-pendulum": SimplePendulum,
}

__all__ = ["SCENES", "FlexiblePendulum", "FreeVibration", "SimplePendulum", "SpinUp"]
