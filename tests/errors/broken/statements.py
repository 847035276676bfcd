"""What the methods of a class state: equations, connections, energies, cases, events, functions of numpy."""

import math

import numpy as np

import acausal as ac
from acausal import (
    Scalar,
    chain,
    connect,
    der,
    dot,
    expect,
    fixed,
    parameter,
    piecewise,
    reinit,
    require,
    sqrt,
    time,
    variable,
    when,
)
from components import Body, FixedTranslation, LineForce, Revolute, World, rotational
from tests.errors.broken.models import Decay, Pendulum, Rotor


def stated(wrong, right, kind=Decay):
    """A case of a model with one more statement in equations()."""

    def case(repaired):
        class M(kind):
            z: Scalar = variable("z")

            def equations(self):
                yield from super().equations()
                yield (right if repaired else wrong)(self)

        ac.compile(M())

    return case


def law(wrong, right=lambda self: self.x):
    """A case of a model in which z follows from a law."""
    return stated(lambda self: self.z == wrong(self), lambda self: self.z == right(self))


def chain_in_equations(repaired):
    class M(Pendulum):
        def connections(self):
            if repaired:
                yield chain(self.world, self.hinge, self.bar, self.mass)

        def equations(self):
            if not repaired:
                yield chain(self.world, self.hinge, self.bar, self.mass)

    ac.compile(M())


def connect_in_equations(repaired):
    class M(Rotor):
        def connections(self):
            if repaired:
                yield connect(self.drive.flange, self.rotor.flange_a)

        def equations(self):
            yield from super().equations()
            if not repaired:
                yield connect(self.drive.flange, self.rotor.flange_a)

    ac.compile(M())


def equation_in_connections(repaired):
    class M(Rotor):
        z: Scalar = variable("z")

        def connections(self):
            yield from super().connections()
            if not repaired:
                yield self.z == 1

        def equations(self):
            yield from super().equations()
            if repaired:
                yield self.z == 1

    ac.compile(M())


def ports_that_are_equal(repaired):
    class M(Rotor):
        def connections(self):
            if repaired:
                yield connect(self.drive.flange, self.rotor.flange_a)
            else:
                yield self.drive.flange == self.rotor.flange_a

    ac.compile(M())


def connection_without_yield(repaired):
    if repaired:

        class M(Rotor):
            def connections(self):
                yield connect(self.drive.flange, self.rotor.flange_a)
    else:

        class M(Rotor):
            def connections(self):
                connect(self.drive.flange, self.rotor.flange_a)

    ac.compile(M())


def equation_without_yield(repaired):
    if repaired:

        class M(Decay):
            z: Scalar = variable("z")

            def more(self):
                yield self.z == self.x
    else:

        class M(Decay):
            z: Scalar = variable("z")

            def more(self):
                self.z == self.x  # noqa: B015
                yield from ()

    ac.compile(M())


def connection_in_the_class_body(repaired):
    if repaired:

        class M(Rotor):
            def connections(self):
                yield connect(self.drive.flange, self.rotor.flange_a)
    else:

        class M(Rotor):
            drive = rotational.Torque()
            rotor = rotational.Inertia(J=1)
            joined = connect(drive.flange, rotor.flange_a)

    ac.compile(M())


def equation_too_many(repaired):
    class M(Rotor):
        def equations(self):
            if not repaired:
                yield from super().equations()
            yield self.drive.tau == 2

    ac.compile(M())


def angle_of_a_pendulum_prescribed(repaired):
    class M(Pendulum):
        def equations(self):
            yield from super().equations()
            if not repaired:
                yield self.hinge.phi == 1

    ac.compile(M())


def equation_for_a_parameter(repaired):
    class M(Decay):
        k: Scalar = parameter("k", default=2)

        def more(self):
            if not repaired:
                yield self.k == 2
            yield from ()

    ac.compile(M())


def start_by_fixed(repaired):
    stated(lambda self: fixed(self.z), lambda self: self.z == 1)(repaired)


def inequality(repaired):
    stated(lambda self: self.z < 1, lambda self: self.z == 1)(repaired)


def bare_reinit(repaired):
    stated(lambda self: reinit(self.x, 1), lambda self: self.z == 1)(repaired)


def list_of_equations(repaired):
    stated(lambda self: [self.z == 1], lambda self: self.z == 1)(repaired)


def comma_for_equals(repaired):
    stated(lambda self: (self.z, 1), lambda self: self.z == 1)(repaired)


def text_as_an_equation(repaired):
    stated(lambda self: "z = 1", lambda self: self.z == 1)(repaired)


def requirement_as_an_equation(repaired):
    stated(lambda self: require(self.x < 2, "x is too great"), lambda self: self.z == 1)(repaired)


def expectation_as_an_equation(repaired):
    stated(lambda self: expect(self.x, self.x, 1, "x"), lambda self: self.z == 1)(repaired)


def part_in_an_equation(repaired):
    stated(lambda self: self.z == self.mass, lambda self: self.z == self.mass.m, kind=Pendulum)(repaired)


def text_in_an_equation(repaired):
    law(lambda self: "x")(repaired)


def nothing_in_an_equation(repaired):
    law(lambda self: None)(repaired)


def function_in_an_equation(repaired):
    law(lambda self: self.more, lambda self: 2 * self.x)(repaired)


def condition_in_an_equation(repaired):
    law(lambda self: self.x < 1, lambda self: piecewise((1, self.x < 1), 0))(repaired)


def condition_as_a_number(repaired):
    law(lambda self: 3 * (self.x < 1), lambda self: piecewise((3, self.x < 1), 0))(repaired)


def rows_of_different_length(repaired):
    law(lambda self: dot(((1, 2, 3), (1, 2)), self.v), lambda self: dot((1, 2, 3), self.v))(repaired)


def caret_for_a_power(repaired):
    law(lambda self: self.x ^ 2, lambda self: self.x**2)(repaired)


def second_derivative(repaired):
    law(lambda self: der(self.x, 2), lambda self: der(self.x))(repaired)


def not_a_number(repaired):
    law(lambda self: math.nan)(repaired)


def piecewise_without_otherwise(repaired):
    law(lambda self: piecewise((1, self.x < 1)), lambda self: piecewise((1, self.x < 1), 0))(repaired)


def piecewise_swapped(repaired):
    law(lambda self: piecewise((self.x < 1, 1), 0), lambda self: piecewise((1, self.x < 1), 0))(repaired)


def piecewise_of_a_bool(repaired):
    law(lambda self: piecewise((1, True), 0), lambda self: 1 if True else 0)(repaired)


def piecewise_of_nothing(repaired):
    law(lambda self: piecewise())(repaired)


def piecewise_as_a_list(repaired):
    law(lambda self: piecewise([(1, self.x < 1), 0]), lambda self: piecewise((1, self.x < 1), 0))(repaired)


def piecewise_flat(repaired):
    law(lambda self: piecewise(1, self.x < 1, 0), lambda self: piecewise((1, self.x < 1), 0))(repaired)


def conditions_without_brackets(repaired):
    law(
        lambda self: piecewise((1, self.x > 0 & self.x < 1), 0),
        lambda self: piecewise((1, (self.x > 0) & (self.x < 1)), 0),
    )(repaired)


def when_without_reinit(repaired):
    stated(lambda self: when(self.x < 0.5), lambda self: self.z == 1)(repaired)


def when_swapped(repaired):
    stated(lambda self: when(reinit(self.x, 1), self.x < 0.5), lambda self: self.z == 1)(repaired)


def when_with_a_list(repaired):
    stated(lambda self: when(self.x < 0.5, [reinit(self.x, 1)]), lambda self: self.z == 1)(repaired)


def when_at_a_number(repaired):
    stated(lambda self: when(0.5, reinit(self.x, 1)), lambda self: self.z == 1)(repaired)


def reinit_of_an_equation(repaired):
    stated(lambda self: when(self.x < 0.5, reinit(self.x == 1)), lambda self: self.z == 1)(repaired)


def reinit_of_a_product(repaired):
    stated(lambda self: when(self.x < 0.5, reinit(2 * self.x, 1)), lambda self: self.z == 1)(repaired)


def norm_of_numpy(repaired):
    law(lambda self: np.linalg.norm(self.v), lambda self: sqrt(dot(self.v, self.v)))(repaired)


def where_of_numpy(repaired):
    law(lambda self: np.where(time > 1, self.x, 0), lambda self: piecewise((self.x, time > 1), 0))(repaired)


def clip_of_numpy(repaired):
    law(lambda self: np.clip(self.x, 0, 1), lambda self: piecewise((0, self.x < 0), (1, self.x > 1), self.x))(repaired)


def table_of_numpy(repaired):
    law(lambda self: np.interp(self.x, [0, 1], [2, 3]), lambda self: 2 + self.x)(repaired)


def array_of_zeros(repaired):
    law(lambda self: filled(np.zeros(3), self.x)[0], lambda self: self.x)(repaired)


def filled(array, value):
    """Set the first entry."""
    array[0] = value
    return array


def energy(value, name="stored_energy"):
    """A case of a model whose energy is something else."""

    def case(repaired):
        def method(self):
            return 0.5 * self.x**2 if repaired else value(self)

        ac.compile(type("M", (Decay,), {name: method})())

    return case


def vector_as_energy(repaired):
    energy(lambda self: self.v)(repaired)


def text_as_power(repaired):
    energy(lambda self: "x", "supplied_power")(repaired)


def method_as_energy(repaired):
    energy(lambda self: self.more)(repaired)


def energy_without_return(repaired):
    class M(Decay):
        def stored_energy(self):
            energy = 0.5 * self.x**2
            if repaired:
                return energy

    ac.compile(M())


def power_that_is_yielded(repaired):
    class M(Decay):
        if repaired:

            def dissipated_power(self):
                return self.x**2
        else:

            def dissipated_power(self):
                yield self.x**2

    ac.compile(M())


def initial_equation_returned(repaired):
    class M(Decay):
        if repaired:

            def initial_equations(self):
                yield self.x == 1
        else:

            def initial_equations(self):
                return self.x == 1

    ac.compile(M())


def inequality_as_a_requirement(repaired):
    class M(Decay):
        def requirements(self):
            yield require(self.p > 0, "`p` is not positive") if repaired else self.p > 0

    ac.compile(M())


def force_without_a_law(repaired):
    class Cable(LineForce):
        if repaired:

            def law(self):
                yield self.f == 1

    class M(Pendulum):
        anchor = FixedTranslation(r=(0, 1, 0))
        cable = Cable()

        def connections(self):
            yield from super().connections()
            yield chain(self.world, self.anchor, self.cable, self.mass.frame_a)

    ac.compile(M())


def axis_without_a_flange(repaired):
    class M(Pendulum):
        hinge = Revolute(use_axis_flange=repaired, phi=fixed(0.1), w=fixed(0))
        drive = rotational.Torque(tau=1)

        def connections(self):
            yield from super().connections()
            yield chain(self.drive, self.hinge.axis)

    ac.compile(M())


def angles_of_a_free_body(repaired):
    class M(ac.Model):
        world = World()
        body = Body(
            m=1, I=np.eye(3), r_0=fixed((0, 0, 0)), v_0=fixed((0, 0, 0)), w_a=fixed((0, 0, 0)), angles_fixed=repaired
        )

    ac.simulate(M(), stop_time=0.01)


def check_of_a_library_part(repaired):
    class M(Pendulum):
        hinge = Revolute(n=(0, 0, 1) if repaired else (0, 0, 0), phi=fixed(0.1), w=fixed(0))

    ac.compile(M())


def assertion_in_check(repaired):
    class M(Decay):
        sides = 4 if repaired else 3

        def check(self):
            assert self.sides % 2 == 0

    ac.compile(M())
