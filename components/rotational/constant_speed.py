"""ConstantSpeed: drive with constant speed."""

from __future__ import annotations

from acausal import PREFER, Scalar, parameter, variable
from components.rotational.loading_torque import LoadingTorque


class ConstantSpeed(LoadingTorque):
    """Drive with constant speed at any torque."""

    w_fixed: Scalar = parameter("speed of the flange", unit="rad/s")
    phi: Scalar = variable("angle of the flange relative to the support", unit="rad", select=PREFER)

    def law(self):
        """Constant speed."""
        yield self.w == self.w_fixed
