"""RelativeAngles: measures the relative orientation of two frames as three angles."""

from __future__ import annotations

from acausal import Vector3, output
from components.frame import TwoFrames
from components.sensors.angles import HasAngles, axes_angles


class RelativeAngles(HasAngles, TwoFrames):
    """Measures the angles from frame_a to frame_b about a sequence of axes."""

    angles: Vector3 = output("angles from frame_a to frame_b, each about the rotated axis", unit="rad")

    def equations(self):
        for frame in (self.frame_a, self.frame_b):
            yield frame.f == (0, 0, 0)
            yield frame.t == (0, 0, 0)
        yield self.angles == axes_angles(self.frame_b.R.T @ self.frame_a.R.T.T, self.sequence, self.guess_angle1)

    def shapes(self):
        """No shape: the sensor has no size."""
        yield from ()
