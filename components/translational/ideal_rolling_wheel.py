"""IdealRollingWheel: wheel rolling without slip."""

from __future__ import annotations

from acausal import Expr, Scalar, parameter
from components.translational.rotational_to_translational import RotationalToTranslational


class IdealRollingWheel(RotationalToTranslational):
    """Massless wheel rolling on a rod or a road without slip."""

    radius: Scalar = parameter("radius", unit="m", positive=True)

    def transmission_ratio(self) -> Expr:
        """Return the transmission ratio."""
        return 1 / self.radius
