"""Functions that are called at events: alone in a statement, and once or several times at an instant."""

from __future__ import annotations

import acausal as ac
from acausal import Model, Scalar, call, discrete, structural, time, variable, when


class Counting(Model):
    """A function counts its instants, and sets the next."""

    n: Scalar = discrete("instants", start=0)
    next: Scalar = discrete("next instant", unit="s", start=time)
    y: Scalar = variable("count")

    def equations(self):
        yield self.y == self.n
        yield when(time >= self.next, call(lambda t, n: (n + 1, t + 0.3), [self.n], [self.n, self.next]), at_start=True)


def test_a_call_needs_no_reinit_beside_it():
    assert ac.simulate(Counting(), stop_time=1)["y"][-1] == 4


class Next:
    """Returns the next number, without a memory."""

    pure = True

    def __call__(self, time, x):
        return x + 1


class Cascade(Model):
    """A call and a jump after it let each other happen, at one instant, until the jumps end."""

    a: Scalar = discrete("jumps", start=0)
    b: Scalar = discrete("jumps that were met by a call", start=-1)
    y: Scalar = variable("calls")
    function: object = structural("function", cls=object)

    def equations(self):
        yield self.y == self.b + 1
        yield when((time >= 0.5) & (self.a - self.b > 0.5), call(self.function, [self.b], [self.b]))
        yield when((self.b - self.a > -0.5) & (self.a < 3), ac.reinit(self.a, self.a + 1))


def test_a_pure_function_is_called_in_each_iteration():
    assert ac.simulate(Cascade(function=Next()), stop_time=1)["y"][-1] == 4
    assert ac.simulate(Cascade(function=lambda t, x: x + 1), stop_time=1)["y"][-1] == 1
