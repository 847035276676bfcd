"""Sizes of variables that declare none: small machines are as exact as large ones."""

from __future__ import annotations

import numpy as np
import pytest

import acausal as ac
from acausal import (
    DeclarationError,
    Model,
    Scalar,
    chain,
    der,
    fixed,
    guess,
    parameter,
    quantity,
    reinit,
    variable,
    when,
)
from components import Body, Prismatic, Revolute, World
from tests.acausal.solve.machines import Oscillator


def error(a: float, **options) -> tuple[float, ac.Result]:
    result = ac.simulate(Oscillator(a=a), stop_time=10.0, **options)
    return float(np.max(np.abs(result["slide.s"] - a * np.cos(np.sqrt(40) * result.time)))) / a, result


@pytest.mark.parametrize("method", ["idas", "rosenbrock"])
@pytest.mark.parametrize("a", [1e-1, 1e-3, 1e-5, 1e-8, 1e-9])
def test_small_oscillation(a, method):
    assert error(a, method=method)[0] < 5e-4


@pytest.mark.parametrize("a", [1e-3, 1e-6])
def test_error_falls_with_the_tolerance(a):
    rough, fine = (error(a, tolerance=tolerance)[0] for tolerance in (1e-5, 1e-8))
    assert fine < rough / 30


@pytest.mark.parametrize(("a", "tolerance"), [(1e-7, 1e-3), (1e-9, 1e-4), (1e-10, 1e-6)])
def test_what_begins_with_a_value_does_not_rest(a, tolerance):
    """Even if the first run loses the motion in its tolerance."""
    found, result = error(a, tolerance=tolerance)
    assert found < 1e3 * tolerance
    assert result.stats["sizes"]["m"] == pytest.approx(a, rel=0.2)


def test_sizes_are_told_and_steps_of_all_runs_counted():
    result = error(1e-5)[1]
    assert result.stats["sizes"]["m"] == pytest.approx(1e-5, rel=0.2)
    assert result.stats["sizes"]["m/s"] == pytest.approx(1e-5 * np.sqrt(40), rel=0.2)
    assert result.stats["calls"] >= 2


def test_declared_size_stands():
    class Declared(Oscillator):
        slide = Prismatic(n=(1, 0, 0), s=fixed(1e-5, nominal=1.0), v=fixed(0, nominal=1.0))

    result = ac.simulate(Declared(), stop_time=1.0)
    assert result.stats["sizes"] == {"m": 1.0, "m/s": 1.0}

    class Small(Oscillator):
        slide = Prismatic(n=(1, 0, 0), s=fixed(1e-5, nominal=1e-5), v=guess(0, nominal=1e-5))

    result = ac.simulate(Small(), stop_time=10.0, initial="guesses")
    assert result.stats["sizes"] == {"m": 1e-5, "m/s": 1e-5}
    assert np.max(np.abs(result["slide.s"] / 1e-5 - np.cos(np.sqrt(40) * result.time))) < 5e-4


class Pendulum(Model):
    phi: Scalar = parameter("amplitude", unit="rad", default=1e-4)
    world = World()
    hinge = Revolute(phi=fixed(phi - np.pi / 2), w=fixed(0))
    bob = Body(m=1.0, r_CM=(1, 0, 0))

    def connections(self):
        yield chain(self.world, self.hinge, self.bob)


def test_rest_is_no_size():
    """A pendulum that hangs still moves by rounding only, which nobody wants to follow."""
    result = ac.simulate(Pendulum(phi=0.0), stop_time=10.0)
    assert result.stats["steps"] < 100
    assert np.max(np.abs(result["hinge.phi"] + np.pi / 2)) < 1e-12


class Slow(Model):
    """Events see sizes too."""

    x: Scalar = variable("x", unit="m", start=0, fixed=True)
    v: Scalar = variable("v", unit="m/s", start=1e-6, fixed=True)

    def equations(self):
        yield der(self.x) == self.v
        yield der(self.v) == -quantity(4, "1/s2") * self.x
        yield when(self.x < 0, reinit(self.v, -self.v))


def test_event_of_a_small_motion():
    result = ac.simulate(Slow(), stop_time=3.0, tolerance=1e-8)
    assert result.stats["event_times"][0] == pytest.approx(np.pi / 2, abs=1e-6)


def test_nominal_of_the_wrong_shape_is_refused():
    with pytest.raises(DeclarationError, match=r"nominal of `slide\.s`"):
        ac.compile(Oscillator(slide=Prismatic(n=(1, 0, 0), s=fixed(0, nominal=(1, 2)))))
