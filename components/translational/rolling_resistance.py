"""RollingResistance: resistance of a rolling wheel."""

from __future__ import annotations

from acausal import Scalar, input, parameter, sqrt, structural
from components.regularized_sign import KINDS, regularized_sign
from components.translational.loading_force import LoadingForce


class RollingResistance(LoadingForce):
    """Resistance of a rolling wheel, proportional to the normal load on the road."""

    f_weight: Scalar = parameter("weight on the wheel", unit="N")
    cr_constant: Scalar = parameter("coefficient of rolling resistance", unit="1", default=0.01)
    inclination_constant: Scalar = parameter(
        "inclination of the road", unit="1", default=0, doc="Tangent of the angle."
    )
    reg: str = structural("regularisation of the sign of the speed", default="exp", choices=KINDS)
    v0: Scalar = parameter("speed below which the sign is regularised", unit="m/s", default=0.1, positive=True)
    cr: Scalar = input(
        "variable coefficient of rolling resistance",
        unit="1",
        default=lambda s: s.cr_constant,
        doc="cr_constant if not given.",
    )
    inclination: Scalar = input(
        "variable inclination of the road",
        unit="1",
        default=lambda s: s.inclination_constant,
        doc="Tangent of the angle; inclination_constant if not given.",
    )

    def law(self):
        """Fraction of the normal load, opposing the motion."""
        normal = self.f_weight / sqrt(1 + self.inclination**2)
        yield self.f == self.cr * normal * regularized_sign(self.v, self.v0, self.reg)

    def supplied_power(self):
        """None: the part only brakes."""
        return 0.0

    def dissipated_power(self):
        """Power of the force."""
        return self.f * self.v
