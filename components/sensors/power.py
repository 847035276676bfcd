"""Power: measures the power flow between two frames."""

from __future__ import annotations

from typing import Any

from acausal import Scalar, dot, output
from components.sensors.cut_sensor import CutSensor


def frame_power(frame: Any) -> Any:
    """Power into a component through its frame, in W."""
    return dot(frame.f, frame.v) + dot(frame.t, frame.R.w)


class Power(CutSensor):
    """Measures the power that flows from frame_a to frame_b, with positive_sign=False from frame_b to frame_a."""

    power: Scalar = output("power from frame_a to frame_b", unit="W")

    def measure(self):
        """Power."""
        yield self.power == (frame_power(self.frame_a) if self.positive_sign else -frame_power(self.frame_a))
