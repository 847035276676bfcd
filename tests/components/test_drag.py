"""Drag: a fall and a drift against closed forms."""

from __future__ import annotations

import numpy as np
import pytest

import acausal as ac
from acausal import DeclarationError, Model, Scalar, Vector3, chain, fixed, parameter, structural
from components import Drag, PointMass, World

MASS, C_D, A, RHO, G = 0.5, 0.8, 0.1, 1.3, 9.81


class Falling(Model):
    """A point mass in the air."""

    g = structural("gravity in m/s2", default=G)
    v = structural("velocity at the start", default=(0, 0, 0), shape=(3,))
    wind: Vector3 = parameter("velocity of the wind", unit="m/s", default=(0, 0, 0))
    c_d: Scalar = parameter("drag coefficient", unit="1", default=C_D)
    it = Drag(c_d=c_d, A=A, rho=RHO, v_wind=wind)

    @ac.part
    def world(self):
        return World(g=self.g)

    @ac.part
    def mass(self):
        return PointMass(m=MASS, r_0=fixed((0, 0, 0)), v_0=fixed(self.v))

    def connections(self):
        yield chain(self.it.frame_b, self.mass)


def test_a_fall_from_rest():
    """V = v_t tanh(g t / v_t)."""
    result = ac.simulate(Falling(), stop_time=3.0, tolerance=1e-9, energy=True)
    final = np.sqrt(2 * MASS * G / (RHO * C_D * A))
    np.testing.assert_allclose(result["mass.v_0"][:, 1], -final * np.tanh(G * result.time / final), atol=1e-6)
    v = result["mass.v_0"][-1, 1]
    lost = -MASS * G * result["mass.r_0"][-1, 1] - MASS * v**2 / 2
    assert result.stats["energy_dissipated"] == pytest.approx(lost, rel=1e-7)


def test_a_drift_with_the_wind():
    """Without gravity the velocity against the wind falls as u_0 / (1 + k |u_0| t)."""
    wind, v = np.array([3.0, -1.0, 2.0]), np.array([-1.0, 0.5, 4.0])
    result = ac.simulate(
        Falling(g=0, v=tuple(v)), stop_time=5.0, tolerance=1e-9, parameters={"wind": tuple(wind)}, energy=True
    )
    u, k = v - wind, RHO * C_D * A / (2 * MASS)
    expected = wind + u / (1 + k * np.linalg.norm(u) * result.time[:, None])
    np.testing.assert_allclose(result["mass.v_0"], expected, atol=1e-6)
    stats = result.stats
    assert stats["energy_supplied"] == pytest.approx(MASS * (expected[-1] - v) @ wind, rel=1e-6)
    assert abs(stats["energy_method"]) < 1e-6


def test_rest_in_still_air_has_a_derivative():
    result = ac.simulate(Falling(g=0), stop_time=1.0)
    np.testing.assert_array_equal(result["mass.v_0"], 0)
    assert np.isfinite(ac.linearize(Falling(g=0)).A).all()


def test_wrong_input():
    with pytest.raises(DeclarationError, match="at least 0"):
        ac.compile(Falling(c_d=1, it=Drag(c_d=-1, A=1)))
