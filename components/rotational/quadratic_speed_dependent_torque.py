"""QuadraticSpeedDependentTorque: torque proportional to the square of the speed."""

from __future__ import annotations

from acausal import Scalar, parameter, structural
from components.rotational.loading_torque import LoadingTorque


class QuadraticSpeedDependentTorque(LoadingTorque):
    """Torque proportional to the square of the speed, such as drag."""

    tau_nominal: Scalar = parameter(
        "torque on the shaft at w_nominal", unit="N.m", doc="Negative for a load on a shaft turning forwards."
    )
    torque_direction: bool = structural(
        "whether the torque has the same sign in both directions of rotation", default=True, choices=(True, False)
    )
    w_nominal: Scalar = parameter("nominal speed", unit="rad/s", positive=True)

    def law(self):
        """Torque proportional to w^2 or to w |w|."""
        ratio = self.w / self.w_nominal
        yield self.tau == self.tau_nominal * (ratio**2 if self.torque_direction else ratio * abs(ratio))
