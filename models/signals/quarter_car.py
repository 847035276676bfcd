"""QuarterCar: a quarter of a car over a measured road."""

from __future__ import annotations

import numpy as np

from acausal import Model, Scalar, Table, connect, fixed, input, output, parameter, quantity, structural, table, time
from components import translational


def rough(length: float, rows: int, seed: int = 1) -> Table:
    """Return a random walk of the slope, with about the roughness of a country road, as a periodic profile."""
    noise = np.random.default_rng(seed).normal(0, 1, rows)
    height = np.convolve(np.cumsum(noise - noise.mean()), np.ones(5) / 5, "same")
    return Table(np.linspace(0, length, rows), 2e-4 * (height - height[0]) * np.hanning(rows), extrapolation="periodic")


class QuarterCar(Model):
    """Wheel and body of a quarter of a car over a measured road, at constant speed.

    The road is the table `profile`, height over distance in m: QuarterCar(profile="road.csv") reads one.
    """

    stop_time = 10.0
    speed: Scalar = parameter("speed of the car", unit="m/s", default=20)
    profile: Table = structural("height over distance", cls=Table, default=lambda s: rough(200, 10_000))
    bump: Scalar = input("height besides the profile", unit="m")
    body = translational.Mass(m=400, s=fixed(0, nominal=0.01), v=fixed(0, nominal=0.1))
    wheel = translational.Mass(m=40, s=fixed(0, nominal=0.01), v=fixed(0, nominal=0.1))
    strut = translational.SpringDamper(c=2e4, d=1.5e3)
    stiffness: Scalar = parameter("stiffness of the tyre", unit="N/m", default=2e5)
    tyre = translational.Force()
    lift: Scalar = output("height of the body", unit="m")
    load: Scalar = output("force of the tyre on the wheel besides the weight", unit="N")

    def connections(self):
        yield connect(self.tyre.flange, self.wheel.flange_a)
        yield connect(self.wheel.flange_b, self.strut.flange_a)
        yield connect(self.strut.flange_b, self.body.flange_a)

    def equations(self):
        road = quantity(table(self.speed * time, self.profile), "m") + self.bump
        yield self.tyre.f == self.stiffness * (road - self.wheel.s)
        yield self.lift == self.body.s
        yield self.load == self.tyre.f
