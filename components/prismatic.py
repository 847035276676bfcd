"""Prismatic joint."""

from __future__ import annotations

from typing import Any

from acausal import PREFER, Scalar, cross, der, dot, geometry, parameter, part, quantity, structural, variable
from components.driven import DrivenByRod
from components.driven_joint import DrivenJoint
from components.frame import move, pose
from components.joint_friction import PrismaticFriction
from components.orientation import null_rotation, resolve1, unit_vector


class Prismatic(DrivenByRod, DrivenJoint):
    """Prismatic joint: frame_b slides relative to frame_a along the axis n."""

    n: Any = structural(
        "axis of translation, the same in frame_a and frame_b", default=(1, 0, 0), shape=(3,), doc="Any nonzero length."
    )
    d: Scalar = parameter("viscous friction", unit="N.s/m", default=0, minimum=0)
    f_dry: Scalar = parameter(
        "dry friction",
        unit="N",
        default=0,
        minimum=0,
        doc='The force d v + f_dry tanh(v / v_dry) opposes v and creeps at rest; with friction="stiction" the joint sticks up to '
        'peak f_dry. With friction="reaction" the dry friction is mu |f|, f normal to n.',
    )
    v_dry: Scalar = parameter("speed of regularisation of dry friction", unit="m/s", default=1e-3, positive=True)
    compliance: Scalar = parameter(
        "compliance of the drive", unit="m/N", default=0, minimum=0, doc="axis.s - s = compliance f; 0 is rigid."
    )
    s: Scalar = variable("distance from frame_a to frame_b along n", unit="m", select=PREFER)
    v: Scalar = variable("der(s)", unit="m/s", select=PREFER)
    a: Scalar = variable("der(v)", unit="m/s2")
    f: Scalar = variable("drive force along n", unit="N")

    @part
    def stiction(self) -> PrismaticFriction | None:
        """Dry friction with stiction."""
        return PrismaticFriction(peak=self.peak) if self.sticks() else None

    def equations(self):
        n = unit_vector(self.n)
        r = n * self.s
        yield self.v == der(self.s)
        yield self.a == der(self.v)
        yield from move(self.frame_a, self.frame_b, r, null_rotation())
        yield self.frame_a.f == -self.frame_b.f
        yield self.frame_a.t == -self.frame_b.t - cross(r, self.frame_b.f)
        yield self.f - self.friction_load(self._drag()) == -dot(n, self.frame_b.f)
        yield from self.stiction_equations(self.v, self.f_dry, quantity(1.0, "1"))
        if self.use_axis_flange:
            yield self.axis.s == self.s + self.drive_deflection(self.f)
            yield self.axis.f == self.f
            yield self.support.s == 0
        else:
            yield self.f == 0

    def shapes(self):
        """A rail, a block on it, and the force of a drive."""
        a, b, n = self.frame_a, self.frame_b, unit_vector(self.n)
        yield geometry.Rail(pose(a), n, b.r_0)
        yield geometry.Axle(pose(b), n, style="block")
        if self.use_axis_flange:
            yield geometry.Arrow(b.r_0, resolve1(a.R, n * self.f))

    def stored_energy(self):
        """Elastic energy of the drive."""
        return self.f * self.drive_deflection(self.f) / 2

    def dissipated_power(self):
        """Power of friction without stiction."""
        return self.v * self._drag()

    def _drag(self) -> Any:
        return self.drag(self.v, self.f_dry, self.v_dry)
