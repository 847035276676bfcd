"""A model of a module that can be imported."""

from __future__ import annotations

from acausal import (
    Component,
    Model,
    Scalar,
    der,
    input,
    observed,
    output,
    parameter,
    part,
    parts,
    structural,
    variable,
)


class Tank(Component):
    """A tank that empties."""

    k: Scalar = parameter("rate", unit="1/s", default=1.0)
    h = variable("levels", shape=(2,), unit=("m", "rad"), start=1.0, fixed=True)
    matrix = variable("all of them", shape=(2, 3), unit="m")
    u: Scalar = input("inflow")

    def equations(self):
        yield der(self.h) == (-self.k * self.h[0] + self.u, -2 * self.k * self.h[1])
        for i in range(2):
            for j in range(3):
                yield self.matrix[i, j] == (i + 10 * j) * self.h[0]

    @observed
    def twice(self):
        """Twice the level."""
        return 2 * self.h[0]


class Plant(Model):
    """Two tanks."""

    n: int = structural("number of tanks", default=2)
    x: Scalar = output("level", unit="m")
    spare = parameter("a vector", shape=(3,), unit="kg", default=(1, 0, 3))
    inflow: Scalar = parameter("flow", default=0.0)

    @parts
    def tank(self):
        """Tanks."""
        return [Tank(k=1.0 + i, u=self.inflow if i else 0.0) for i in range(self.n)]

    @part
    def none(self):
        """Nothing."""

    def equations(self):
        yield self.x == self.tank[0].h[0]
