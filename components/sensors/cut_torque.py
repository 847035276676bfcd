"""CutTorque: measures the torque between two frames."""

from __future__ import annotations

from acausal import Vector3, output
from components.sensors.cut_sensor import CutSensor


class CutTorque(CutSensor):
    """Measures the torque that acts on what is connected at frame_b, which is the cut torque of frame_a."""

    torque: Vector3 = output("cut torque, resolved in resolve_in_frame", unit="N.m")

    def measure(self):
        """Cut torque."""
        yield self.torque == self.signed(self.frame_a.t)
