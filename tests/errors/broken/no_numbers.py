"""Start values that are no numbers."""

import acausal as ac
from acausal import (
    Model,
    Scalar,
    Vector3,
    der,
    discrete,
    exp,
    log,
    parameter,
    piecewise,
    reinit,
    sqrt,
    time,
    variable,
    when,
)
from tests.errors.broken.models import Decay

NAN = float("nan")


def instant_that_is_nan(repaired):
    class M(Decay):
        due: Scalar = discrete("next", start=0.05 if repaired else NAN)

        def more(self):
            yield when(time >= self.due, reinit(self.due, self.due + 0.1))

    ac.simulate(M(), stop_time=0.1)


def limit_that_is_nan(repaired):
    class M(Model):
        x: Scalar = variable("x", start=1, fixed=True)
        limit: Scalar = discrete("limit", start=0.99 if repaired else NAN)

        def equations(self):
            yield der(self.x) == piecewise((-self.x, self.x > self.limit), 0)
            yield when(time >= 0.05, reinit(self.limit, 0.5))

    ac.simulate(M(), stop_time=0.1)


def gain_that_is_nan(repaired):
    class M(Model):
        x: Scalar = variable("x", start=1, fixed=True)
        gain: Scalar = discrete("gain", start=1 if repaired else NAN)

        def equations(self):
            yield der(self.x) == -self.gain * self.x

    ac.simulate(M(), stop_time=0.1)


def entry_that_is_nan(repaired):
    class M(Decay):
        corner: Vector3 = discrete("corner", start=(0, 2, 3 if repaired else NAN))

        def more(self):
            yield when(self.x > self.corner[2], reinit(self.x, 0))

    ac.simulate(M(), stop_time=0.1)


class Part(Decay):
    """A discrete variable that starts at the root of a parameter."""

    limit: Scalar = discrete("limit", start=sqrt(Decay.p))

    def more(self):
        yield when(self.x > self.limit, reinit(self.x, 0))


def limit_in_a_part(repaired):
    class M(Model):
        part = Part(p=2 if repaired else -2)

    ac.simulate(M(), stop_time=0.1)


def start_of_a_state_without_value(repaired):
    class M(Decay):
        z: Scalar = variable("z", start=log(Decay.p), fixed=True)

        def more(self):
            yield der(self.z) == self.x

    ac.simulate(M(p=2 if repaired else -1), stop_time=0.1)


def guess_without_value(repaired):
    class M(Decay):
        z: Scalar = variable("z", start=sqrt(Decay.p))
        q: Scalar = parameter("q", default=1)

        def more(self):
            yield self.z + exp(self.z) == self.q * self.x

    ac.simulate(ac.compile(M()), parameters={"p": 1 if repaired else -1}, stop_time=0.1)
