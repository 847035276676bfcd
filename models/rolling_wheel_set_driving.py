"""Rolling wheel set: two wheels on one axle, each with a motor, roll without slip and push a body."""

from __future__ import annotations

from math import pi

from acausal import Model, Scalar, chain, fixed, output, sine
from components import Body, FixedTranslation, RollingWheelSet, World
from components.rotational import Torque2


class RollingWheelSetDriving(Model):
    """Sinusoidal motor torques with a phase shift of a quarter period, so that the wheel set turns while driving."""

    stop_time = 3.0
    world = World(n=(0, 0, -1))
    wheels = RollingWheelSet(
        R_wheel=0.1, m_wheel=0.5, I_wheel_axis=0.01, I_wheel_long=0.02, track=0.5, x=fixed(0.1), y=fixed(0.1)
    )
    pole, body = FixedTranslation(r=(0.2, 0, 0)), Body(m=0.01)
    left, right = Torque2(tau=sine(amplitude=2, f=1)), Torque2(tau=sine(amplitude=2, f=1, phase=pi / 2))
    x: Scalar = output("x-coordinate of the middle of the axle", unit="m")
    y: Scalar = output("y-coordinate of the middle of the axle", unit="m")
    phi: Scalar = output("angle of the axle about the vertical", unit="rad")

    def connections(self):
        yield chain(self.wheels.frame_middle, self.pole, self.body)
        yield chain(self.wheels.axis1, self.left, self.wheels.support)
        yield chain(self.wheels.axis2, self.right, self.wheels.support)

    def equations(self):
        yield self.x == self.wheels.x
        yield self.y == self.wheels.y
        yield self.phi == self.wheels.phi


if __name__ == "__main__":
    import acausal as ac

    ac.simulate(RollingWheelSetDriving(), stop_time=RollingWheelSetDriving.stop_time).plot("x", "y", path="wheels.png")
