"""SignTorque: constant torque with the sign of the speed."""

from __future__ import annotations

from acausal import Scalar, parameter, structural
from components.regularized_sign import KINDS, regularized_sign
from components.rotational.loading_torque import LoadingTorque


class SignTorque(LoadingTorque):
    """Constant torque with the sign of the speed, regularised at 0."""

    tau_nominal: Scalar = parameter(
        "torque on the shaft", unit="N.m", doc="Negative for a load in both directions of rotation."
    )
    reg: str = structural("regularisation of the sign", default="exp", choices=KINDS)
    w0: Scalar = parameter("speed below which the sign is regularised", unit="rad/s", default=0.1, positive=True)

    def law(self):
        """Regularised sign of the speed."""
        yield self.tau == self.tau_nominal * regularized_sign(self.w, self.w0, self.reg)
