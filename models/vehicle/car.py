"""Car with double wishbones driving over a bump while steering; x forward, y up, z right."""

from __future__ import annotations

from math import pi

from acausal import Model, Scalar, chain, connect, cos, exp, fixed, output, parameter, part, time
from components import Body, FixedTranslation, Prismatic, World
from components.translational import Position
from models.vehicle.axle import Axle
from models.vehicle.points import diagonal


class Car(Model):
    """Car of 1.2 t at 20 m/s over a bump of 50 mm, with the rack moving right and back; initially in equilibrium."""

    stop_time = 1.0
    speed: Scalar = parameter("initial speed", unit="m/s", default=20, positive=True)
    travel: Scalar = parameter("maximum displacement of the rack, at 0.5 s", unit="m", default=2e-3)
    bump: Scalar = parameter("height of the bump", unit="m", default=0.05)
    width: Scalar = parameter("half width of the bump at 1 / e of its height", unit="m", default=0.5)
    world = World()
    chassis = Body(
        m=1000,
        r_CM=(0, 0.5, 0),
        I=diagonal(400, 1500, 1400),
        r_0=fixed((0, 0.0037, 0)),
        v_0=fixed((speed, 0, 0)),
        w_a=fixed((0, 0, 0)),
        angles_fixed=True,
    )
    to_front, to_rear = FixedTranslation(r=(1.3, 0, 0)), FixedTranslation(r=(-1.3, 0, 0))
    front = part(lambda s: Axle(height=s.ground, v=s.speed, preload=3658))
    rear = part(lambda s: Axle(height=s.ground, v=s.speed, preload=3623))
    guide, rack = Prismatic(n=(0, 0, 1), use_axis_flange=True), Body(m=5, r_CM=(-0.12, 0.25, 0))
    steering = Position(s_ref=travel * (1 - cos(2 * pi * time)) / 2)
    y: Scalar = output("height of the chassis relative to the design position", unit="m")
    yaw_rate: Scalar = output("yaw rate, positive to the left", unit="rad/s")

    def ground(self, x, y):
        """Height of the ground: a bump across the road, 5 m ahead."""
        return self.bump * exp(-(((x - 5) / self.width) ** 2))

    def connections(self):
        yield chain(self.chassis.frame_a, self.to_front, self.front.frame_a)
        yield chain(self.chassis.frame_a, self.to_rear, self.rear.frame_a)
        yield chain(self.to_front, self.guide, self.rack)
        yield connect(self.guide.frame_b, self.front.frame_tie)
        yield connect(self.to_rear.frame_b, self.rear.frame_tie)
        yield connect(self.steering.flange, self.guide.axis)

    def equations(self):
        yield self.y == self.chassis.r_0[1]
        yield self.yaw_rate == self.chassis.w_a[1]


if __name__ == "__main__":
    import acausal as ac

    ac.simulate(Car(), stop_time=Car.stop_time, tolerance=1e-4).plot("y", "yaw_rate", path="car.png")
