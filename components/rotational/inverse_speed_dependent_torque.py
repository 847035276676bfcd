"""InverseSpeedDependentTorque: torque at constant power."""

from __future__ import annotations

from acausal import Scalar, parameter, piecewise, structural
from components.rotational.loading_torque import LoadingTorque


class InverseSpeedDependentTorque(LoadingTorque):
    """Torque at the constant power tau_nominal w_nominal, limited below the speed w0."""

    tau_nominal: Scalar = parameter(
        "torque on the shaft at w_nominal", unit="N.m", doc="Negative for a load on a shaft turning forwards."
    )
    torque_direction: bool = structural(
        "whether the torque has the same sign in both directions of rotation", default=True, choices=(True, False)
    )
    w_nominal: Scalar = parameter("nominal speed", unit="rad/s", positive=True)
    w0: Scalar = parameter("speed below which the torque is limited", unit="rad/s", default=0.1, positive=True)

    def law(self):
        """Power over speed; constant or linear in the speed below w0."""
        power, w, w0 = self.tau_nominal * self.w_nominal, self.w, self.w0
        if self.torque_direction:
            yield self.tau == piecewise((power / w, w > w0), (-power / w, w < -w0), power / w0)
        else:
            yield self.tau == piecewise((power * w / w0**2, (w < w0) & (w > -w0)), power / w)
