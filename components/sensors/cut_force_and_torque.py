"""CutForceAndTorque: measures force and torque between two frames."""

from __future__ import annotations

from acausal import Vector3, output
from components.sensors.cut_sensor import CutSensor


class CutForceAndTorque(CutSensor):
    """Measures force and torque that act on what is connected at frame_b, the cut load of frame_a."""

    force: Vector3 = output("cut force, resolved in resolve_in_frame", unit="N")
    torque: Vector3 = output("cut torque, resolved in resolve_in_frame", unit="N.m")

    def measure(self):
        """Cut force and torque."""
        yield self.force == self.signed(self.frame_a.f)
        yield self.torque == self.signed(self.frame_a.t)
