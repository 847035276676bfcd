"""IdealGearR2T: gear from rotation to translation."""

from __future__ import annotations

from acausal import Expr, Scalar, parameter
from components.translational.rotational_to_translational import RotationalToTranslational


class IdealGearR2T(RotationalToTranslational):
    """Gear from rotation to translation without inertia or losses, such as a rack and pinion or a spindle."""

    ratio: Scalar = parameter("transmission ratio, phi / s", unit="rad/m")

    def transmission_ratio(self) -> Expr:
        """Return the transmission ratio."""
        return self.ratio
