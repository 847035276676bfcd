"""CutForce: measures the force between two frames."""

from __future__ import annotations

from acausal import Vector3, output
from components.sensors.cut_sensor import CutSensor


class CutForce(CutSensor):
    """Measures the cut force at frame_a, the force on the parts connected to frame_b."""

    force: Vector3 = output("cut force, resolved in resolve_in_frame", unit="N")

    def measure(self):
        """Cut force."""
        yield self.force == self.signed(self.frame_a.f)
