"""CutTorque: measures the torque between two frames."""

from __future__ import annotations

from acausal import Vector3, output
from components.sensors.cut_sensor import CutSensor


class CutTorque(CutSensor):
    """Measures the cut torque at frame_a, the torque on the parts connected to frame_b."""

    torque: Vector3 = output("cut torque, resolved in resolve_in_frame", unit="N.m")

    def measure(self):
        """Cut torque."""
        yield self.torque == self.signed(self.frame_a.t)
