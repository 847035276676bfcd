"""A small bound model with known values: entry (i, j) of a variable is a given function of time."""

import casadi as ca
import numpy as np

from acausal import (
    Component,
    Matrix33,
    Model,
    Scalar,
    as_expr,
    der,
    observed,
    output,
    parameter,
    part,
    parts,
    structural,
    variable,
)
from acausal.flatten import flatten
from acausal.result import Result

TIME = np.linspace(0.0, 1.0, 5)


class Piece(Component):
    k: Scalar = parameter("stiffness", unit="N/m", default=3.0)
    q = variable("coordinates", shape=(3,), unit=("m", "m", "rad"))
    T: Matrix33 = variable("matrix", unit="1")
    single = variable("an array of one entry", shape=(1,), unit="m")

    def equations(self):
        yield der(self.q) == as_expr((0.0, 0.0, 0.0))
        yield der(self.T) == as_expr(np.zeros((3, 3)))
        yield der(self.single[0]) == 0

    @observed
    def twice(self):
        """Twice the coordinates."""
        return as_expr((2 * self.q[0], 2 * self.q[1]))


class Demo(Model):
    """Two pieces."""

    n: int = structural("number of pieces", default=2)
    x: Scalar = output("position", unit="m")
    angle: Scalar = output("angle", unit="rad")
    place = output("point", shape=(2,), unit="m")

    @parts
    def piece(self):
        """Pieces."""
        return [Piece(k=2.0 + i) for i in range(self.n)]

    @part
    def left_out(self):
        """Nothing."""

    def equations(self):
        yield self.x == self.piece[0].q[0]
        yield self.angle == self.piece[0].q[2]
        yield self.place == self.piece[1].q[:2]


def value_of(symbol: str) -> np.ndarray:
    """Course over TIME that the fake engine gives to a scalar symbol, different for every name."""
    return np.sin(TIME * (1 + sum(k * ord(c) for k, c in enumerate(symbol, 1)) % 1009)) / 3 + 1


class Engine:
    """Evaluates expressions as the engine would, and counts the calls."""

    def __init__(self) -> None:
        self.calls = 0

    def __call__(self, column: ca.SX) -> np.ndarray:
        self.calls += 1
        symbols = ca.symvar(column)
        values = np.array([value_of(s.name()) for s in symbols]).reshape(len(symbols), TIME.size)
        function = ca.Function("fake", [ca.vertcat(*symbols)], [column])
        return np.array([np.array(function(row)).ravel() for row in values.T])


def demo(**values) -> Result:
    tree = flatten(Demo(**values)).tree
    return Result(TIME, Engine(), tree, ("x", "angle", "place"), {"steps": 3}, "Demo")
