"""Skates and rolling discs, and machines on several of them: constraints of velocities that follow from one another."""

from __future__ import annotations

from acausal import (
    Component,
    Model,
    Scalar,
    Vector3,
    as_expr,
    atan2,
    chain,
    connect,
    cross,
    fixed,
    guess,
    parameter,
    piecewise,
    port,
    sqrt,
    structural,
    time,
    variable,
)
from components import Body, FixedTranslation, Frame, Prismatic, Revolute, World
from components.orientation import resolve1, resolve2
from components.rotational import Position

INERTIA = ((0.1, 0, 0), (0, 0.1, 0), (0, 0, 0.1))


class Skate(Component):
    """Moves along its x axis only."""

    ends = ("frame_b", "frame_b")
    frame_b: Frame = port(Frame, "where it stands")
    f: Scalar = variable("side force", unit="N")

    def equations(self):
        yield self.frame_b.v[1] == 0
        yield self.frame_b.f == (0, -self.f, 0)
        yield self.frame_b.t == (0, 0, 0)


class Sleigh(Model):
    """A body on one skate under its mass centre; it turns at a constant rate."""

    world = World(g=0)
    x, y = Prismatic(s=fixed(0), v=fixed(1)), Prismatic(n=(0, 1, 0), s=fixed(0), v=guess(0))
    turn, body = Revolute(phi=fixed(0), w=fixed(2)), Body(m=1, I=INERTIA)
    left, right, skate = FixedTranslation(r=(0, 0.1, 0)), FixedTranslation(r=(0, -0.1, 0)), Skate()

    def connections(self):
        yield chain(self.world, self.x, self.y, self.turn, self.body)
        yield chain(self.turn, self.left, self.skate)
        yield connect(self.turn.frame_b, self.right.frame_a)


class TwoSkates(Sleigh):
    other = Skate()

    def connections(self):
        yield from super().connections()
        yield chain(self.right, self.other)


class ThreeSkates(TwoSkates):
    middle = Skate()

    def connections(self):
        yield from super().connections()
        yield chain(self.turn, self.middle)


class Steered(Sleigh):
    """The second skate is steered from 0.5 s on, which the first one does not allow while the body moves."""

    steer, drive = (
        Revolute(use_axis_flange=True),
        Position(phi_ref=piecewise((0.5 * (time - 0.5) ** 3, time > 0.5), 0.0)),
    )
    other = Skate()

    def connections(self):
        yield from super().connections()
        yield chain(self.right, self.steer, self.other)
        yield connect(self.drive.flange, self.steer.axis)


class Car(Model):
    """Two skates on a fixed axle and two steered ones, turned by Ackermann's law or by one angle."""

    ackermann: bool = structural("whether all axles meet in one point", default=True)
    curvature: Scalar = variable("curvature of the path of the fixed axle", unit="1/m")
    world = World(g=0)
    x, y = Prismatic(s=fixed(0), v=fixed(1)), Prismatic(n=(0, 1, 0), s=fixed(0), v=guess(0))
    turn, body = Revolute(phi=fixed(0), w=guess(0)), Body(m=1, I=INERTIA)
    back_left, back_right = FixedTranslation(r=(0, 0.3, 0)), FixedTranslation(r=(0, -0.3, 0))
    front_left, front_right = FixedTranslation(r=(1, 0.3, 0)), FixedTranslation(r=(1, -0.3, 0))
    steer_left, steer_right = Revolute(use_axis_flange=True), Revolute(use_axis_flange=True)
    drive_left, drive_right = Position(), Position()
    one, two, three, four = Skate(), Skate(), Skate(), Skate()

    def connections(self):
        yield chain(self.world, self.x, self.y, self.turn, self.body)
        yield chain(self.turn, self.back_left, self.one)
        yield chain(self.turn, self.back_right, self.two)
        yield chain(self.turn, self.front_left, self.steer_left, self.three)
        yield chain(self.turn, self.front_right, self.steer_right, self.four)
        yield connect(self.drive_left.flange, self.steer_left.axis)
        yield connect(self.drive_right.flange, self.steer_right.axis)

    def equations(self):
        k, half = self.curvature, 0.3 if self.ackermann else 0.0
        yield k == 0.8 * time**3
        yield self.drive_left.phi_ref == atan2(k, 1 - half * k)
        yield self.drive_right.phi_ref == atan2(k, 1 + half * k)


class Disc(Component):
    """Rolls on the plane y = 0 without slipping, about its z axis; the force on it is resolved in the world."""

    ends = ("frame_a", "frame_a")
    frame_a: Frame = port(Frame, "its centre")
    radius: Scalar = parameter("radius", unit="m", default=0.3)
    force: Vector3 = variable("force of the ground on it, resolved in the world", unit="N")

    def arm(self):
        """From the centre to the ground, resolved in the disc."""
        n = resolve1(self.frame_a.R, (0, 0, 1))
        steepest = as_expr((0, -1, 0)) + n * n[1]
        length = sqrt(steepest[0] ** 2 + steepest[1] ** 2 + steepest[2] ** 2)
        return resolve2(self.frame_a.R, steepest / length * self.radius)

    def equations(self):
        a, r = self.frame_a, self.arm()
        yield a.v + cross(a.R.w, r) == (0, 0, 0)
        yield a.f == -resolve2(a.R, self.force)
        yield a.t == cross(r, a.f)


class Slipping(Disc):
    """The same through a slip of its own, in the world, of which the one up and down is stated as a height."""

    slip: Vector3 = variable("velocity of the point of contact, resolved in the world", unit="m/s")

    def equations(self):
        yield from list(super().equations())[1:]
        a, r = self.frame_a, self.arm()
        yield self.slip == resolve1(a.R, a.v + cross(a.R.w, r))
        yield self.slip[0] == 0
        yield a.r_0[1] + resolve1(a.R, r)[1] == 0
        yield self.slip[2] == 0


RADIUS, HALF, AHEAD = 0.3, 0.4, 0.15
MASS, WHEEL, SPIN, ACROSS = 2.0, 0.5, 0.02, 0.011


class Wheelset(Model):
    """Two discs on a rigid axle: it can only roll straight on."""

    world = World(g=9.81)
    axle = Body(
        m=2, I=INERTIA, r_0=fixed((0, RADIUS, 0)), v_0=fixed((1.2, 0, 0)), w_a=fixed((0, 0, -4)), angles_fixed=True
    )
    left, right = FixedTranslation(r=(0, 0, 0.5)), FixedTranslation(r=(0, 0, -0.5))
    one, two = Disc(), Disc()

    def connections(self):
        yield chain(self.axle.frame_a, self.left, self.one)
        yield chain(self.axle.frame_a, self.right, self.two)


class Axle(Component):
    """Both discs of a rigid axle in one part."""

    frame_a: Frame = port(Frame, "middle of the axle")
    left: Vector3 = variable("force on the left disc, resolved in the axle", unit="N")
    right: Vector3 = variable("force on the right disc, resolved in the axle", unit="N")

    def equations(self):
        a = self.frame_a
        down = resolve2(a.R, (0, -RADIUS, 0))
        one, two = down + as_expr((0, 0, 0.5)), down - as_expr((0, 0, 0.5))
        yield a.v + cross(a.R.w, one) == (0, 0, 0)
        yield a.v + cross(a.R.w, two) == (0, 0, 0)
        yield a.f == -(self.left + self.right)
        yield a.t == -cross(one, self.left) - cross(two, self.right)


class OneAxle(Model):
    world, wheels = World(g=9.81), Axle()
    axle = Body(
        m=2, I=INERTIA, r_0=fixed((0, RADIUS, 0)), v_0=fixed((1.2, 0, 0)), w_a=fixed((0, 0, -4)), angles_fixed=True
    )

    def connections(self):
        yield connect(self.axle.frame_a, self.wheels.frame_a)


class Robot(Model):
    """Two discs that turn freely on the axle of a body whose mass centre lies ahead of it."""

    world = World(gravity=None)
    chassis = Body(
        m=MASS,
        I=((0.12, 0, 0), (0, 0.2, 0), (0, 0, 0.1)),
        r_CM=(AHEAD, 0, 0),
        r_0=fixed((0, RADIUS, 0)),
        v_0=fixed((1.2, 0, 0)),
        w_a=fixed((0, 0.8, 0)),
        angles_fixed=True,
    )
    left, right = FixedTranslation(r=(0, 0, HALF)), FixedTranslation(r=(0, 0, -HALF))
    pin_left, pin_right = Revolute(phi=fixed(0.3), w=guess(-4)), Revolute(phi=fixed(0), w=guess(-4))
    wheel_left = Body(m=WHEEL, I=((ACROSS, 0, 0), (0, ACROSS, 0), (0, 0, SPIN)))
    wheel_right = Body(m=WHEEL, I=((ACROSS, 0, 0), (0, ACROSS, 0), (0, 0, SPIN)))
    one, two = Disc(), Disc()

    def connections(self):
        yield chain(self.chassis.frame_a, self.left, self.pin_left, self.one)
        yield chain(self.chassis.frame_a, self.right, self.pin_right, self.two)
        yield connect(self.pin_left.frame_b, self.wheel_left.frame_a)
        yield connect(self.pin_right.frame_b, self.wheel_right.frame_a)


class OnRails(Model):
    """A skate on a body that moves along it in any case."""

    world, x, body, skate = World(g=0), Prismatic(s=fixed(0), v=fixed(1)), Body(m=1), Skate()

    def connections(self):
        yield chain(self.world, self.x, self.body)
        yield chain(self.x, self.skate)
