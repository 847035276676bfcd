"""A point on a circle in coordinates of the plane: one constraint on two of them, and at the level of their rates."""

from __future__ import annotations

from functools import cache

import numpy as np

import acausal as ac
from acausal import Model, Scalar, der, parameter, variable
from acausal.solve.point import Point
from acausal.solve.problem import Problem

NAMES = ("x", "y", "u", "v")


class Circle(Model):
    """Radius 1; a spring k x along x."""

    k: Scalar = parameter("spring", default=0.0)
    x: Scalar = variable("x")
    y: Scalar = variable("y")
    u: Scalar = variable("rate of x")
    v: Scalar = variable("rate of y")
    force: Scalar = variable("force towards the centre over the mass")

    def equations(self):
        yield der(self.x) == self.u
        yield der(self.y) == self.v
        yield der(self.u) == -self.force * self.x - self.k * self.x
        yield der(self.v) == -self.force * self.y
        yield self.x**2 + self.y**2 == 1


@cache
def compiled() -> ac.CompiledModel:
    return ac.compile(Circle(k=1.0))


def problem(k: float = 0.0) -> Problem:
    return Problem(compiled(), compiled().parameter_values({"k": k}))


def states(x: float, y: float, u: float = 0.0, v: float = 0.0) -> np.ndarray:
    """Return the states, in the order of the compiled model, of a point of the plane with its velocity."""
    value = dict(zip(NAMES, (x, y, u, v), strict=True))
    return np.array([value[name] for name in compiled().states], dtype=float)


def plane(at: np.ndarray) -> list[float]:
    """Return x, y and their rates from the states."""
    return [float(at[compiled().states.index(name)]) for name in NAMES]


def point(x: float, y: float, u: float = 0.0, v: float = 0.0) -> Point:
    constants = compiled().layout.begin(np.zeros(0), 1.0)
    return Point(0.0, states(x, y, u, v), np.zeros(compiled().nz), constants)
