"""ForceStep: step of a force."""

from __future__ import annotations

from acausal import Scalar, parameter, piecewise, time
from components.translational.loading_force import LoadingForce


class ForceStep(LoadingForce):
    """Force with a step at start_time."""

    step_force: Scalar = parameter("step height", unit="N", doc="Negative for a load on a rod moving forwards.")
    offset_force: Scalar = parameter("force before the step", unit="N", default=0)
    start_time: Scalar = parameter("time of the step", unit="s", default=0)

    def law(self):
        """Offset, and the step from start_time on."""
        yield self.f == piecewise((-self.offset_force, time < self.start_time), -self.offset_force - self.step_force)
