"""Equations that do not determine the variables, or cannot be read."""

import acausal as ac
from acausal import Model, Scalar, Vector3, der, output, parameter, sin, time, variable
from tests.errors.broken.models import Decay, Rotor


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


def torque_law(repaired):
    class M(Rotor):
        def law(self):
            return self.tau if repaired else (0, 0, time)

    ac.compile(M())


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
