"""LoadingTorque: base of torques as functions of speed or time."""

from __future__ import annotations

from typing import Any

from acausal import Scalar, variable
from components.rotational.one_flange import OneFlange


class LoadingTorque(OneFlange):
    """Base of torques on a shaft end; a subclass defines tau."""

    tau: Scalar = variable("accelerating torque on the shaft, -flange.tau", unit="N.m")

    def equations(self):
        yield from super().equations()
        yield self.tau == -self.flange.tau
        yield from self.law()

    def law(self) -> Any:
        """Yield the equation of tau."""
        raise NotImplementedError("yields the equation of the torque tau", "yield self.tau == ...")
