"""AbsoluteAngles: measures the orientation of a frame as three angles."""

from __future__ import annotations

from acausal import Vector3, output, port
from components.frame import Frame
from components.sensors.angles import HasAngles, axes_angles


class AbsoluteAngles(HasAngles):
    """Measures the angles from the world to frame_a about a sequence of axes."""

    ends = ("frame_a", "frame_a")
    frame_a: Frame = port(Frame, "measured frame")
    angles: Vector3 = output("angles from the world to frame_a, each about the rotated axis", unit="rad")

    def equations(self):
        yield self.frame_a.f == (0, 0, 0)
        yield self.frame_a.t == (0, 0, 0)
        yield self.angles == axes_angles(self.frame_a.R.T, self.sequence, self.guess_angle1)

    def shapes(self):
        """No shape: the sensor has no size."""
        yield from ()
