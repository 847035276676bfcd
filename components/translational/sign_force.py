"""SignForce: constant force with the sign of the speed."""

from __future__ import annotations

from acausal import Scalar, parameter, structural
from components.regularized_sign import KINDS, regularized_sign
from components.translational.loading_force import LoadingForce


class SignForce(LoadingForce):
    """Constant force with the sign of the speed, regularised at 0."""

    f_nominal: Scalar = parameter("force on the rod", unit="N", doc="Negative for a load in both directions of motion.")
    reg: str = structural("regularisation of the sign", default="exp", choices=KINDS)
    v0: Scalar = parameter("speed below which the sign is regularised", unit="m/s", default=0.1, positive=True)

    def law(self):
        """Regularised sign of the speed."""
        yield self.f == -self.f_nominal * regularized_sign(self.v, self.v0, self.reg)
