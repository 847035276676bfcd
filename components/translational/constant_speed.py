"""ConstantSpeed: drive with constant speed."""

from __future__ import annotations

from acausal import PREFER, Scalar, parameter, variable
from components.translational.loading_force import LoadingForce


class ConstantSpeed(LoadingForce):
    """Drive with constant speed at any force."""

    v_fixed: Scalar = parameter("speed of the flange", unit="m/s")
    s: Scalar = variable("position of the flange relative to the support", unit="m", select=PREFER)

    def law(self):
        """Constant speed."""
        yield self.v == self.v_fixed
