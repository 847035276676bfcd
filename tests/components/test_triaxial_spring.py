"""Springs along three axes against a hand-written integration in a turning frame, and the moment that holds them."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.integrate import solve_ivp

import acausal as ac
from acausal import DeclarationError, Model, chain, connect, fixed, structural
from components import Body, PointMass, Revolute, TriaxialSpring, World
from components.sensors import CutTorque

MASS, SPEED = 2.0, 1.5
C, D, R_0, F_0 = (np.array(v, dtype=float) for v in ((50, 80, 120), (1, 2, 3), (0.5, 0.1, -0.2), (3, -2, 1)))


class Turning(Model):
    """A point mass on springs to a shaft that turns steadily about z."""

    c = structural("stiffness in N/m", default=tuple(C), shape=(3,))
    world, shaft = World(gravity=None), Revolute(n=(0, 0, 1), phi=fixed(0), w=fixed(SPEED))
    wheel = Body(m=1, I=1e6 * np.eye(3))
    held, mass = CutTorque(), PointMass(m=MASS, r_0=fixed((0.6, 0.2, 0)), v_0=fixed((0, 0, 0)))

    @ac.part
    def it(self):
        return TriaxialSpring(c=self.c, d=D, r_rel0=R_0, f_0=F_0)

    def connections(self):
        yield chain(self.world, self.shaft, self.held, self.it, self.mass)
        yield connect(self.shaft.frame_b, self.wheel.frame_a)


def test_a_mass_on_a_turning_frame():
    """In the turning frame, with centrifugal and Coriolis forces; the wheel is heavy enough to keep its speed."""
    result = ac.simulate(Turning(), stop_time=2.0, tolerance=1e-9, intervals=20)
    w = np.array([0, 0, SPEED])

    def force(r, v):
        return F_0 + C * (r - R_0) + D * v

    def rates(t, y):
        r, v = y[:3], y[3:]
        return [*v, *(-force(r, v) / MASS - 2 * np.cross(w, v) - np.cross(w, np.cross(w, r)))]

    start = [0.6, 0.2, 0, *-np.cross(w, (0.6, 0.2, 0))]
    solved = solve_ivp(rates, (0, 2), start, t_eval=result.time, rtol=1e-10, atol=1e-11)
    r, v = solved.y[:3].T, solved.y[3:].T
    np.testing.assert_allclose(result["it.r_rel"], r, atol=1e-5)
    np.testing.assert_allclose(result["it.v_rel"], v, atol=1e-4)
    np.testing.assert_allclose(result["held.torque"], -np.cross(r, force(r, v)), atol=1e-3)


def test_wrong_input():
    with pytest.raises(DeclarationError, match="at least 0"):
        ac.compile(Turning(c=(1, -1, 1)))
