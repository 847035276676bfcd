"""CutForce: measures the force between two frames."""

from __future__ import annotations

from acausal import Vector3, output
from components.sensors.cut_sensor import CutSensor


class CutForce(CutSensor):
    """Measures the force that acts on what is connected at frame_b, which is the cut force of frame_a."""

    force: Vector3 = output("cut force, resolved in resolve_in_frame", unit="N")

    def measure(self):
        """Cut force."""
        yield self.force == self.signed(self.frame_a.f)
