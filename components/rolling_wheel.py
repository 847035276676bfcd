"""RollingWheel: wheel with mass rolling on the road without slip."""

from __future__ import annotations

from acausal import Component, Scalar, Vector3, connect, parameter, part, port, variable
from components.body import Body
from components.frame import Frame
from components.rolling_wheel_joint import RollingWheelJoint


class RollingWheel(Component):
    """Wheel with mass rolling on the plane z = 0 of the world without slip.

    Notes
    -----
    Five coordinates, with fixed initial x, y and angles, and three degrees of freedom in velocity (nonholonomic), with fixed
    initial rates of the angles. If the joints of a vehicle determine the initial state, give guesses: x=guess(0),
    y=guess(0), angles=guess((0, 0, 0)), der_angles=guess((0, 0, 0)).
    """

    ends = ("frame_a", "frame_a")
    radius: Scalar = parameter("radius of the wheel", unit="m", positive=True)
    m: Scalar = parameter("mass", unit="kg", minimum=0)
    I_axis: Scalar = parameter("moment of inertia about the axis of the wheel", unit="kg.m2", minimum=0)
    I_long: Scalar = parameter("moment of inertia about a diameter of the wheel", unit="kg.m2", minimum=0)
    frame_a: Frame = port(Frame, "centre of the wheel, with y along its axis")
    x: Scalar = variable("x-coordinate of the centre, resolved in the world", unit="m", start=0, fixed=True)
    y: Scalar = variable("y-coordinate of the centre, resolved in the world", unit="m", start=0, fixed=True)
    angles: Vector3 = variable(
        "angles from the world to frame_a about z, y and x, each about the rotated axis; that about x within 90 degrees",
        unit="rad",
        start=(0, 0, 0),
        fixed=True,
    )
    der_angles: Vector3 = variable("der(angles)", unit="rad/s", start=(0, 0, 0), fixed=True)

    @part
    def body(self):
        """Mass and inertia."""
        return Body(m=self.m, I=((self.I_long, 0, 0), (0, self.I_axis, 0), (0, 0, self.I_long)))

    @part
    def rolling_wheel(self):
        """Contact with the road."""
        return RollingWheelJoint(radius=self.radius)

    def connections(self):
        yield connect(self.frame_a, self.body.frame_a)
        yield connect(self.frame_a, self.rolling_wheel.frame_a)

    def equations(self):
        yield self.x == self.rolling_wheel.x
        yield self.y == self.rolling_wheel.y
        yield self.angles == self.rolling_wheel.angles
        yield self.der_angles == self.rolling_wheel.der_angles
