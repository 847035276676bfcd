"""Saturations in the feedback of an acceleration: strictly monotone, so that there is one solution at any time."""

from __future__ import annotations

from acausal import Expr, Model, Scalar, der, output, parameter, piecewise, sin, time, variable


def limited(y: Expr, most: float | Expr) -> Expr:
    """What a saturation lets through."""
    return piecewise((most, y > most), (-most, y < -most), y)


class Saturated(Model):
    """m a = sat(6 sin 5 t - k a): between the limits a = 6 sin(5 t) / (m + k), where the input is less than 2 + k 2 / m."""

    m: Scalar = parameter("mass", default=0.5)
    k: Scalar = parameter("feedback, more than the mass", default=0.8)
    v: Scalar = variable("speed", start=0, fixed=True)
    a: Scalar = variable("acceleration")
    y: Scalar = variable("what is limited")

    def given(self) -> Expr | float:
        return 6 * sin(5 * time)

    def equations(self):
        yield self.a == der(self.v)
        yield self.y == self.given() - self.k * self.a
        yield self.m * self.a == limited(self.y, 2)


class Stepped(Saturated):
    """The input steps from 6 to 0 at 0.5 s: from one limit to between them."""

    def given(self):
        return piecewise((6, time < 0.5), 0)


class Turned(Saturated):
    """With k = -1.2 and m = 1, which is not monotone, the step from -6 to 2 leads from the lower limit to the upper one."""

    acceleration: Scalar = output("acceleration")

    def given(self):
        return piecewise((-6, time < 0.5), 2)

    def equations(self):
        yield from super().equations()
        yield self.acceleration == self.a


class Row(Model):
    """Three of them, each of which also feels a little of the one before; the input steps to 0."""

    level: Scalar = parameter("input before", default=6.0)
    v: Scalar = variable("speed", start=0, fixed=True)
    a: Scalar = output("first acceleration")
    b: Scalar = output("second acceleration")
    c: Scalar = output("third acceleration")

    def equations(self):
        given = piecewise((self.level, time < 0.5), 0)
        yield der(self.v) == self.a
        yield 0.5 * self.a == limited(given - 0.8 * self.a, 2)
        yield 0.5 * self.b == limited(given + 0.1 * self.a - 0.8 * self.b, 2)
        yield 0.5 * self.c == limited(given + 0.1 * self.b - 0.8 * self.c, 2)
