"""Ends of line forces that meet in motion: the run stops where the force has no direction, and passes where it is 0."""

from __future__ import annotations

import warnings
from functools import cache
from typing import Any

import numpy as np
import pytest
from scipy.integrate import solve_ivp

import acausal as ac
from acausal import Model, SimulationError, chain, connect, fixed, quantity, reinit, structural, when
from components import Body, Damper, Fixed, LineForce, Prismatic, Spring, SpringDamperParallel, World
from tests.shared import pairwise

METHODS, TOLERANCES = ("idas", "rosenbrock"), (1e-3, 1e-6, 1e-8)


class Pull(LineForce):
    """A constant force."""

    def law(self):
        yield self.f == 5


class Falling(Model):
    """A mass that falls from 1 m onto the other end of a line force, along a guide."""

    force: Any = structural("line force")
    world = World(g=9.81)
    rail, body = Prismatic(n=(0, 1, 0), s=fixed(1.0), v=fixed(0.0)), Body(m=1)

    @ac.part
    def line(self):
        return self.force

    def connections(self):
        yield chain(self.world, self.rail, self.body)
        yield connect(self.world.frame_b, self.line.frame_a)
        yield connect(self.rail.frame_b, self.line.frame_b)


class Flying(Model):
    """A free body that flies past an anchor, `beside` it, or through it."""

    force: Any = structural("line force")
    beside: float = structural("distance in m", default=0.0)
    world, anchor = World(gravity=None), Fixed(r=(0, 0, 0.2))

    @ac.part
    def line(self):
        return self.force

    @ac.part
    def body(self):
        start = {"r_0": fixed((1.0, self.beside, 0.7)), "v_0": fixed((-5.0, 0, -2.5)), "w_a": fixed((0, 0, 0))}
        return Body(m=1, I=np.eye(3), angles_fixed=True, **start)

    def connections(self):
        yield connect(self.anchor.frame_b, self.line.frame_a)
        yield connect(self.body.frame_a, self.line.frame_b)


def meeting(rate: Any, start: tuple[float, float]) -> float:
    """When a point on a line, with x'' = rate(x, v) while x is positive, comes to 0."""
    there = lambda t, y: y[0]  # noqa: E731
    there.terminal = True
    solved = solve_ivp(lambda t, y: (y[1], rate(*y)), (0, 2), start, rtol=1e-11, atol=1e-13, events=there)
    return float(solved.t_events[0][0])


FALLING = {
    "spring": (lambda: Spring(c=100, s_unstretched=0.3), lambda x, v: -9.81 - 100 * (x - 0.3)),
    "pushed in": (lambda: Spring(c=20, s_unstretched=0.2), lambda x, v: -9.81 - 20 * (x - 0.2)),
    "spring and damper": (
        lambda: SpringDamperParallel(c=100, d=2, s_unstretched=0.3),
        lambda x, v: -9.81 - 100 * (x - 0.3) - 2 * v,
    ),
    "constant": (Pull, lambda x, v: -9.81 - 5),
}


@cache
def falling(name):
    return ac.compile(Falling(force=FALLING[name][0]()))


@cache
def flying(force, **values):
    return ac.compile(Flying(force=force(), **values))


@pytest.mark.parametrize(("intervals", "tolerance", "method", "name"), pairwise([1, 50], TOLERANCES, METHODS, FALLING))
def test_a_mass_that_falls_onto_the_other_end(name, method, tolerance, intervals):
    model, rate = falling(name), FALLING[name][1]
    with pytest.raises(SimulationError, match=r"line \(\w+\), .*the ends meet") as caught:
        ac.simulate(model, stop_time=1, method=method, tolerance=tolerance, intervals=intervals)
    exact = meeting(rate, (1.0, 0.0))
    text = str(caught.value)
    assert float(text.split("at t = ")[1].split(" s ")[0]) == pytest.approx(exact, abs=1000 * tolerance * exact)
    assert "FixedTranslation(r=...)" in text
    kept = caught.value.result
    assert kept.time[-1] <= exact
    assert np.all(kept["rail.s"] > 0)


@pytest.mark.parametrize(("force", "tolerance", "method"), pairwise([FALLING["spring"][0], Pull], TOLERANCES, METHODS))
def test_a_free_body_that_flies_through_the_anchor(method, tolerance, force):
    with pytest.raises(SimulationError, match=r"line .*the ends meet"):
        ac.simulate(flying(force), stop_time=1, method=method, tolerance=tolerance)


@pytest.mark.parametrize("method", METHODS)
@pytest.mark.parametrize("tolerance", TOLERANCES)
@pytest.mark.parametrize(
    ("force", "rate"),
    [
        (lambda: Spring(c=100), lambda x, v: -9.81 - 100 * x),
        (lambda: Damper(d=2), lambda x, v: -9.81 - 2 * v),
        (lambda: SpringDamperParallel(c=100, d=2), lambda x, v: -9.81 - 100 * x - 2 * v),
    ],
)
def test_forces_that_are_regular_where_the_ends_meet_pass(method, tolerance, force, rate):
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        result = ac.simulate(Falling(force=force()), stop_time=1.3, method=method, tolerance=tolerance)
    exact = solve_ivp(lambda t, y: (y[1], rate(*y)), (0, 1.3), (1.0, 0.0), rtol=1e-11, atol=1e-13).y[0, -1]
    assert result["rail.s"][-1] == pytest.approx(exact, abs=1000 * tolerance)


@pytest.mark.parametrize("method", METHODS)
def test_ends_that_pass_beside_each_other_are_followed(method):
    force = Spring(c=100, s_unstretched=0.3)
    result = ac.simulate(Flying(force=force, beside=1e-3), stop_time=1, method=method, tolerance=1e-9)

    def motion(t: float, y: np.ndarray) -> np.ndarray:
        offset = y[:3] - (0, 0, 0.2)
        s = np.linalg.norm(offset)
        return np.concatenate([y[3:], -100 * (s - 0.3) * offset / s])

    exact = solve_ivp(motion, (0, 1), (1, 1e-3, 0.7, -5, 0, -2.5), rtol=1e-11, atol=1e-13).y[:3, -1]
    np.testing.assert_allclose(result["body.r_0"][-1], exact, atol=1e-5)


def test_a_stop_that_acts_before_holds_them_apart():
    class Stopped(Falling):
        def equations(self):
            yield when(self.rail.s < 0.05, reinit(self.rail.v, -self.rail.v))

    result = ac.simulate(Stopped(force=Spring(c=100, s_unstretched=0.3)), stop_time=1)
    assert result.stats["events"] >= 2
    assert np.all(result["rail.s"] > 0.04)


def test_a_spring_that_turns_round_before_its_ends_meet():
    result = ac.simulate(Falling(force=Spring(c=500, s_unstretched=0.9)), stop_time=2)
    assert result["line.s"].min() > 0.5


def test_ends_that_rest_where_they_met():
    class Caught(Falling):
        world = World(gravity=None)

    class Held(LineForce):
        def law(self):
            yield self.f == 5 + quantity(4, "N.s/m") * self.v

    for method in METHODS:
        with pytest.raises(SimulationError, match="the ends meet"):
            ac.simulate(Caught(force=Held()), stop_time=3, method=method)


def test_the_statement_of_a_users_component():
    with pytest.raises(ac.DeclarationError, match="apart needs a vector"):
        ac.apart(ac.time, ac.time, ac.time, "x")
