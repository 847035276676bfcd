"""Each broken model tells what is wrong, and its repaired form does not: exact messages are in messages.txt."""

import inspect
import math
import re
from pathlib import Path

import casadi as ca
import numpy as np
import pytest

import acausal as ac
from acausal import (
    Model,
    Scalar,
    Vector3,
    chain,
    connect,
    der,
    dot,
    fixed,
    input,
    output,
    parameter,
    piecewise,
    reinit,
    sin,
    time,
    variable,
    when,
)
from components import Body, BodyShape, Fixed, FixedTranslation, FlexibleBeam, Revolute, World, rotational

GOLDEN = Path(__file__).with_name("messages.txt")
SECTION = {"rho": 1000, "A": 1e-4, "J": 1e-9}


class Pendulum(Model):
    world = World(g=9.81)
    hinge = Revolute(phi=fixed(0.1), w=fixed(0))
    bar = FixedTranslation(r=(1, 0, 0))
    mass = Body(m=1)

    def connections(self):
        yield chain(self.world, self.hinge, self.bar, self.mass)


class Decay(Model):
    """x and v, and one more equation for z."""

    x: Scalar = variable("x", start=1, fixed=True)
    v: Vector3 = variable("v")
    p: Scalar = parameter("p", default=2.0)

    def equations(self):
        yield der(self.x) == -self.x
        yield self.v == (0, 0, 0)
        yield from self.more()

    def more(self):
        yield from ()


class Rotor(Model):
    tau: Scalar = input("torque", unit="N.m")
    drive = rotational.Torque()
    rotor = rotational.Inertia(J=1, phi=fixed(0), w=fixed(0))

    def connections(self):
        yield chain(self.drive, self.rotor)

    def equations(self):
        yield self.drive.tau == self.law()

    def law(self):
        return self.tau


def missing_world(repaired):
    class M(Model):
        mass = Body(m=1, I=np.eye(3))
        if repaired:
            world = World()

    ac.compile(M())


def second_world(repaired):
    class M(Pendulum):
        second = None if repaired else World()

    ac.compile(M())


def unconnected_joint(repaired):
    class M(Pendulum):
        spare = None if repaired else Revolute()

    ac.compile(M())


def unconnected_spring(repaired):
    class M(Rotor):
        spring = rotational.Spring(c=1)
        wall = rotational.Fixed()

        def connections(self):
            yield from super().connections()
            if repaired:
                yield chain(self.rotor, self.spring, self.wall)

    ac.compile(M())


def doubled_connection(repaired):
    class M(Pendulum):
        def connections(self):
            yield from super().connections()
            if not repaired:
                yield connect(self.bar.frame_b, self.mass.frame_a)

    ac.compile(M())


def frame_with_flange(repaired):
    class M(Pendulum):
        hinge = Revolute(use_axis_flange=True, phi=fixed(0), w=fixed(0))
        rotor = rotational.Inertia(J=1)

        def connections(self):
            yield from super().connections()
            yield connect(self.hinge.axis if repaired else self.hinge.frame_b, self.rotor.flange_a)

    ac.compile(M())


def port_of_an_option(repaired):
    class M(Pendulum):
        hinge = Revolute(use_axis_flange=repaired, phi=fixed(0), w=fixed(0))
        rotor = rotational.Inertia(J=1)

        def connections(self):
            yield from super().connections()
            yield connect(self.hinge.axis, self.rotor.flange_a)

    ac.compile(M())


def chain_without_end(repaired):
    class M(Model):
        world, hinge, mass = World(), Revolute(), Body(m=1, r_CM=(1, 0, 0))

        def connections(self):
            yield chain(*((self.world, self.hinge, self.mass) if repaired else (self.world, self.mass, self.hinge)))

    ac.compile(M())


def contradictory_start(repaired):
    class M(Pendulum):
        x: Scalar = variable("x", unit="m", start=0.5, fixed=not repaired)

        def equations(self):
            yield self.x == self.mass.r_0[0]

    ac.simulate(M(), stop_time=0.1)


def missing_start(repaired):
    class M(Pendulum):
        hinge = Revolute(phi=fixed(0.1), w=fixed(0)) if repaired else Revolute()

    ac.simulate(M(), stop_time=0.1)


def rigid_loop(repaired):
    class M(Model):
        world, bar, end = World(), FixedTranslation(r=(1, 0, 0)), Fixed(r=(2, 0, 0))

        def connections(self):
            yield chain(self.world, self.bar) if repaired else chain(self.world, self.bar, self.end.frame_b)

    ac.simulate(M(), stop_time=0.1)


def too_many_equations(repaired):
    class M(Decay):
        def more(self):
            if not repaired:
                yield sin(self.x) == self.x**2

    ac.compile(M())


def output_without_equation(repaired):
    class M(Decay):
        z: Scalar = output("z")

        def more(self):
            if repaired:
                yield self.z == self.x

    ac.compile(M())


def singular(repaired):
    class M(Decay):
        z: Scalar = variable("z")

        def more(self):
            yield sin(self.z if repaired else self.x) == self.x**2

    ac.compile(M())


def if_on_parameter(repaired):
    class M(Decay):
        def more(self):
            if not repaired and self.p > 1:
                yield self.x == 1

    ac.compile(M())


def wrong_shape(repaired):
    class M(Decay):
        z: Vector3 = variable("z")

        def more(self):
            yield self.z == self.v + ((1, 2, 3) if repaired else (1, 2))

    ac.compile(M())


def scalar_and_vector(repaired):
    class M(Decay):
        z: Scalar = variable("z")

        def more(self):
            yield self.z == (self.v[0] if repaired else self.v)

    ac.compile(M())


def wrong_unit(repaired):
    class M(Decay):
        s: Scalar = variable("s", unit="m")
        u: Scalar = variable("u", unit="m/s")

        def more(self):
            yield self.s == self.x
            yield self.u == (der(self.s) if repaired else self.s)

    ac.compile(M())


def chained_comparison(repaired):
    class M(Decay):
        y: Scalar = variable("y")
        z: Scalar = variable("z")

        def more(self):
            if repaired:
                yield self.y == self.z
                yield self.z == self.x
            else:
                yield self.y == self.z == self.x

    ac.compile(M())


def membership(repaired):
    class M(Decay):
        def more(self):
            if not repaired and self.x in [1, 2]:
                yield self.x == 1

    ac.compile(M())


def no_equation(repaired):
    class M(Decay):
        z: Scalar = variable("z")

        def more(self):
            yield self.z == self.x + 1 if repaired else self.x + 1

    ac.compile(M())


def nothing_yielded(repaired):
    class M(Decay):
        z: Scalar = variable("z")

        def more(self):
            yield self.z == 1 if repaired else None

    ac.compile(M())


def returned_equation(repaired):
    class M(Model):
        z: Scalar = variable("z")

        def equations(self):
            return [self.z == time] if repaired else self.z == time

    ac.compile(M())


def misspelt_part(repaired):
    class M(Pendulum):
        def connections(self):
            yield chain(self.world, self.hinge if repaired else self.hing, self.bar, self.mass)

    ac.compile(M())


def torque_law(repaired):
    class M(Rotor):
        def law(self):
            return self.tau if repaired else (0, 0, time)

    ac.compile(M())


def beam(**values):
    class M(Model):
        world, beam = World(), FlexibleBeam(**{"length": 1, "E": 1e9, "elements": 2, **SECTION, **values})

        def connections(self):
            yield chain(self.world, self.beam)

    ac.compile(M())


def negative_length(repaired):
    beam(length=1 if repaired else -1)


def negative_modulus(repaired):
    beam(E=1e9 if repaired else -1e9)


def zero_elements(repaired):
    beam(elements=1 if repaired else 0)


def half_an_element(repaired):
    beam(elements=2 if repaired else 2.5)


def weigh(m):
    class M(Pendulum):
        mass = Body(m=m)

    ac.compile(M())


def negative_mass(repaired):
    weigh(1 if repaired else -1)


def mass_of_text(repaired):
    weigh(1 if repaired else "heavy")


def mass_of_bool(repaired):
    weigh(1 if repaired else True)


def mass_of_nan(repaired):
    weigh(1 if repaired else float("nan"))


def parameter_of_wrong_shape(repaired):
    class M(Pendulum):
        bar = FixedTranslation(r=(1, 0, 0) if repaired else (1, 0))

    ac.compile(M())


def axis_of_length_0(repaired):
    class M(Pendulum):
        hinge = Revolute(n=(0, 0, 1 if repaired else 0))

    ac.compile(M())


def unknown_argument(repaired):
    BodyShape(m=1, r=(1, 0, 0)) if repaired else BodyShape(mass=1, r=(1, 0, 0))


def number_for_variable(repaired):
    Revolute(phi=fixed(0.1) if repaired else 0.1)


def unknown_parameter(repaired):
    ac.compile(Pendulum(), parameters={"mass.m" if repaired else "mass.mm": 2})


def variable_as_parameter(repaired):
    ac.compile(Pendulum(), parameters={"mass.m" if repaired else "hinge.phi": 2})


def unknown_variable(repaired):
    ac.simulate(Pendulum(), stop_time=0.1)["mass.r_0" if repaired else "mass.r0"]


def change(**values):
    ac.compile(Pendulum()).parameter_values({name.replace("_", ".", 1): value for name, value in values.items()})


def structural_zero(repaired):
    change(bar_r=(2, 0 if repaired else 1, 0))


def structural_changed(repaired):
    change(mass_m=2) if repaired else change(hinge_n=(0, 1, 0))


def too_many_entries_when_compiled(repaired):
    change(bar_r=(2, 0, 0) if repaired else (2, 0, 0, 0))


def bool_when_compiled(repaired):
    change(mass_m=2 if repaired else True)


def nan_when_compiled(repaired):
    change(bar_r=(2 if repaired else float("nan"), 0, 0))


def run(**options):
    ac.simulate(Pendulum(), **{"stop_time": 0.1, **options})


def stop_before_start(repaired):
    run(start_time=0 if repaired else 1)


def stop_of_text(repaired):
    run(stop_time=0.1 if repaired else "0.1")


def tolerance_0(repaired):
    run(tolerance=1e-5 if repaired else 0)


def half_an_interval(repaired):
    run(intervals=2 if repaired else 2.5)


def order_6(repaired):
    run(max_order=5 if repaired else 6)


def unknown_method(repaired):
    run(method="idas" if repaired else "rk4")


def unknown_initial(repaired):
    run(initial="guesses" if repaired else "guess")


def endless_bouncing(repaired):
    class Ball(Model):
        h: Scalar = variable("height", start=1, fixed=True)
        v: Scalar = variable("speed", start=0, fixed=True)

        def equations(self):
            yield der(self.h) == self.v
            yield der(self.v) == -10
            yield when(self.h < 0, reinit(self.v, -(1 if repaired else 0.5) * self.v))

    ac.simulate(Ball(), stop_time=2)


def force_that_changes_sign(repaired):
    class Relay(Model):
        x: Scalar = variable("x", start=1, fixed=True)

        def equations(self):
            yield der(self.x) == piecewise((-1, self.x > 0), 0 if repaired else 1)

    ac.simulate(Relay(), stop_time=2)


def jump_of_no_state(repaired):
    class M(Decay):
        z: Scalar = variable("z")

        def more(self):
            yield self.z == sin(self.x)
            yield when(self.x < 0.5, reinit(self.x if repaired else self.z, 1))

    ac.compile(M())


def when_at_the_start(repaired):
    class M(Decay):
        def initial_equations(self):
            if not repaired:
                yield when(self.x < 0.5, reinit(self.x, 1))

    ac.compile(M())


def when_without_condition(repaired):
    class M(Decay):
        def more(self):
            yield when(self.x < 0.5 if repaired else self.x, reinit(self.x, 1))

    ac.compile(M())


def modes_without_rest(repaired):
    class M(Decay):
        z: Scalar = variable("z")

        def more(self):
            yield self.z == piecewise((1, (self.x if repaired else self.z) < 0.5), 0)

    ac.simulate(M(), stop_time=0.1)


def slip_on_an_instance(repaired):
    model = Decay(p=3) if repaired else Decay()
    if not repaired:
        model.pp = 3
    ac.compile(model)


def slip_in_a_class_body(repaired):
    class Base(Decay):
        load: Scalar = parameter("load", default=1)

    ac.compile(type("M", (Base,), {"load" if repaired else "loda": 5})())


def slip_of_a_method(repaired):
    class Base(Model):
        z: Scalar = variable("z")

    ac.compile(type("M", (Base,), {"equations" if repaired else "equation": lambda self: iter([self.z == time])})())


def body_without_inertia(repaired):
    class M(Model):
        world = World()
        mass = Body(m=1, I=np.eye(3) if repaired else np.zeros((3, 3)))

    ac.compile(M())


def flange_of_an_option(repaired):
    class M(Pendulum):
        hinge = Revolute(use_axis_flange=repaired, phi=fixed(0), w=fixed(0))
        damper = rotational.Damper(d=1)

        def connections(self):
            yield from super().connections()
            yield from self.damped()

        def damped(self):
            yield chain(self.hinge.support, self.damper, self.hinge.axis)

    ac.compile(M())


def state(law, repaired=lambda self: self.x):
    """z follows from x by a law."""

    def case(good):
        class M(Decay):
            z: Scalar = variable("z")

            def more(self):
                yield self.z == (repaired if good else law)(self)

        ac.simulate(M(), stop_time=0.1)

    return case


def casadi_table(repaired):
    table = ca.interpolant("table", "linear", [np.linspace(0, 1, 5)], np.linspace(0, 1, 5) ** 2)
    state(lambda self: table(self.x), lambda self: self.x**2)(repaired)


def casadi_function(repaired):
    state(lambda self: ca.sin(self.x), lambda self: sin(self.x))(repaired)


def casadi_symbol(repaired):
    q = ca.SX.sym("q")
    state(lambda self: self.x + q, lambda self: self.x + self.p)(repaired)


def greater_of_two(repaired):
    state(lambda self: max(self.x, self.p), lambda self: piecewise((self.x, self.x > self.p), self.p))(repaired)


def greater_by_numpy(repaired):
    state(lambda self: np.maximum(self.x, 0), lambda self: np.abs(self.x))(repaired)


def array_of_numpy(repaired):
    state(lambda self: np.array([self.x, 0, 0]) @ self.v, lambda self: dot((self.x, 0, 0), self.v))(repaired)


def sine_of_math(repaired):
    state(lambda self: math.sin(self.x), lambda self: np.sin(self.x))(repaired)


def number_of_a_symbol(repaired):
    state(lambda self: float(self.x))(repaired)


def decision_on_a_symbol(repaired):
    state(lambda self: 1 if self.x else 2, lambda self: piecewise((1, self.x > 0), 2))(repaired)


def whole_part(repaired):
    state(lambda self: self.x // 2, lambda self: self.x / 2)(repaired)


def slice_beyond_the_end(repaired):
    state(lambda self: sum(self.v[1:5]), lambda self: sum(self.v[1:3]))(repaired)


def entry_by_a_symbol(repaired):
    state(lambda self: self.v[self.p], lambda self: self.v[2])(repaired)


def entry_is_set(repaired):
    state(lambda self: self.v.__setitem__(0, 1), lambda self: self.v[0])(repaired)


def equality_as_a_condition(repaired):
    state(
        lambda self: piecewise((1, self.x == 0), 2),
        lambda self: piecewise((1, (self.x >= 0) & (self.x <= 0)), 2),
    )(repaired)


def method_of_an_expression(repaired):
    state(lambda self: self.v.dot(self.v), lambda self: dot(self.v, self.v))(repaired)


CASES = [
    f
    for f in list(globals().values())
    if inspect.isfunction(f) and list(inspect.signature(f).parameters) == ["repaired"]
]


def told(case):
    """Kind and message, with lines of this file counted from the head of the case, other files without lines."""
    with pytest.raises(ac.AcausalError) as caught:
        case(False)
    first = case.__code__.co_firstlineno
    text = f"{type(caught.value).__name__}: {caught.value}"

    def shift(found):
        line = int(found[1]) - first
        return f"line {line:+d}" if line > 0 else "a shared line"

    text = re.sub(re.escape(__file__) + r":(\d+)", shift, text)
    return re.sub(r"/\S*/(\w+/\w+\.py):\d+", r"\1:*", text)


def golden():
    pairs = re.findall(r"^\[(\w+)\]\n(.*?)\n(?=\n\[|\Z)", GOLDEN.read_text(), re.M | re.S)
    return {name: text.rstrip() for name, text in pairs}


@pytest.mark.parametrize("case", CASES, ids=lambda case: case.__name__)
def test_message(case):
    assert told(case) == golden()[case.__name__]


@pytest.mark.parametrize("case", CASES, ids=lambda case: case.__name__)
def test_repaired(case):
    case(True)
