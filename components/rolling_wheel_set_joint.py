"""RollingWheelSetJoint: two massless wheels on one axle, rolling on the road without slip."""

from __future__ import annotations

from acausal import Component, Scalar, chain, connect, der, parameter, part, port, variable
from components.fixed import Fixed
from components.fixed_translation import FixedTranslation
from components.flange import Flange
from components.frame import Frame
from components.mounting_1d import Mounting1D
from components.planar import Planar
from components.revolute import Revolute
from components.rolling_wheel_joint import RollingWheelJoint


class RollingWheelSetJoint(Component):
    """Two massless, independently rotating wheels on one axle, rolling on the plane z = 0 of the world.

    Notes
    -----
    der(x) sin(phi) = der(y) cos(phi), and der(x) cos(phi) + der(y) sin(phi) = radius der_theta1 + track / 2 der(phi)
    = radius der_theta2 - track / 2 der(phi): five coordinates, two degrees of freedom in velocity. The axle stays level.
    """

    ends = ("frame_middle", "frame_middle")
    radius: Scalar = parameter("radius of each wheel", unit="m", positive=True)
    track: Scalar = parameter("track width", unit="m", positive=True)
    frame_middle: Frame = port(Frame, "middle of the axle, with y along it to wheel 1, z upwards")
    frame1: Frame = port(Frame, "centre of wheel 1, the left one, with y along the axle")
    frame2: Frame = port(Frame, "centre of wheel 2, the right one, with y along the axle")
    axis1: Flange = port(Flange, "drive of wheel 1")
    axis2: Flange = port(Flange, "drive of wheel 2")
    support: Flange = port(Flange, "housing of both drives, held by the axle")
    x: Scalar = variable("x-coordinate of the middle, resolved in the world", unit="m")
    y: Scalar = variable("y-coordinate of the middle, resolved in the world", unit="m")
    phi: Scalar = variable("angle of the axle about z", unit="rad")
    theta1: Scalar = variable("angle of wheel 1 about the axle", unit="rad")
    theta2: Scalar = variable("angle of wheel 2 about the axle", unit="rad")
    der_theta1: Scalar = variable("der(theta1)", unit="rad/s")
    der_theta2: Scalar = variable("der(theta2)", unit="rad/s")
    planar = Planar()
    revolute1, revolute2 = Revolute(n=(0, 1, 0), use_axis_flange=True), Revolute(n=(0, 1, 0), use_axis_flange=True)
    mounting = Mounting1D(n=(0, 1, 0))

    @part
    def fixed(self):
        """Plane in which the axle moves."""
        return Fixed(r=(0, 0, self.radius))

    @part
    def rod1(self):
        """Half of the axle, to wheel 1."""
        return FixedTranslation(r=(0, self.track / 2, 0))

    @part
    def rod2(self):
        """Half of the axle, to wheel 2."""
        return FixedTranslation(r=(0, -self.track / 2, 0))

    @part
    def rolling1(self):
        """Contact of wheel 1, with the lateral constraint of the axle."""
        return RollingWheelJoint(radius=self.radius, carries=False)

    @part
    def rolling2(self):
        """Contact of wheel 2."""
        return RollingWheelJoint(radius=self.radius, carries=False, guides=False)

    def connections(self):
        yield chain(self.fixed, self.planar, self.frame_middle)
        yield chain(self.frame_middle, self.rod1, self.revolute1, self.frame1)
        yield chain(self.frame_middle, self.rod2, self.revolute2, self.frame2)
        yield connect(self.frame1, self.rolling1.frame_a)
        yield connect(self.frame2, self.rolling2.frame_a)
        yield connect(self.axis1, self.revolute1.axis)
        yield connect(self.axis2, self.revolute2.axis)
        yield connect(self.frame_middle, self.mounting.frame_a)
        yield connect(self.mounting.flange_b, self.support)

    def equations(self):
        yield self.x == self.planar.s_x
        yield self.y == self.planar.s_y
        yield self.phi == self.planar.phi
        yield self.theta1 == self.revolute1.phi
        yield self.theta2 == self.revolute2.phi
        yield self.der_theta1 == der(self.theta1)
        yield self.der_theta2 == der(self.theta2)
