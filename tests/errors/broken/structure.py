"""Too many equations, too few, and some that say the same."""

import acausal as ac
from acausal import (
    Model,
    Scalar,
    Vector3,
    chain,
    connect,
    cos,
    der,
    dot,
    exp,
    fixed,
    input,
    log,
    parameter,
    sin,
    time,
    variable,
)
from components import Body, BodyBox, BodyCylinder, BodyRod, FixedTranslation, Revolute, Spherical, World, rotational
from tests.errors.broken.models import Decay, Pendulum, Rotor


class Two(Decay):
    a: Scalar = variable("a", start=1)
    b: Scalar = variable("b", start=1)


def same_cube(repaired):
    class M(Two):
        def more(self):
            yield self.a + self.b == self.x
            yield (self.a if repaired else (self.a + self.b) ** 3) == (self.b if repaired else self.x**3)

    ac.simulate(M(), stop_time=0.1)


def same_logarithm(repaired):
    class M(Two):
        def more(self):
            yield self.a * self.b == self.x
            yield log(self.a) + (-1 if repaired else 1) * log(self.b) == log(self.x)

    ac.simulate(M(), stop_time=0.1)


def same_sine(repaired):
    class M(Two):
        def more(self):
            yield self.a * self.b == self.x
            yield sin(self.a * (1 if repaired else self.b)) == sin(self.x)

    ac.simulate(M(), stop_time=0.1)


def touching(repaired):
    class M(Two):
        def more(self):
            yield self.a + self.b == self.x
            yield self.a * self.b == (0.24 if repaired else 0.25)

        a: Scalar = variable("a", start=0.6 if repaired else 0.5)
        b: Scalar = variable("b", start=0.4 if repaired else 0.5)

    ac.simulate(M(), stop_time=0.1) if not repaired else ac.compile(M())


def sum_by_its_sine_and_cosine(repaired):
    class M(Two):
        def more(self):
            yield sin(self.a + self.b) == 0.5 * self.x
            yield cos(self.a - (self.b if repaired else -self.b)) == self.x

    ac.compile(M()) if repaired else ac.simulate(M(), stop_time=0.1)


def same_rates(repaired):
    class M(Model):
        x: Scalar = variable("x", start=1, fixed=True)
        y: Scalar = variable("y", start=1, fixed=True)

        def equations(self):
            yield der(self.x) + der(self.y) == -self.x
            if repaired:
                yield der(self.y) == -self.y
            else:
                yield sin(der(self.x) + der(self.y)) == sin(-self.x)

    ac.simulate(M(), stop_time=0.1)


def same_on_a_part(repaired):
    class M(Pendulum):
        a: Scalar = variable("a")
        b: Scalar = variable("b")

        def equations(self):
            yield self.a + self.b == self.hinge.phi
            yield exp(self.a + (-self.b if repaired else self.b)) == exp(self.hinge.phi)

    ac.simulate(M(), stop_time=0.1)


def same_linearized(repaired):
    class M(Decay):
        a: Scalar = variable("a", start=1)
        b: Scalar = variable("b", start=1)

        def more(self):
            yield self.a * self.b == self.x
            yield (self.a == self.b) if repaired else (sin(self.a * self.b) == sin(self.x))

    ac.linearize(M())


def inherited_and_own(repaired):
    class M(Rotor):
        def equations(self):
            yield from super().equations()
            if not repaired:
                yield self.rotor.w == 1

    ac.compile(M())


def inherited_rate_again(repaired):
    class M(Decay):
        def equations(self):
            if not repaired:
                yield from super().equations()
            else:
                yield self.v == (0, 0, 0)
            yield der(self.x) == 1

    ac.compile(M())


def inherited_law_again(repaired):
    class Preloaded(rotational.Spring):
        def equations(self):
            yield from super().equations()
            if not repaired:
                yield self.tau == 3

    class M(Rotor):
        spring, wall = Preloaded(c=1), rotational.Fixed()

        def connections(self):
            yield from super().connections()
            yield chain(self.rotor.flange_b, self.spring, self.wall)

    ac.compile(M())


def equation_of_parameters(repaired):
    class M(Decay):
        q: Scalar = parameter("q", default=2)

        def more(self):
            if not repaired:
                yield self.p == self.q

    ac.compile(M())


def equation_of_an_input(repaired):
    class M(Decay):
        u: Scalar = variable("u") if repaired else input("u")

        def more(self):
            yield self.u == sin(time)

    ac.compile(M())


def equation_of_time(repaired):
    class M(Decay):
        def more(self):
            if not repaired:
                yield time == 2 * time

    ac.compile(M())


def angle_driven_twice(repaired):
    class M(Pendulum):
        def equations(self):
            if not repaired:
                yield self.hinge.phi == sin(time)

    ac.compile(M())


def torque_of_a_free_joint(repaired):
    class M(Pendulum):
        def equations(self):
            yield self.hinge.tau == 1

    class Driven(Pendulum):
        hinge = Revolute(use_axis_flange=True, phi=fixed(0), w=fixed(0))
        drive = rotational.Torque()

        def connections(self):
            yield from super().connections()
            yield chain(self.drive, self.hinge.axis)

        def equations(self):
            yield self.drive.tau == 1

    ac.compile(Driven() if repaired else M())


def vector_and_its_length(repaired):
    class M(Decay):
        y: Vector3 = variable("y")

        def more(self):
            yield self.y == (1, 2, 3)
            if not repaired:
                yield dot(self.y, self.y) == 1

    ac.compile(M())


def entry_without_equation(repaired):
    class M(Decay):
        y: Vector3 = variable("y")

        def more(self):
            yield self.y[0] == 1
            yield self.y[1] == self.x
            if repaired:
                yield self.y[2] == 0

    ac.compile(M())


def no_equations(repaired):
    class M(Model):
        x: Scalar = variable("x", start=1)
        y: Scalar = variable("y", start=1)

        if repaired:

            def equations(self):
                yield der(self.x) == -self.x
                yield self.y == 2 * self.x

    ac.compile(M())


def input_without_value(repaired):
    class M(Rotor):
        load = rotational.Inertia(J=1, phi=fixed(0), w=fixed(0))
        motor = rotational.Torque(tau=1) if repaired else rotational.Torque()

        def connections(self):
            yield from super().connections()
            yield chain(self.motor, self.load)

    ac.compile(M())


def spring_in_the_air(repaired):
    class M(Rotor):
        spring = rotational.Spring(c=1)

        def connections(self):
            yield from super().connections()
            if repaired:
                yield connect(self.rotor.flange_b, self.spring.flange_a)

    ac.compile(M())


def point_mass_in_free_flight(repaired):
    class M(Model):
        world = World()
        ball = Body(m=1, I=((1, 0, 0), (0, 1, 0), (0, 0, 1))) if repaired else Body(m=1)

    ac.compile(M())


def hinge_on_nothing(repaired):
    class M(Model):
        world, hinge, arm = World(), Revolute(phi=fixed(0), w=fixed(0)), BodyBox(r=(1, 0, 0), width=0.1, height=0.1)

        def connections(self):
            yield chain(self.world, self.hinge, self.arm) if repaired else chain(self.hinge, self.arm)

    ac.compile(M())


def thin_rod_in_free_flight(repaired):
    class M(Model):
        world = World()
        rod = BodyCylinder(r=(1, 0, 0), diameter=0.1) if repaired else BodyRod(r=(1, 0, 0), m=1)

    ac.compile(M())


def thin_rod_on_a_ball(repaired):
    class M(Model):
        world, hinge, arm, ball = World(), Revolute(), BodyBox(r=(1, 0, 0), width=0.1, height=0.1), Spherical()
        rod = BodyCylinder(r=(1, 0, 0), diameter=0.1) if repaired else BodyRod(r=(1, 0, 0), m=1)

        def connections(self):
            yield chain(self.world, self.hinge, self.arm, self.ball, self.rod)

    ac.compile(M())


def point_mass_on_a_ball(repaired):
    class M(Model):
        world, ball = World(), Spherical()
        mass = Body(m=1, r_CM=(1, 0, 0), I=((1, 0, 0), (0, 1, 0), (0, 0, 1))) if repaired else Body(m=1, r_CM=(1, 0, 0))

        def connections(self):
            yield chain(self.world, self.ball, self.mass)

    ac.compile(M())


def start_of_a_part_fixed_twice(repaired):
    class M(Pendulum):
        mass = Body(m=1) if repaired else Body(m=1, r_0=fixed((1, 0, 0)))

    ac.simulate(M(), stop_time=0.1)


def start_by_equation_too(repaired):
    class M(Pendulum):
        def initial_equations(self):
            if not repaired:
                yield self.hinge.phi == 0.2

    ac.simulate(M(), stop_time=0.1)


def start_of_what_follows(repaired):
    class M(Decay):
        y: Scalar = variable("y") if repaired else variable("y", start=1, fixed=True)

        def more(self):
            yield self.y == self.p * self.x

    ac.simulate(M(), stop_time=0.1)


def loop_fixed_too_often(repaired):
    class M(Model):
        world, r = World(), (1, 0, 0)
        j1, b1 = Revolute(phi=fixed(0.5), w=fixed(0)), FixedTranslation(r=r)
        j2, b2 = Revolute(phi=ac.guess(0.5) if repaired else fixed(1)), FixedTranslation(r=r)
        j3, b3 = Revolute(phi=ac.guess(-1) if repaired else fixed(1)), FixedTranslation(r=r)
        j4, ground, m = Revolute(), FixedTranslation(r=(2, 0, 0)), Body(m=1, I=((1, 0, 0), (0, 1, 0), (0, 0, 1)))

        def connections(self):
            yield chain(self.world, self.j1, self.b1, self.j2, self.b2, self.j3, self.b3, self.j4)
            yield chain(self.world, self.ground)
            yield connect(self.ground.frame_b, self.j4.frame_b)
            yield connect(self.b2.frame_b, self.m.frame_a)

    ac.simulate(M(), stop_time=0.01)


def rest_where_nothing_holds(repaired):
    class M(Pendulum):
        hinge = Revolute() if repaired else Revolute(phi=fixed(0.1), w=fixed(0))

    ac.simulate(M(), stop_time=0.1, initial="steady")


def read(key):
    result = ac.simulate(Pendulum(), stop_time=0.1, intervals=4)
    return result[key] if not callable(key) else key(result)


def result_misspelt(repaired):
    read("hinge.phi" if repaired else "hinge.fi")


def result_by_number(repaired):
    read("hinge.phi" if repaired else 3)


def result_by_slice(repaired):
    read("hinge.phi" if repaired else slice(0, 2))


def result_of_a_part(repaired):
    read("hinge.phi" if repaired else "hinge")


def entry_that_there_is_not(repaired):
    read("mass.r_0[1]" if repaired else "mass.r_0[3]")


def plot_of_nothing_known(repaired):
    read(lambda r: r.plot("hinge.phi" if repaired else "hinge.angle"))


def picture_of_unknown_kind(repaired):
    read(
        lambda r: (
            r.plot("hinge.phi", path="/dev/null" if repaired else "out.docx") if not repaired else r.plot("hinge.phi")
        )
    )


def table_in_a_missing_folder(repaired):
    read(lambda r: r.to_csv("/dev/null" if repaired else "no_such_folder/out.csv", "hinge.phi"))


def table_as_a_folder(repaired):
    read(lambda r: r.to_csv("/dev/null" if repaired else ".", "hinge.phi"))


def rotation_by_cosine_alone(repaired):
    class M(Decay):
        a: Scalar = variable("a", start=0.5)
        c: Scalar = variable("c")

        def more(self):
            yield self.c == cos(self.a)
            yield self.c**2 + (0 if repaired else sin(self.a) ** 2) == (0.5 if repaired else 1)

    ac.simulate(M(), stop_time=0.1)
