"""RelativeSensor: measures the complete relative motion of two frames."""

from __future__ import annotations

from acausal import Vector3, der, output
from components.sensors.angles import HasAngles, axes_angles
from components.sensors.relative_angular_velocity import relative_angular_velocity
from components.sensors.relative_position import relative_position
from components.sensors.two_frame_sensor import TwoFrameSensor


class RelativeSensor(HasAngles, TwoFrameSensor):
    """Measures the motion of frame_b relative to frame_a; unread outputs cost nothing.

    Notes
    -----
    v_rel, a_rel and z_rel are the derivatives of r_rel, v_rel and w_rel with respect to resolve_in_frame.
    """

    r_rel: Vector3 = output("relative position of frame_b, resolved in resolve_in_frame", unit="m")
    v_rel: Vector3 = output("der(r_rel)", unit="m/s")
    a_rel: Vector3 = output("der(v_rel)", unit="m/s2")
    angles: Vector3 = output("angles from frame_a to frame_b, each about the rotated axis", unit="rad")
    w_rel: Vector3 = output("relative angular velocity of frame_b, resolved in resolve_in_frame", unit="rad/s")
    z_rel: Vector3 = output("der(w_rel)", unit="rad/s2")

    def measure(self):
        """All levels of the relative motion."""
        a, b, where = self.frame_a, self.frame_b, self.resolving
        yield self.r_rel == relative_position(a, b, where)
        yield self.v_rel == der(self.r_rel)
        yield self.a_rel == der(self.v_rel)
        yield self.angles == axes_angles(b.R.T @ a.R.T.T, self.sequence, self.guess_angle1)
        yield self.w_rel == relative_angular_velocity(a, b, where)
        yield self.z_rel == der(self.w_rel)
