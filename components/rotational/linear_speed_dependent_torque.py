"""LinearSpeedDependentTorque: torque proportional to the speed."""

from __future__ import annotations

from acausal import Scalar, parameter, structural
from components.rotational.loading_torque import LoadingTorque


class LinearSpeedDependentTorque(LoadingTorque):
    """Torque proportional to the speed."""

    tau_nominal: Scalar = parameter(
        "torque on the shaft at w_nominal", unit="N.m", doc="Negative for a load on a shaft turning forwards."
    )
    torque_direction: bool = structural(
        "whether the torque has the same sign in both directions of rotation", default=True, choices=(True, False)
    )
    w_nominal: Scalar = parameter("nominal speed", unit="rad/s", positive=True)

    def law(self):
        """Torque proportional to the speed or to its magnitude."""
        ratio = self.w / self.w_nominal
        yield self.tau == self.tau_nominal * (abs(ratio) if self.torque_direction else ratio)
