"""RackAndPinion: pinion and rack in one housing."""

from __future__ import annotations

from typing import Any

from acausal import (
    PREFER,
    Component,
    DeclarationError,
    Scalar,
    Vector3,
    chain,
    connect,
    der,
    geometry,
    parameter,
    port,
    structural,
    variable,
)
from components.fixed_translation import FixedTranslation
from components.frame import Frame, pose
from components.orientation import unit_vector
from components.prismatic import Prismatic
from components.revolute import Revolute
from components.translational.ideal_rolling_wheel import IdealRollingWheel
from components.world import require_direction

# Cosine of the angle between pinion axis and rack that counts as 0: rounding of the specified directions.
RIGHT = 1e-6


class RackAndPinion(Component):
    """Massless rack and pinion without backlash: in a housing, frame_a rotates by phi and frame_b slides by radius phi.

    Notes
    -----
    With the default axes, the rack is below the pinion.
    """

    ends = ("frame_a", "frame_b")
    radius: Scalar = parameter("pitch radius of the pinion", unit="m", positive=True)
    n_a: Any = structural(
        "axis of the pinion, resolved in the housing", default=(0, 0, 1), shape=(3,), doc="Any nonzero length."
    )
    n_b: Any = structural(
        "direction of the rack, resolved in the housing", default=(1, 0, 0), shape=(3,), doc="Perpendicular to n_a."
    )
    r_a: Vector3 = parameter("from the housing to the pinion, resolved in the housing", unit="m", default=(0, 0, 0))
    r_b: Vector3 = parameter(
        "from the housing to the rack at phi = 0, resolved in the housing", unit="m", default=(0, 0, 0)
    )
    frame_a: Frame = port(Frame, "pinion")
    frame_b: Frame = port(Frame, "rack")
    bearing: Frame = port(Frame, "housing of both")
    phi: Scalar = variable("angle from the housing to the pinion", unit="rad", select=PREFER)
    w: Scalar = variable("der(phi)", unit="rad/s", select=PREFER)
    a: Scalar = variable("der(w)", unit="rad/s2")
    bar_a, bar_b = FixedTranslation(r=r_a), FixedTranslation(r=r_b)
    revolute, prismatic = Revolute(n=n_a, use_axis_flange=True), Prismatic(n=n_b, use_axis_flange=True)
    mesh = IdealRollingWheel(radius=radius)

    def check(self) -> None:
        """Reject axes of length 0, and a rack that is not perpendicular to the pinion axis."""
        require_direction(self, self.n_a, "n_a")
        require_direction(self, self.n_b, "n_b")
        if abs(unit_vector(self.n_a) @ unit_vector(self.n_b)) > RIGHT:
            raise DeclarationError(
                "`n_b` is not perpendicular to `n_a`; give for instance n_a=(0, 0, 1), n_b=(1, 0, 0)."
            )

    def connections(self):
        yield chain(self.bearing, self.bar_a, self.revolute, self.frame_a)
        yield chain(self.bearing, self.bar_b, self.prismatic, self.frame_b)
        yield connect(self.revolute.axis, self.mesh.flange_r)
        yield connect(self.mesh.flange_t, self.prismatic.axis)

    def equations(self):
        yield self.phi == self.revolute.phi
        yield self.w == der(self.phi)
        yield self.a == der(self.w)

    def shapes(self):
        """The parts, and the pinion."""
        yield from super().shapes()
        yield geometry.Axle(pose(self.frame_a), unit_vector(self.n_a), diameter=2 * self.radius, style="gear")
