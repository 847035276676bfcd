"""CutForceAndTorque: measures force and torque between two frames."""

from __future__ import annotations

from acausal import Vector3, output
from components.sensors.cut_sensor import CutSensor


class CutForceAndTorque(CutSensor):
    """Measures cut force and torque at frame_a, the load on the parts connected to frame_b."""

    force: Vector3 = output("cut force, resolved in resolve_in_frame", unit="N")
    torque: Vector3 = output("cut torque, resolved in resolve_in_frame", unit="N.m")

    def measure(self):
        """Cut force and torque."""
        yield self.force == self.signed(self.frame_a.f)
        yield self.torque == self.signed(self.frame_a.t)
