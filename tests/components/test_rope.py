"""Ropes over points: energy, a motion by hand, hoists, slack and catch, wrong input."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.integrate import solve_ivp

import acausal as ac
from acausal import (
    DeclarationError,
    InitializationError,
    Model,
    SimulationError,
    chain,
    connect,
    fixed,
    part,
    structural,
)
from components import Fixed, PointMass, Prismatic, Rope, World

G = 9.81


class Hanging(Model):
    """A load on a rope over a fixed point, free to swing."""

    r = structural("position of the load at the start in m", default=(1.5, -1.0, 0.2), shape=(3,))
    v = structural("velocity of the load at the start in m/s", default=(0, 0, 0), shape=(3,))
    world, over, it = World(g=G), Fixed(r=(1, 0, 0)), Rope(points=1, c=80, length=1.8)

    @part
    def load(self):
        return PointMass(m=1, r_0=fixed(self.r), v_0=fixed(self.v))

    def connections(self):
        yield chain(self.world, self.it, self.load)
        yield connect(self.over.frame_b, self.it.frame_1)


def test_energy_of_a_load_that_swings():
    model = Hanging(r=(1.4, -0.95, 0.2), it=Rope(points=1, c=80, length=1.92))
    result = ac.simulate(model, stop_time=100.0, tolerance=1e-8)
    r, v, s = result["load.r_0"], result["load.v_0"], result["it.s"]
    np.testing.assert_allclose(s, 1 + np.linalg.norm(r - (1, 0, 0), axis=1), atol=1e-12)
    assert np.min(s) > 1.95
    assert np.ptp(r[:, 0]) > 0.7
    energy = np.sum(v**2, axis=1) / 2 + G * r[:, 1] + 40 * (s - 1.92) ** 2
    np.testing.assert_allclose(energy, energy[0], atol=1e-6)


def test_a_load_that_swings_by_hand():
    def rates(t, y):
        part = y[:3] - (1, 0, 0)
        length = np.linalg.norm(part)
        f = max(0, 80 * (length - 0.8) + 3 * part @ y[3:] / length) if length > 0.8 else 0
        return [*y[3:], *(-f * part / length - (0, G, 0))]

    start = {"r": (1.1, -0.2, 0), "v": (3, 2, 1)}  # slack
    result = ac.simulate(Hanging(**start, it=Rope(points=1, c=80, d=3, length=1.8)), stop_time=3.0, tolerance=1e-9)
    solved = solve_ivp(
        rates, (0, 3), [*start["r"], *start["v"]], t_eval=result.time, rtol=1e-10, atol=1e-11, max_step=1e-3
    )
    assert result["it.f"][0] == 0
    assert result.stats["events"] >= 2
    np.testing.assert_allclose(result["load.r_0"], solved.y[:3].T, atol=1e-5)


class Hoist(Model):
    """Two weights on guides: one on the end of the rope, one on a loose pulley, which two parts of the rope hold."""

    world, first, last = World(g=G), Fixed(r=(0, 0, 0)), Fixed(r=(0.002, 0, 0))
    it = Rope(points=2, c=1e6, d=2e3, length=3 - 1.26e-5)
    loose = Prismatic(n=(0, -1, 0), s=fixed(1.0), v=fixed(0))
    end = Prismatic(n=(0, -1, 0), s=fixed(1.0), v=fixed(0))
    big, small = PointMass(m=3), PointMass(m=1)

    def connections(self):
        yield connect(self.first.frame_b, self.it.frame_a)
        yield chain(self.first.frame_b, self.loose, self.big)
        yield connect(self.loose.frame_b, self.it.frame_1)
        yield connect(self.last.frame_b, self.it.frame_2)
        yield chain(self.last.frame_b, self.end, self.small)
        yield connect(self.end.frame_b, self.it.frame_b)


def test_a_hoist_with_a_loose_pulley():
    """A stiff rope: the big weight falls by half as much as the small one rises; M g - 2 f = M a, f - m g = 2 m a."""
    result = ac.simulate(Hoist(), stop_time=0.5, tolerance=1e-8)
    a = (3 - 2) * G / (3 + 4)
    assert result["it.f"][-1] == pytest.approx(G + 2 * a, rel=1e-3)
    assert result["loose.s"][-1] == pytest.approx(1 + a * 0.5**2 / 2, abs=1e-4)
    assert result["end.s"][-1] == pytest.approx(1 - a * 0.5**2, abs=1e-4)


def test_length_from_the_start():
    """0 is the way at the start, whatever that is; a length that is given counts."""
    result = ac.simulate(Hanging(it=Rope(points=1, c=80)), stop_time=0.1)
    assert result["it.length_0"][0] == result["it.s"][0] == pytest.approx(1 + np.linalg.norm((0.5, -1, 0.2)))
    assert result["it.f"][0] == 0
    assert ac.simulate(Hanging(), stop_time=0.1)["it.length_0"][0] == 1.8


def test_points_that_meet():
    with pytest.raises(InitializationError, match="frame_1 and frame_b of it coincide at the start"):
        ac.simulate(Hanging(r=(1, 0, 0)), stop_time=0.1)
    with pytest.raises(SimulationError, match="frame_1 and frame_b meet, where the rope has no direction"):
        ac.simulate(Hanging(r=(1, -1, 0), v=(0, 20, 0), it=Rope(points=1, c=80, length=0.5)), stop_time=1.0)


@pytest.mark.parametrize(
    ("values", "message"),
    [
        ({"c": 0}, "greater than 0"),
        ({"d": -1}, "at least 0"),
        ({"length": -1}, "at least 0"),
        ({"points": -1}, "points"),
    ],
)
def test_wrong_input(values, message):
    with pytest.raises(DeclarationError, match=message):
        ac.compile(Hanging(it=Rope(**{"points": 1, "c": 80, **values})))
