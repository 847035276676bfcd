"""What a class declares: constructors, names, fields, units, parts."""

from dataclasses import dataclass

import acausal as ac
from acausal import (
    Component,
    Model,
    Scalar,
    Vector3,
    chain,
    connect,
    der,
    discrete,
    effect,
    fixed,
    flow,
    guess,
    observed,
    output,
    parameter,
    part,
    parts,
    port,
    ports,
    quantity,
    structural,
    variable,
)
from components import Body, FixedTranslation, Frame, Revolute, World, rotational
from tests.errors.broken.models import Decay, Pendulum


def built(**body):
    """A model with what is given, compiled."""
    ac.compile(type("M", (Decay,), body)())


def constructor_without_super(repaired):
    class Gain(Component):
        k: Scalar = parameter("gain", default=1)

        def __init__(self, k):
            if repaired:
                super().__init__(k=k)

    class M(Decay):
        gain = Gain(2)

    ac.compile(M())


def constructor_that_keeps_the_number(repaired):
    class M(Decay):
        k: Scalar = parameter("gain", default=1)

        def __init__(self, k):
            if repaired:
                super().__init__(k=k)
            else:
                self.k = k

    ac.compile(M(2))


def post_init(repaired):
    class M(Decay):
        if repaired:

            def check(self):
                self._seen = True
        else:

            def __post_init__(self):
                self._seen = True

    ac.compile(M())


def dataclass_decorator(repaired):
    class M(Decay):
        k: Scalar = parameter("gain", default=1)

    ac.compile((M if repaired else dataclass(M))())


def value_without_name(repaired):
    Body(m=1.0) if repaired else Body(1.0)


def start_without_name(repaired):
    Revolute(phi=fixed(0.1)) if repaired else Revolute(fixed(0.1))


def dict_of_values(repaired):
    values = {"m": 1.0}
    Body(**values) if repaired else Body(values)


def number_for_a_model(repaired):
    Pendulum() if repaired else Pendulum(3)


def fields_as_a_name(repaired):
    built(**{"fields_" if repaired else "fields": parameter("number of fields", default=1)})


def check_as_a_name(repaired):
    class M(Decay):
        if repaired:
            checked: Scalar = parameter("checked", default=1)
        else:
            check: Scalar = parameter("checked", default=1)

    ac.compile(M())


def private_name_of_the_engine(repaired):
    built(**{"_way" if repaired else "_path": 3})


def list_for_a_method(repaired):
    class M(Pendulum):
        if not repaired:
            connections = []

    ac.compile(M())


def method_with_an_argument(repaired):
    class M(Decay):
        if repaired:

            def check(self):
                pass
        else:

            def check(self, t):
                pass

    ac.compile(M())


def method_as_a_property(repaired):
    class M(Decay):
        if not repaired:

            @property
            def stored_energy(self):
                return self.x

    ac.compile(M())


def name_written_twice(repaired):
    if repaired:

        class M(Decay):
            a: Scalar = parameter("a", default=1)
            b: Scalar = parameter("b", default=2)
    else:

        class M(Decay):
            a: Scalar = parameter("a", default=1)
            a: Scalar = parameter("b", default=2)

    ac.compile(M())


def variable_without_brackets(repaired):
    class M(Decay):
        z: Scalar = parameter("z", default=1) if repaired else parameter

    ac.compile(M())


def type_without_a_field(repaired):
    if repaired:

        class M(Decay):
            z: Scalar = parameter("z", default=1)
    else:

        class M(Decay):
            z: Scalar

    ac.compile(M())


def number_with_a_type(repaired):
    class M(Decay):
        z: Scalar = parameter("z", default=3.0) if repaired else 3.0

    ac.compile(M())


def start_of_an_output(repaired):
    built(v0=parameter("v", default=1) if repaired else output("v", start=1))


def start_of_a_parameter(repaired):
    built(k=parameter("k", default=1) if repaired else parameter("k", start=1))


def unit_without_name(repaired):
    built(k=parameter("k", unit="m", default=1) if repaired else parameter("k", "m"))


def bound_that_does_not_exist(repaired):
    built(k=parameter("k", default=1, minimum=0) if repaired else parameter("k", default=1, maximum=3))


def field_without_words(repaired):
    built(k=parameter("gain", default=3) if repaired else parameter(3))


def fixed_in_a_declaration(repaired):
    class M(Model):
        x: Scalar = variable("x", start=1, fixed=True) if repaired else variable("x", start=fixed(1))

        def equations(self):
            yield der(self.x) == -self.x

    ac.compile(M())


def guess_in_a_declaration(repaired):
    built(d=discrete("d", start=1) if repaired else discrete("d", start=guess(1)))


def value_for_fixed(repaired):
    class M(Model):
        x: Scalar = variable("x", start=3, fixed=True) if repaired else variable("x", fixed=3)

        def equations(self):
            yield der(self.x) == -self.x

    ac.compile(M())


def fixed_for_a_parameter(repaired):
    built(k=parameter("k", default=1 if repaired else fixed(1)))


def text_for_a_parameter(repaired):
    built(k=structural("k", default="one") if repaired else parameter("k", default="one"))


def minimum_of_text(repaired):
    built(k=parameter("k", default=1, minimum=0 if repaired else "0"))


def shape_without_brackets(repaired):
    built(k=parameter("k", shape=(3,) if repaired else 3, default=(1, 2, 3)))


def shape_of_a_field(repaired):
    class M(Decay):
        n: int = structural("number", default=3)
        k = parameter("k", shape=(lambda s: (s.n,)) if repaired else (n,), default=lambda s: (1,) * s.n)

    ac.compile(M())


def shape_against_the_type(repaired):
    class M(Decay):
        k: Vector3 = parameter("k", shape=None if repaired else (2,), default=(1, 2, 3))

    ac.compile(M())


def negative_nominal(repaired):
    built(d=variable("d", nominal=1 if repaired else -1), more=lambda self: iter([self.d == self.x]))


def choices_without_brackets(repaired):
    built(kind=structural("kind", default="a", choices=("a", "b") if repaired else "ab"))


def default_not_among_choices(repaired):
    built(kind=effect("kind", default=True if repaired else "on"))


def flow_outside_a_connector(repaired):
    built(d=variable("d") if repaired else flow("d"), more=lambda self: iter([self.d == self.x]))


def unknown_unit(repaired):
    built(k=parameter("k", unit="N" if repaired else "foo", default=1))


def unit_of_a_number(repaired):
    built(k=parameter("k", unit="1" if repaired else 3, default=1))


def malformed_unit(repaired):
    built(k=parameter("k", unit="kg.m/s2" if repaired else "kg.m/s^2^3", default=1))


def too_few_units(repaired):
    built(k=parameter("k", unit="m" if repaired else ("m", "m"), shape=(3,), default=(1, 2, 3)))


def value_of_another_unit(repaired):
    class M(Pendulum):
        mass = Body(m=quantity(1, "kg" if repaired else "m"))

    ac.compile(M())


def quantity_the_wrong_way_round(repaired):
    quantity(1, "kg") if repaired else quantity("kg", 1)


def quantity_by_path(repaired):
    ac.compile(Pendulum(), parameters={"mass.m": quantity(2, "kg" if repaired else "m")})


def one_part_for_several(repaired):
    class M(Decay):
        @parts
        def links(self):
            return [Body()] if False else ([] if repaired else rotational.Inertia(J=1))

    ac.compile(M())


def numbers_for_parts(repaired):
    class M(Decay):
        @parts
        def links(self):
            return [] if repaired else [1, 2]

    ac.compile(M())


def class_for_a_part(repaired):
    class M(Decay):
        @part
        def rotor(self):
            return rotational.Inertia(J=1, phi=fixed(0), w=fixed(0)) if repaired else rotational.Inertia

    ac.compile(M())


def part_that_is_not_returned(repaired):
    class M(Decay):
        @part
        def rotor(self):
            if repaired:
                return rotational.Inertia(J=1, phi=fixed(0), w=fixed(0))
            rotational.Inertia(J=1)

    class N(Decay):
        @part
        def rotor(self):
            rotational.Inertia(J=1)

    ac.compile(M() if repaired else N())


def part_with_an_argument(repaired):
    class M(Decay):
        if repaired:

            @part
            def rotor(self):
                return None
        else:

            @part
            def rotor(self, n):
                return None

    ac.compile(M())


def port_of_a_part(repaired):
    class Shaft(Component):
        end = port(rotational.Flange if repaired else rotational.Inertia)


def observed_text(repaired):
    built(e=observed((lambda self: 2 * self.x) if repaired else "2 x"))


class Plate(Component):
    """A massless body with two frames that are named by what it is given."""

    names = structural("names of its frames", default=("hinge", "tip"))

    @ports
    def frames(self):
        """Frames by their names."""
        return {name: Frame() for name in self.names}

    @part
    def arm(self):
        return FixedTranslation(r=(1, 0, 0))

    def connections(self):
        yield from (
            connect(a, b) for a, b in zip(self.frames.values(), (self.arm.frame_a, self.arm.frame_b), strict=True)
        )


def hung(plate, connections):
    """A plate that hangs at a hinge, with a body at its other frame."""

    class M(Model):
        world, hinge, mass = World(), Revolute(phi=fixed(0.1), w=fixed(0)), Body(m=1)
        board = plate

    M.connections = connections
    ac.compile(M())


def unknown_port_of_a_family(repaired):
    def connections(self):
        yield chain(self.world, self.hinge, self.board.hinge)
        yield connect(self.board.tip if repaired else self.board.edge, self.mass.frame_a)

    hung(Plate(), connections)


def misspelled_port_of_a_family(repaired):
    def connections(self):
        yield chain(self.world, self.hinge, self.board.hinge if repaired else self.board.hinges)
        yield connect(self.board.tip, self.mass.frame_a)

    hung(Plate(), connections)


def ends_of_a_family(repaired):
    def connections(self):
        if repaired:
            yield chain(self.world, self.hinge, self.board.hinge)
            yield chain(self.board.tip, self.mass)
        else:
            yield chain(self.world, self.hinge, self.board, self.mass)

    hung(Plate(), connections)


def held(plate):
    def connections(self):
        first, second = self.board.frames.values()
        yield chain(self.world, self.hinge, first)
        yield connect(second, self.mass.frame_a)

    hung(plate, connections)


def port_named_as_a_field(repaired):
    held(Plate(names=("hinge", "plate" if repaired else "names")))


def port_named_as_a_method(repaired):
    held(Plate(names=("hinge", "checked" if repaired else "check")))


def port_that_is_no_name(repaired):
    held(Plate(names=("hinge", "tip_1" if repaired else "tip-1")))


def list_for_a_family(repaired):
    class Board(Plate):
        def frames(self):
            return {name: Frame() for name in self.names} if repaired else [Frame() for _ in self.names]

    held(Board())


def part_in_a_family(repaired):
    class Board(Plate):
        def frames(self):
            return {name: Frame() if repaired else Body(m=1) for name in self.names}

    held(Board())


def class_in_a_family(repaired):
    class Board(Plate):
        def frames(self):
            return {name: Frame() if repaired else Frame for name in self.names}

    held(Board())


def generator_for_a_family(repaired):
    class Board(Plate):
        if repaired:

            @ports
            def frames(self):
                return {name: Frame() for name in self.names}

        else:

            @ports
            def frames(self):
                yield "tip", Frame()

    held(Board())


def value_for_a_family(repaired):
    held(Plate() if repaired else Plate(frames={"hinge": Frame(), "tip": Frame()}))


def family_before_it_is_made(repaired):
    class Board(Decay):
        world = World()

        @part
        def arm(self):
            return FixedTranslation(r=(1, 0, 0) if repaired else self.tip.r_0)

        @ports
        def frames(self):
            return {"tip": Frame()}

        def connections(self):
            yield chain(self.world, self.arm, self.tip)

    ac.compile(Board())
