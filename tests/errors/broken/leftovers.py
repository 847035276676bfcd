"""Values that are no numbers, arguments and marks that do not exist, types and units that cannot be meant."""

import numpy as np

import acausal as ac
from acausal import (
    Formulation,
    Matrix33,
    Model,
    Scalar,
    Vector3,
    compile,
    der,
    discrete,
    fixed,
    input,
    linearize,
    observed,
    parameter,
    part,
    parts,
    port,
    quantity,
    simulate,
    structural,
    study,
    time,
    variable,
    with_and_without,
)
from components import Body, Frame, Revolute, rotational
from tests.errors.broken.models import Decay, Pendulum, Rotor


def built(**body):
    """A model with what is given, compiled."""
    compile(type("M", (Decay,), body)())


def inequality_in_a_matrix(repaired):
    class M(Pendulum):
        mass = Body(m=1, I=[[1 if repaired else time > 1, 0, 0], [0, 1, 0], [0, 0, 1]])

    compile(M())


def inequality_in_a_default(repaired):
    class M(Decay):
        a: Scalar = parameter("a", default=1)
        k: Vector3 = parameter("k", default=(a if repaired else a > 1, 0, 0))

    compile(M())


def inequality_by_path(repaired):
    simulate(Pendulum(), stop_time=0.1, parameters={"mass.r_CM": (0.1 if repaired else time > 1, 0, 0)})


def inequality_in_an_axis(repaired):
    class M(Pendulum):
        hinge = Revolute(n=(0, 0, 1 if repaired else time > 1), phi=fixed(0.1), w=fixed(0))

    compile(M())


def text_beside_a_parameter(repaired):
    class M(Decay):
        a: Scalar = parameter("a", default=1)
        k: Vector3 = parameter("k", default=(a, a if repaired else "a", 0))

    compile(M())


def none_beside_a_parameter(repaired):
    class M(Decay):
        a: Scalar = parameter("a", default=1)
        k: Vector3 = parameter("k", default=lambda s: (s.a, 0 if repaired else None, 0))

    compile(M())


def text_among_numbers(repaired):
    built(k=parameter("k", shape=(3,), default=(1, 2 if repaired else "b", 0)))


def ragged_matrix(repaired):
    class M(Decay):
        k: Matrix33 = parameter("k", default=((1, 0, 0), (0, 1, 0) if repaired else (0, 1), (0, 0, 1)))

    compile(M())


def ragged_matrix_with_a_parameter(repaired):
    class M(Decay):
        a: Scalar = parameter("a", default=1)
        k: Matrix33 = parameter("k", default=((a, 0, 0), (0, 1, 0) if repaired else (0, 1), (0, 0, 1)))

    compile(M())


def array_with_a_none(repaired):
    compile(Pendulum(mass=Body(m=1, r_CM=np.array([0, 1, 0 if repaired else None]))))


def start_of_text(repaired):
    class M(Pendulum):
        hinge = Revolute(phi=fixed(0.1 if repaired else "0.1"), w=fixed(0))

    compile(M())


def start_of_a_switch(repaired):
    class M(Pendulum):
        hinge = Revolute(phi=fixed(0.1 if repaired else True), w=fixed(0))

    compile(M())


def ragged_start(repaired):
    class M(Decay):
        y: Vector3 = variable("y", start=(1, 2, 3) if repaired else ((1, 2), 3), fixed=True)

        def more(self):
            yield der(self.y) == -self.y

    compile(M())


def start_of_a_wrong_size(repaired):
    class M(Decay):
        y: Scalar = variable("y", start=1.5 if repaired else (1, 5), fixed=True)

        def more(self):
            yield der(self.y) == -self.y

    compile(M())


def discrete_start_of_a_condition(repaired):
    class M(Decay):
        d: Scalar = discrete("mode", start=1 if repaired else time > 1)

    compile(M())


def nominal_of_a_part_below_zero(repaired):
    class M(Pendulum):
        hinge = Revolute(phi=fixed(0.1, nominal=0.1 if repaired else -0.1), w=fixed(0))

    compile(M())


def nominal_that_changes(repaired):
    class M(Decay):
        a: Scalar = parameter("a", default=1)
        y: Scalar = variable("y", nominal=a if repaired else time)

        def more(self):
            yield self.y == 2 * self.x

    compile(M())


def nominal_from_a_variable(repaired):
    class M(Decay):
        y: Scalar = variable("y", nominal=lambda s: s.p if repaired else s.x)

        def more(self):
            yield self.y == 2 * self.x

    compile(M())


def input_that_follows_time(repaired):
    class M(Model):
        rotor = Rotor(tau=time)

    simulate(M() if repaired else Rotor(tau=time), stop_time=0.1)


def input_of_two_numbers(repaired):
    simulate(Rotor(tau=1.5 if repaired else (1, 5)), stop_time=0.1)


def input_by_path_of_text(repaired):
    simulate(Rotor(), stop_time=0.1, parameters={"tau": 1.5 if repaired else "1,5"})


def stop_time_without_name(repaired):
    _ = simulate(Decay(), stop_time=1) if repaired else simulate(Decay(), 1)


def stop_time_of_other_tools(repaired):
    simulate(Decay(), **{"stop_time" if repaired else "t_end": 1})


def parameter_as_an_argument(repaired):
    _ = simulate(Decay(), stop_time=1, parameters={"p": 3}) if repaired else simulate(Decay(), stop_time=1, p=3)


def simulate_without_a_model(repaired):
    simulate(*[Decay()] * repaired, stop_time=1)


def parameter_of_compile(repaired):
    _ = compile(Decay(), parameters={"p": 1}) if repaired else compile(Decay(), p=1)


def linearize_with_positions(repaired):
    _ = linearize(Decay(), time=0) if repaired else linearize(Decay(), 0)


def study_with_a_slip(repaired):
    """The name of the argument is all that is wrong: repaired, nothing needs to be run."""
    if not repaired:
        study(Decay(), stop_tme=1)


def file_of_a_plot(repaired):
    result = simulate(Decay(), stop_time=0.1)
    _ = result.series("x") if repaired else result.plot("x", file="x.png")


def value_beside_the_base(repaired):
    if repaired:

        class N(Decay):
            k: Scalar = parameter("stiffness", default=1)
    else:

        class M(Decay, k=1):
            pass


def setting_beside_the_base(repaired):
    if repaired:

        class N(Decay):
            stop_time = 3
    else:

        class M(Decay, stop_time=3):
            pass


def part_with_brackets(repaired):
    def rotor(self):
        return Body(m=1)

    _ = part(rotor) if repaired else part()(rotor)


def parts_with_brackets(repaired):
    def links(self):
        return [Body(m=1)]

    _ = parts(links) if repaired else parts()(links)


def observed_with_a_unit(repaired):
    def energy(self):
        return self.x**2

    _ = observed(energy) if repaired else observed(unit="J")(energy)


def part_with_a_text(repaired):
    def rotor(self):
        """The rotor."""
        return Body(m=1)

    _ = part(rotor) if repaired else part("the rotor")(rotor)


def part_that_yields(repaired):
    def mass(self):
        yield Body(m=1)

    built(mass=part((lambda self: None) if repaired else mass))


def port_that_yields(repaired):
    def end(self):
        yield Frame()

    built(end=port((lambda self: None) if repaired else end))


def observed_that_yields(repaired):
    def double(self):
        yield 2 * self.x

    built(double=observed((lambda self: 2 * self.x) if repaired else double))


def list_from_a_part(repaired):
    class M(Pendulum):
        @part
        def mass(self):
            return Body(m=1) if repaired else [Body(m=1)]

    compile(M())


def whole_number_as_a_type(repaired):
    class M(Decay):
        n: int = structural("count", default=1) if repaired else parameter("count", default=1)

    compile(M())


def text_as_a_type(repaired):
    class M(Decay):
        kind: str = structural("kind", default="a") if repaired else input("kind")

    compile(M())


def array_as_a_type(repaired):
    class M(Decay):
        k: np.ndarray = parameter("k", default=(1, 2), shape=(2,) if repaired else None)

    compile(M())


def component_as_a_type(repaired):
    class M(Decay):
        end: Frame = port(Frame, "end") if repaired else variable("end")

    _ = M


def unknown_type(repaired):
    class M(Decay):
        k: "Vector3" if repaired else "Vector" = parameter("k", default=(0, 0, 1))  # noqa: F821

    compile(M())


def float_with_a_shape(repaired):
    class M(Decay):
        k: float = parameter("k", default=1 if repaired else (1, 2), shape=None if repaired else (2,))

    compile(M())


def blank_unit(repaired):
    built(k=parameter("k", default=1, unit="1" if repaired else " "))


def padded_unit(repaired):
    built(k=parameter("k", default=1, unit="m" if repaired else " m"))


def padded_unit_of_an_entry(repaired):
    built(k=parameter("k", default=(1, 2), shape=(2,), unit=("m", "rad" if repaired else "rad ")))


def quantity_of_a_blank_unit(repaired):
    class M(Decay):
        k: Scalar = variable("k", unit="m")

        def more(self):
            yield self.k == quantity(1, "m" if repaired else " ")

    ac.compile(M())


def decimal_comma_in_a_default(repaired):
    built(k=parameter("k", default=1.5 if repaired else "1,5"))


def decimal_comma_of_a_compiled_model(repaired):
    compiled = compile(Pendulum())
    simulate(compiled, stop_time=0.1, parameters={"mass.m": 1.5 if repaired else (1, 5)})


def symbol_in_a_compiled_model(repaired):
    compiled = compile(Pendulum())
    simulate(compiled, stop_time=0.1, parameters={"bar.r": (1 if repaired else time, 0, 0)})


def start_for_a_parameter_by_a_default(repaired):
    built(k=parameter("k", default=lambda s: 1 if repaired else fixed(1)))


def function_for_a_mass(repaired):
    compile(Pendulum(mass=Body(m=1 if repaired else lambda s: 1)))


def bound_for_positive(repaired):
    built(k=parameter("k", default=1, positive=True if repaired else 0.5))


def property_of_a_part(repaired):
    made = part(lambda self: None)
    built(mass=made if repaired else property(made))


def static_part(repaired):
    def mass():
        return Body(m=1)

    built(mass=part((lambda self: None) if repaired else staticmethod(mass)))


def colon_for_a_part(repaired):
    if repaired:

        class N(Decay):
            mass = rotational.Inertia(J=1, phi=fixed(0), w=fixed(0))

        compile(N())
        return

    class M(Decay):
        mass: rotational.Inertia(J=1)

    compile(M())


def type_with_a_value(repaired):
    class M(Decay):
        k: Scalar = parameter("k", default=3) if repaired else Scalar(3)

    _ = M


def shape_as_a_type(repaired):
    class M(Decay):
        k: Vector3 if repaired else (3,) = parameter("k", default=(1, 2, 3))

    compile(M())


def unit_as_a_type(repaired):
    class M(Decay):
        k: Scalar if repaired else "m/s" = parameter("k", default=1, unit="m/s")  # noqa: F821

    compile(M())


def switch_of_no_formulation(repaired):
    with_and_without(*[Formulation("fine", {})] * repaired, stiffened="beam.geometric_stiffness")


def fixed_around_each_entry(repaired):
    class M(Decay):
        body = Body(m=1, v_0=fixed((0, 0, 1)) if repaired else (fixed(0), fixed(0), fixed(1)))

    _ = M


def time_of_a_linearization(repaired):
    linearize(Decay(), **{"time" if repaired else "at": 0})
