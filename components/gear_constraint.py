"""GearConstraint: gear between two bodies in one bearing."""

from __future__ import annotations

from typing import Any

from acausal import (
    PREFER,
    Component,
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
from components.revolute import Revolute
from components.rotational.ideal_gear import IdealGear


class GearConstraint(Component):
    """Massless gear: frame_a and frame_b rotate in a bearing, the angle of frame_a is `ratio` times that of frame_b."""

    ends = ("frame_a", "frame_b")
    ratio: Scalar = parameter("transmission ratio, angle of frame_a over that of frame_b", unit="1")
    n_a: Any = structural(
        "axis of frame_a, resolved in frame_a", default=(1, 0, 0), shape=(3,), doc="Any nonzero length."
    )
    n_b: Any = structural(
        "axis of frame_b, resolved in frame_b", default=(1, 0, 0), shape=(3,), doc="Any nonzero length."
    )
    r_a: Vector3 = parameter("from the bearing to frame_a, resolved in the bearing", unit="m", default=(0, 0, 0))
    r_b: Vector3 = parameter("from the bearing to frame_b, resolved in the bearing", unit="m", default=(0, 0, 0))
    frame_a: Frame = port(Frame, "first rotating body")
    frame_b: Frame = port(Frame, "second rotating body")
    bearing: Frame = port(Frame, "housing of both")
    phi_b: Scalar = variable("angle from the bearing to frame_b", unit="rad", select=PREFER)
    w_b: Scalar = variable("der(phi_b)", unit="rad/s", select=PREFER)
    a_b: Scalar = variable("der(w_b)", unit="rad/s2")
    bar_a, bar_b = FixedTranslation(r=r_a), FixedTranslation(r=r_b)
    actuated_revolute_a, actuated_revolute_b = (
        Revolute(n=n_a, use_axis_flange=True),
        Revolute(n=n_b, use_axis_flange=True),
    )
    ideal_gear = IdealGear(ratio=ratio)

    def connections(self):
        yield chain(self.bearing, self.bar_a, self.actuated_revolute_a, self.frame_a)
        yield chain(self.bearing, self.bar_b, self.actuated_revolute_b, self.frame_b)
        yield connect(self.actuated_revolute_a.axis, self.ideal_gear.flange_a)
        yield connect(self.ideal_gear.flange_b, self.actuated_revolute_b.axis)

    def equations(self):
        yield self.phi_b == self.actuated_revolute_b.phi
        yield self.w_b == der(self.phi_b)
        yield self.a_b == der(self.w_b)

    def shapes(self):
        """The parts, and two gears."""
        yield from super().shapes()
        for frame, n in ((self.frame_a, self.n_a), (self.frame_b, self.n_b)):
            yield geometry.Axle(pose(frame), unit_vector(n), style="gear")
