"""RollingWheelSet: two wheels with mass on one axle, rolling on the road without slip."""

from __future__ import annotations

from acausal import Component, Scalar, connect, parameter, part, port, variable
from components.body import Body
from components.flange import Flange
from components.frame import Frame
from components.rolling_wheel_set_joint import RollingWheelSetJoint


class RollingWheelSet(Component):
    """Two independently rotating wheels on one axle, rolling on the plane z = 0 of the world without slip.

    Notes
    -----
    Five coordinates, two degrees of freedom in velocity. Variables with start values are fixed initially, by default at 0.
    """

    ends = ("frame_middle", "frame_middle")
    R_wheel: Scalar = parameter("radius of each wheel", unit="m", positive=True)
    m_wheel: Scalar = parameter("mass of each wheel", unit="kg", minimum=0)
    I_wheel_axis: Scalar = parameter("moment of inertia of each wheel about the axle", unit="kg.m2", minimum=0)
    I_wheel_long: Scalar = parameter("moment of inertia of each wheel about a diameter", unit="kg.m2", minimum=0)
    track: Scalar = parameter("track width", unit="m", positive=True)
    frame_middle: Frame = port(Frame, "middle of the axle, with y along it to wheel 1, z upwards")
    frame1: Frame = port(Frame, "centre of wheel 1, the left one, with y along the axle")
    frame2: Frame = port(Frame, "centre of wheel 2, the right one, with y along the axle")
    axis1: Flange = port(Flange, "drive of wheel 1")
    axis2: Flange = port(Flange, "drive of wheel 2")
    support: Flange = port(Flange, "housing of both drives, held by the axle")
    x: Scalar = variable("x-coordinate of the middle, resolved in the world", unit="m", start=0, fixed=True)
    y: Scalar = variable("y-coordinate of the middle, resolved in the world", unit="m", start=0, fixed=True)
    phi: Scalar = variable("angle of the axle about z", unit="rad", start=0, fixed=True)
    theta1: Scalar = variable("angle of wheel 1 about the axle", unit="rad", start=0, fixed=True)
    theta2: Scalar = variable("angle of wheel 2 about the axle", unit="rad", start=0, fixed=True)
    der_theta1: Scalar = variable("der(theta1)", unit="rad/s", start=0, fixed=True)
    der_theta2: Scalar = variable("der(theta2)", unit="rad/s", start=0, fixed=True)

    @part
    def body1(self):
        """Mass and inertia of wheel 1."""
        return self._wheel()

    @part
    def body2(self):
        """Mass and inertia of wheel 2."""
        return self._wheel()

    @part
    def wheel_set_joint(self):
        """The axle, and the contact of its wheels with the road."""
        return RollingWheelSetJoint(radius=self.R_wheel, track=self.track)

    def connections(self):
        joint = self.wheel_set_joint
        yield connect(self.frame_middle, joint.frame_middle)
        yield connect(self.frame1, joint.frame1)
        yield connect(self.frame1, self.body1.frame_a)
        yield connect(self.frame2, joint.frame2)
        yield connect(self.frame2, self.body2.frame_a)
        yield connect(self.axis1, joint.axis1)
        yield connect(self.axis2, joint.axis2)
        yield connect(self.support, joint.support)

    def equations(self):
        for name in ("x", "y", "phi", "theta1", "theta2", "der_theta1", "der_theta2"):
            yield getattr(self, name) == getattr(self.wheel_set_joint, name)

    def _wheel(self) -> Body:
        return Body(m=self.m_wheel, I=((self.I_wheel_long, 0, 0), (0, self.I_wheel_axis, 0), (0, 0, self.I_wheel_long)))
