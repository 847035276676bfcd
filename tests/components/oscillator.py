"""A mass on a spring that is an FMU."""

from __future__ import annotations

from acausal import Model, Scalar, der, input, output, parameter, quantity, variable
from components.fmu import FMU


class Spring(Model):
    """Force of a spring, from the speed of its end."""

    k: Scalar = parameter("stiffness", unit="N/m", default=100)
    v: Scalar = input("speed", unit="m/s")
    F: Scalar = output("force", unit="N")
    s: Scalar = variable("stretch", unit="m", start=0.1, fixed=True)

    def equations(self):
        yield der(self.s) == self.v
        yield self.k * self.s == self.F


def oscillator(path, **values):
    """A mass on that spring."""

    class Oscillator(Model):
        spring = FMU(path, **values)
        x: Scalar = variable("place", unit="m", start=0.1, fixed=True)
        v: Scalar = variable("speed", unit="m/s", start=0, fixed=True)

        def equations(self):
            yield der(self.x) == self.v
            yield quantity(1, "kg") * der(self.v) == -self.spring.F
            yield self.spring.v == self.v

    return Oscillator()
