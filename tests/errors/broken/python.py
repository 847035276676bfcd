"""Python and NumPy on symbols."""

import math

import casadi as ca
import numpy as np

import acausal as ac
from acausal import Scalar, dot, piecewise, sin, variable
from tests.errors.broken.models import Decay


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
