"""Rolling wheels: the equations of a rolling disc, energy over a long run, wheel sets, and what is refused."""

from __future__ import annotations

from math import cos, sin, tan

import numpy as np
import pytest
from scipy.integrate import solve_ivp

import acausal as ac
from acausal import Model, chain, connect, fixed, guess
from components import Body, FixedTranslation, Revolute, RollingWheel, RollingWheelSet, World
from components.rotational import Torque2

r, m, C, A, g = 0.3, 2.0, 0.06, 0.12, 9.80665


class Wheel(Model):
    world = World(n=(0, 0, -1))
    wheel = RollingWheel(radius=r, m=m, I_axis=C, I_long=A, x=fixed(0.2), y=fixed(0.2), der_angles=fixed((0, 5, 1)))


def disc(t, y):
    """Moment of momentum about the point of contact, in forward direction f, axis a and n = f x a, which do not spin."""
    heading, lean, dlean, s, p = y[2:]  # angular velocity: dlean f + s a + p n
    q = p * tan(lean)
    ddlean = (m * g * r * sin(lean) + p * (C + m * r**2) * s - q * A * p) / (A + m * r**2)
    ds, dp = -m * r**2 * p * dlean / (C + m * r**2), q * dlean - C * dlean * s / A
    f, across = np.array([cos(heading), sin(heading)]), cos(lean) * np.array([-sin(heading), cos(heading)])
    return [*(r * s * f - r * dlean * across), p / cos(lean), dlean, ddlean, ds, dp]


def test_wheel_rolls_as_a_disc():
    found = ac.simulate(Wheel(), stop_time=4, tolerance=1e-9, intervals=20)
    known = solve_ivp(disc, (0, 4), [0.2, 0.2, 0, 0, 1, 5, 0], "DOP853", found.time, rtol=1e-11, atol=1e-11).y
    T = found["wheel.frame_a.R.T"]
    assert np.ptp(known[0]) > 0.3
    assert np.ptp(known[3]) > 0.2
    np.testing.assert_allclose(found["wheel.x"], known[0], atol=1e-6)
    np.testing.assert_allclose(found["wheel.y"], known[1], atol=1e-6)
    np.testing.assert_allclose(T[:, 1, 2], np.sin(known[3]), atol=1e-6)
    np.testing.assert_allclose(found["wheel.frame_a.R.w"][:, 1], known[5], atol=1e-5)
    np.testing.assert_allclose(np.sin(found["wheel.angles"][:, 1]), -T[:, 0, 2], atol=1e-9)


def test_energy_over_a_long_run():
    stats = ac.simulate(Wheel(), stop_time=100, tolerance=1e-8, energy=True).stats
    energy = m * (r**2 * (5**2 + 1) / 2 + g * r) + C * 5**2 / 2 + A / 2
    assert abs(stats.energy_stored_change) < 1e-6 * energy


@pytest.mark.parametrize("turns", [False, True])
def test_wheel_set_is_driven(turns):
    """Straight on, or on the spot: force over mass, and moment over moment of inertia, with those of the wheels' spin."""
    sign = -1 if turns else 1

    class Driven(Model):
        world = World(n=(0, 0, -1))
        wheels = RollingWheelSet(R_wheel=0.1, m_wheel=0.5, I_wheel_axis=0.01, I_wheel_long=0.02, track=0.5)
        one, two = Torque2(tau=-sign * 0.2), Torque2(tau=-0.2)

        def connections(self):
            for torque, axis in ((self.one, self.wheels.axis1), (self.two, self.wheels.axis2)):
                yield connect(self.wheels.support, torque.flange_b)
                yield connect(axis, torque.flange_a)

    result = ac.simulate(Driven(), stop_time=1)
    spin = 2 * (0.5 + 0.01 / 0.1**2)
    straight, turned = 2 * 0.2 / 0.1 / spin / 2, 0.5 * 0.2 / 0.1 / (2 * 0.02 + spin * 0.25**2) / 2
    assert result["wheels.x"][-1] == pytest.approx(0 if turns else straight, abs=1e-5)
    assert result["wheels.phi"][-1] == pytest.approx(turned if turns else 0, abs=1e-5)
    assert result["wheels.theta2"][-1] == pytest.approx((turned * 0.25 if turns else straight) / 0.1, abs=1e-4)


class Barrow(Model):
    """A wheel in a fork, which a body follows on a wheel of its own."""

    world = World(n=(0, 0, -1))
    wheel = RollingWheel(radius=r, m=m, I_axis=C, I_long=A, der_angles=fixed((0, 3, 0)))
    back = RollingWheel(
        radius=r, m=m, I_axis=C, I_long=A, x=guess(-1), y=guess(0), angles=guess((0, 0, 0)), der_angles=guess((0, 3, 0))
    )
    pin, pin_back = Revolute(n=(0, 1, 0)), Revolute(n=(0, 1, 0), phi=fixed(0))
    half, other, body = FixedTranslation(r=(-0.5, 0, 0.0)), FixedTranslation(r=(-0.5, 0, 0)), Body(m=3, I=np.eye(3))

    def connections(self):
        yield chain(self.wheel.frame_a, self.pin, self.half, self.other, self.pin_back, self.back.frame_a)
        yield connect(self.half.frame_b, self.body.frame_a)


def test_two_wheels_in_line():
    result = ac.simulate(Barrow(), stop_time=1, energy=True)
    assert result["wheel.x"][-1] == pytest.approx(0.9, abs=1e-5)
    assert result["back.x"][-1] == pytest.approx(-0.1, abs=1e-5)
    assert result["back.rolling_wheel.f_n"] == pytest.approx((m + 1.5) * g, rel=1e-5)


def test_wheel_that_falls_flat():
    with pytest.raises(
        ac.SimulationError, match=r"wheel\.rolling_wheel.*at t = 0\.\d+ s the wheel falls flat.*higher speed"
    ):
        ac.simulate(
            Wheel(wheel=RollingWheel(radius=r, m=m, I_axis=C, I_long=A, der_angles=fixed((0, 0, 1)))), stop_time=2
        )
    with pytest.raises(ac.InitializationError, match="lies flat at the start"):
        ac.simulate(
            Wheel(wheel=RollingWheel(radius=r, m=m, I_axis=C, I_long=A, angles=fixed((0, 0, 1.56)))), stop_time=2
        )


def test_wheel_that_would_lift_off():
    """A fast wheel that starts to lean fast rises from the road."""
    fast = RollingWheel(radius=r, m=m, I_axis=C, I_long=A, der_angles=fixed((0, 0, 9.0)))
    with pytest.warns(ac.AcausalWarning, match="the wheel would lift off"):
        ac.simulate(Wheel(wheel=fast), stop_time=0.1)
