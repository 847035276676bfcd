"""Line forces by a law of the user: a motion by hand, energy with and without its function, wrong input."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.integrate import solve_ivp

import acausal as ac
from acausal import DeclarationError, Model, Scalar, chain, connect, fixed, parameter, part, piecewise
from components import Body, LineForceLaw, PointMass, Prismatic, Spring, World


def stiffening(s, v):
    return 40 * (s - 0.5) + 200 * (s - 0.5) ** 3 + 0.8 * v * abs(v)


class Guided(Model):
    """A mass on a guide, pulled to its end."""

    world, rail, body = World(gravity=None), Prismatic(n=(1, 0, 0), s=fixed(1.0), v=fixed(0.5)), Body(m=2)
    it = LineForceLaw(force=stiffening, energy=lambda s: 20 * (s - 0.5) ** 2 + 50 * (s - 0.5) ** 4, f_0=3)

    def connections(self):
        yield chain(self.world, self.rail, self.body)
        yield connect(self.world.frame_b, self.it.frame_a)
        yield connect(self.rail.frame_b, self.it.frame_b)


def by_hand(law, times):
    solved = solve_ivp(
        lambda t, y: [y[1], -law(*y) / 2], (0, times[-1]), [1.0, 0.5], t_eval=times, rtol=1e-10, atol=1e-12
    )
    return solved.y[0]


@pytest.mark.parametrize("energy", [None, lambda s: 20 * (s - 0.5) ** 2 + 50 * (s - 0.5) ** 4])
def test_motion_and_energy(energy):
    """Work is stored if its energy is given and supplied otherwise; the damper's is dissipated in both."""
    it = LineForceLaw(force=stiffening, energy=energy, f_0=3)
    result = ac.simulate(Guided(it=it), stop_time=2.0, tolerance=1e-9, intervals=50, energy=True)
    np.testing.assert_allclose(result["it.s"], by_hand(lambda s, v: 3 + stiffening(s, v), result.time), atol=1e-7)
    stats, v = result.stats, result["it.v"]
    lost = np.trapezoid(0.8 * np.abs(v) ** 3, result.time)
    assert stats["energy_dissipated"] == pytest.approx(lost, rel=5e-3)
    assert abs(stats["energy_method"]) < 1e-7
    assert abs(stats["energy_supplied"]) > 0.1 if energy is None else stats["energy_supplied"] == 0


class Stop(Guided):
    """Parameters of the model and a law in pieces."""

    c: Scalar = parameter("stiffness", unit="N/m", default=30)

    @part
    def it(self):
        return LineForceLaw(force=lambda s, v: piecewise((self.c * (s - 0.8), s < 0.8), 0) + 5)


def test_a_law_in_pieces_with_parameters():
    result = ac.simulate(Stop(), stop_time=1.5, tolerance=1e-9, intervals=30, parameters={"c": 400})
    assert result.stats["events"] >= 1
    expected = by_hand(lambda s, v: 400 * min(s - 0.8, 0) + 5, result.time)
    np.testing.assert_allclose(result["it.s"], expected, atol=1e-6)


def test_wrong_input():
    with pytest.raises(DeclarationError, match="force"):
        ac.compile(Guided(it=LineForceLaw(force=3)))


class Series(Model):
    """A mass of 2 kg on two springs in series, whose common point has no mass."""

    world = World(g=9.81)
    upper, lower = Spring(c=100, s_unstretched=0.2), Spring(c=300, s_unstretched=0.3, fixed_rotation_at_frame_a=True)
    mass = PointMass(m=2, r_0=fixed((0, -0.6, 0)), v_0=fixed((0, 0, 0)))

    def connections(self):
        yield chain(self.world, self.upper, self.lower, self.mass)


class SeriesTurnedRound(Series):
    upper = Spring(c=100, s_unstretched=0.2, fixed_rotation_at_frame_b=True)
    lower = Spring(c=300, s_unstretched=0.3)

    def connections(self):
        yield chain(self.world, self.upper, self.lower.frame_b)
        yield connect(self.lower.frame_a, self.mass.frame_a)


@pytest.mark.parametrize("model", [Series, SeriesTurnedRound])
def test_a_point_that_springs_alone_hold(model):
    """Of the stiffness 75 N/m, its position is a harmonic oscillation about 0.5 m + m g / c."""
    result = ac.simulate(model(), stop_time=2.0, tolerance=1e-9)
    rest = -0.5 - 2 * 9.81 / 75
    y = rest + (-0.6 - rest) * np.cos(np.sqrt(75 / 2) * result.time)
    np.testing.assert_allclose(result["mass.r_0"][:, 1], y, atol=1e-7)
    np.testing.assert_allclose(result["upper.frame_b.r_0"][:, 1], 0.75 * (y + 0.5) - 0.2, atol=1e-7)
