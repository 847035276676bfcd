"""Revolute joint."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

from acausal import PREFER, Scalar, der, dot, geometry, parameter, part, structural, variable
from components.driven import DrivenByShaft
from components.driven_joint import DrivenJoint
from components.frame import move, pose
from components.joint_friction import RevoluteFriction
from components.orientation import planar_rotation, resolve1, unit_vector


class Revolute(DrivenByShaft, DrivenJoint):
    """Revolute joint: frame_b rotates relative to frame_a about the axis n."""

    n: Any = structural(
        "axis of rotation, the same in frame_a and frame_b", default=(0, 0, 1), shape=(3,), doc="Any nonzero length."
    )
    d: Scalar = parameter("viscous friction", unit="N.m.s/rad", default=0, minimum=0)
    tau_dry: Scalar = parameter(
        "dry friction",
        unit="N.m",
        default=0,
        minimum=0,
        doc='The torque d w + tau_dry tanh(w / w_dry) opposes w and creeps at rest; with friction="stiction" the joint sticks '
        "up to peak tau_dry.",
    )
    w_dry: Scalar = parameter("speed of regularisation of dry friction", unit="rad/s", default=1e-2, positive=True)
    r_pin: Scalar = parameter(
        "radius of the pin",
        unit="m",
        default=0,
        minimum=0,
        doc='With friction="reaction": torque mu r_pin |f|, f normal to n.',
    )
    compliance: Scalar = parameter(
        "compliance of the drive",
        unit="rad/(N.m)",
        default=0,
        minimum=0,
        doc="axis.phi - phi = compliance tau; 0 is rigid.",
    )
    phi: Scalar = variable("angle from frame_a to frame_b", unit="rad", select=PREFER)
    w: Scalar = variable("der(phi)", unit="rad/s", select=PREFER)
    a: Scalar = variable("der(w)", unit="rad/s2")
    tau: Scalar = variable("drive torque about n", unit="N.m")

    @part
    def stiction(self) -> RevoluteFriction | None:
        """Dry friction with stiction."""
        return RevoluteFriction(peak=self.peak) if self.sticks() else None

    def equations(self):
        n = unit_vector(self.n)
        R = planar_rotation(n, self.phi)
        yield self.w == der(self.phi)
        yield self.a == der(self.w)
        yield from move(self.frame_a, self.frame_b, (0, 0, 0), R)
        yield self.frame_a.f == -resolve1(R, self.frame_b.f)
        yield self.frame_a.t == -resolve1(R, self.frame_b.t)
        yield self.tau - self.friction_load(self._drag()) == -dot(n, self.frame_b.t)
        yield from self.stiction_equations(self.w, self.tau_dry, self.r_pin)
        yield from self.drive()

    def drive(self) -> Iterator[Any]:
        """Yield the equations of the drive, or tau = 0 without a drive."""
        if self.use_axis_flange:
            yield self.axis.phi == self.phi + self.drive_deflection(self.tau)
            yield self.axis.tau == self.tau
            yield self.support.phi == 0
        else:
            yield self.tau == 0

    def shapes(self):
        """A pin, and the torque of a drive."""
        yield geometry.Axle(pose(self.frame_a), unit_vector(self.n))
        yield from self.drive_arrow()

    def drive_arrow(self) -> Iterator[geometry.Arrow]:
        """Yield the torque of a drive."""
        if self.use_axis_flange:
            a = self.frame_a
            yield geometry.Arrow(a.r_0, resolve1(a.R, unit_vector(self.n) * self.tau), "torque")

    def stored_energy(self):
        """Elastic energy of the drive."""
        return self.tau * self.drive_deflection(self.tau) / 2

    def dissipated_power(self):
        """Power of friction without stiction."""
        return self.w * self._drag()

    def _drag(self) -> Any:
        return self.drag(self.w, self.tau_dry, self.w_dry)
