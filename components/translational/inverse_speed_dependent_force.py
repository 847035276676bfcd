"""InverseSpeedDependentForce: force at constant power."""

from __future__ import annotations

from acausal import Scalar, parameter, piecewise, structural
from components.translational.loading_force import LoadingForce


class InverseSpeedDependentForce(LoadingForce):
    """Force at the constant power f_nominal v_nominal, limited below the speed v0."""

    f_nominal: Scalar = parameter(
        "force on the rod at v_nominal", unit="N", doc="Negative for a load on a rod moving forwards."
    )
    force_direction: bool = structural(
        "whether the force has the same sign in both directions of motion", default=True, choices=(True, False)
    )
    v_nominal: Scalar = parameter("nominal speed", unit="m/s", positive=True)
    v0: Scalar = parameter("speed below which the force is limited", unit="m/s", default=0.1, positive=True)

    def law(self):
        """Power over speed; constant or linear in the speed below v0."""
        power, v, v0 = self.f_nominal * self.v_nominal, self.v, self.v0
        if self.force_direction:
            yield self.f == piecewise((-power / v, v > v0), (power / v, v < -v0), -power / v0)
        else:
            yield self.f == piecewise((-power * v / v0**2, (v < v0) & (v > -v0)), -power / v)
