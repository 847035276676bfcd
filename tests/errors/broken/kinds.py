"""Fields of another kind than the equations take them for, and parts replaced by classes."""

import acausal as ac
from acausal import Component, Model, Scalar, der, discrete, parameter, reinit, structural, time, variable, when
from components import Body, rotational
from tests.errors.broken.models import Decay, Pendulum


def variable_replaced_by_a_parameter(repaired):
    class M(Decay):
        x: Scalar = variable("x", start=1, fixed=True) if repaired else parameter("x", default=1)

    ac.compile(M())


def variable_replaced_by_a_structural_parameter(repaired):
    class M(Decay):
        x: Scalar = variable("x", start=1, fixed=True) if repaired else structural("x", default=1)

    ac.compile(M())


def parameter_replaced_by_a_variable(repaired):
    class M(Model):
        part = rotational.Inertia(J=1) if repaired else Loose()

    ac.compile(M())


class Loose(rotational.Inertia):
    """An inertia whose J is an unknown."""

    J: Scalar = variable("moment of inertia", unit="kg.m2")


def parameter_declared_in_init(repaired):
    class M(Decay):
        k: Scalar = parameter("k", default=1)

        def __init__(self, **values):
            super().__init__(**values)
            if not repaired:
                self.q = parameter("q", default=1)

    ac.compile(M())


def variable_declared_in_init(repaired):
    class M(Decay):
        def __init__(self, **values):
            if not repaired:
                self.y = variable("y")
            super().__init__(**values)

    ac.compile(M())


def part_replaced_by_its_class(repaired):
    class M(Pendulum):
        mass = Body(m=1) if repaired else Body

    ac.compile(M())


def part_replaced_by_another_class(repaired):
    class M(Pendulum):
        mass = Body(m=1) if repaired else dict

    ac.compile(M())


def part_given_as_a_class(repaired):
    ac.compile(Pendulum(mass=Body(m=1) if repaired else Body))


class Counting(Decay):
    n: Scalar = discrete("n", start=0)


def discrete_variable_by_an_equation(repaired):
    class M(Counting):
        def more(self):
            yield when(self.x < 0.5, reinit(self.n, 2)) if repaired else self.n == 2 * self.x

    ac.compile(M())


def discrete_variable_by_a_number(repaired):
    class M(Counting):
        def more(self):
            yield when(self.x < 0.5, reinit(self.n, 2)) if repaired else self.n == 2

    ac.compile(M())


def discrete_variable_of_a_part(repaired):
    class Part(Component):
        n: Scalar = discrete("n", start=0)

        def equations(self):
            if repaired:
                yield when(time > 1, reinit(self.n, 2))

    class M(Model):
        part = Part()
        x: Scalar = variable("x", start=1, fixed=True)

        def equations(self):
            yield der(self.x) == self.part.n
            if not repaired:
                yield self.part.n == 2 * time

    ac.compile(M())
