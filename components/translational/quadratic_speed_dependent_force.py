"""QuadraticSpeedDependentForce: force proportional to the square of the speed."""

from __future__ import annotations

from acausal import Scalar, parameter, structural
from components.translational.loading_force import LoadingForce


class QuadraticSpeedDependentForce(LoadingForce):
    """Force proportional to the square of the speed, such as drag."""

    f_nominal: Scalar = parameter(
        "force on the rod at v_nominal", unit="N", doc="Negative for a load on a rod moving forwards."
    )
    force_direction: bool = structural(
        "whether the force has the same sign in both directions of motion", default=True, choices=(True, False)
    )
    v_nominal: Scalar = parameter("nominal speed", unit="m/s", positive=True)

    def law(self):
        """Force proportional to v^2 or to v |v|."""
        ratio = self.v / self.v_nominal
        yield self.f == -self.f_nominal * (ratio**2 if self.force_direction else ratio * abs(ratio))
