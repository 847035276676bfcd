"""IdealRollingWheel: a wheel that rolls without slip."""

from __future__ import annotations

from acausal import Expr, Scalar, parameter
from components.translational.rotational_to_translational import RotationalToTranslational


class IdealRollingWheel(RotationalToTranslational):
    """Wheel without inertia that rolls on a rod or a road without slip."""

    radius: Scalar = parameter("radius", unit="m", positive=True)

    def turns(self) -> Expr:
        """Angle over way."""
        return 1 / self.radius
