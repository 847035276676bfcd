"""ConstantForce: constant force."""

from __future__ import annotations

from acausal import Scalar, parameter
from components.translational.loading_force import LoadingForce


class ConstantForce(LoadingForce):
    """Constant force, independent of the speed."""

    f_constant: Scalar = parameter("force on the rod", unit="N", doc="Negative for a load on a rod moving forwards.")

    def law(self):
        """Constant force."""
        yield self.f == -self.f_constant
