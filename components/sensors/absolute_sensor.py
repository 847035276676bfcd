"""AbsoluteSensor: measures the complete motion of a frame."""

from __future__ import annotations

from acausal import Vector3, output
from components.orientation import resolve1
from components.sensors.absolute_angular_velocity import absolute_angular_velocity
from components.sensors.absolute_position import absolute_position
from components.sensors.absolute_velocity import absolute_velocity
from components.sensors.angles import HasAngles, axes_angles
from components.sensors.one_frame_sensor import OneFrameSensor, resolved


class AbsoluteSensor(HasAngles, OneFrameSensor):
    """Measures position, velocity, acceleration and orientation of frame_a; unread outputs cost nothing."""

    r: Vector3 = output("position of frame_a, resolved in resolve_in_frame", unit="m")
    v: Vector3 = output("velocity of frame_a, resolved in resolve_in_frame", unit="m/s")
    a: Vector3 = output("acceleration of frame_a, resolved in resolve_in_frame", unit="m/s2")
    angles: Vector3 = output("angles from the world to frame_a, each about the rotated axis", unit="rad")
    w: Vector3 = output("angular velocity of frame_a, resolved in resolve_in_frame", unit="rad/s")
    z: Vector3 = output("angular acceleration of frame_a, resolved in resolve_in_frame", unit="rad/s2")

    def measure(self):
        """All levels of the motion."""
        frame, where = self.frame_a, self.resolving
        yield self.r == absolute_position(frame, where)
        yield self.v == absolute_velocity(frame, where)
        yield self.a == resolved(resolve1(frame.R, frame.a), where)
        yield self.angles == axes_angles(frame.R.T, self.sequence, self.guess_angle1)
        yield self.w == absolute_angular_velocity(frame, where)
        yield self.z == resolved(resolve1(frame.R, frame.z), where)
