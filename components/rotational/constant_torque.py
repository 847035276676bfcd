"""ConstantTorque: constant torque."""

from __future__ import annotations

from acausal import Scalar, parameter
from components.rotational.loading_torque import LoadingTorque


class ConstantTorque(LoadingTorque):
    """Constant torque, independent of the speed."""

    tau_constant: Scalar = parameter(
        "torque on the shaft", unit="N.m", doc="Negative for a load on a shaft turning forwards."
    )

    def law(self):
        """Constant torque."""
        yield self.tau == self.tau_constant
