"""LoadingTorque: base of torques that follow a law of speed or time."""

from __future__ import annotations

from typing import Any

from acausal import Scalar, variable
from components.rotational.one_flange import OneFlange


class LoadingTorque(OneFlange):
    """Base of torques at a shaft end; a subclass states what tau is."""

    tau: Scalar = variable("accelerating torque on the shaft, -flange.tau", unit="N.m")

    def equations(self):
        yield from super().equations()
        yield self.tau == -self.flange.tau
        yield from self.law()

    def law(self) -> Any:
        """Yield the equation of tau."""
        raise NotImplementedError("states its torque tau", "yield self.tau == ...")
