"""TorqueStep: step of a torque."""

from __future__ import annotations

from acausal import Scalar, parameter, piecewise, time
from components.rotational.loading_torque import LoadingTorque


class TorqueStep(LoadingTorque):
    """Torque with a step at start_time."""

    step_torque: Scalar = parameter("step height", unit="N.m", doc="Negative for a load on a shaft turning forwards.")
    offset_torque: Scalar = parameter("torque before the step", unit="N.m", default=0)
    start_time: Scalar = parameter("time of the step", unit="s", default=0)

    def law(self):
        """Offset, and the step from start_time on."""
        yield self.tau == piecewise((self.offset_torque, time < self.start_time), self.offset_torque + self.step_torque)
