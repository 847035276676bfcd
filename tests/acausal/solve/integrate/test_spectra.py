"""Eigenvalues of large systems at points where there are none but 0."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

import acausal as ac
from acausal import Model, Scalar, chain, der, fixed, structural, variable
from components import BodyRod, Revolute, World


class Drifting(Model):
    """Points that nothing holds."""

    n: int = structural("how many", default=50)
    x: Any = variable("places", shape=lambda self: (self.n,), fixed=True)
    v: Any = variable("speeds", shape=lambda self: (self.n,), start=1.0, fixed=True)

    def equations(self):
        yield der(self.x) == self.v
        yield der(self.v) == np.zeros(self.n)


class Spread(Model):
    """Many first-order systems, all rates 0 but one."""

    n: int = structural("how many", default=100)
    rate: Scalar = ac.parameter("rate of the last one", default=2)
    x: Any = variable("states", shape=lambda self: (self.n,), start=1.0, fixed=True)

    def equations(self):
        for k in range(self.n - 1):
            yield der(self.x[k]) == 0 * self.x[k]
        yield der(self.x[self.n - 1]) == -self.rate * self.x[self.n - 1]


class Counters(Model):
    """Rates that depend on nothing."""

    n: int = structural("how many", default=100)
    x: Any = variable("states", shape=lambda self: (self.n,), fixed=True)

    def equations(self):
        yield der(self.x) == np.ones(self.n)


def test_rates_that_depend_on_nothing() -> None:
    assert np.allclose(ac.simulate(Counters(), stop_time=2, intervals=4)["x"][-1], 2)


@pytest.mark.parametrize("n", [20, 50, 100])
def test_points_that_nothing_holds(n: int) -> None:
    result = ac.simulate(Drifting(n=n), stop_time=2, intervals=4)
    assert np.allclose(result["x"][-1], 2)


def test_one_rate_among_zeros() -> None:
    result = ac.simulate(Spread(), stop_time=1, intervals=4, tolerance=1e-8)
    assert result["x"][-1, -1] == pytest.approx(np.exp(-2), rel=1e-5)


class Chain(Model):
    """Rods in a row without weight, at rest."""

    n: int = structural("rods", default=33)
    world = World(gravity=None)

    @ac.parts
    def joints(self):
        """Joints."""
        return [Revolute(phi=fixed(0), w=fixed(0)) for _ in range(self.n)]

    @ac.parts
    def rods(self):
        """Rods."""
        return [BodyRod(r=(0.1, 0, 0), m=0.1) for _ in range(self.n)]

    def connections(self):
        yield chain(self.world, *(part for pair in zip(self.joints, self.rods, strict=True) for part in pair))


@pytest.mark.slow
def test_a_long_chain_of_bodies_at_rest() -> None:
    result = ac.simulate(Chain(), stop_time=0.1, intervals=2)
    assert np.allclose(result["rods[32].frame_b.r_0"][-1], [3.3, 0, 0])
