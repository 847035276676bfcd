"""Joints with friction that sticks: a friction element at the drive, closed forms, and machines without a solution."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from scipy.optimize import brentq

import acausal as ac
from acausal import Model, chain, connect, fixed, guess
from components import Body, BodyShape, Prismatic, Revolute, World, rotational

G, MU, R = 9.80665, 0.3, 0.05


class Pendulum(Model):
    world, arm = World(), Body(m=1.0, r_CM=(1, 0, 0))
    hinge = Revolute(phi=fixed(0.3), w=fixed(0.0), friction="stiction", tau_dry=1.5, peak=1.2)

    def connections(self):
        yield chain(self.world, self.hinge, self.arm)


class Beside(Pendulum):
    """The same friction at the drive."""

    hinge = Revolute(phi=fixed(0.3), w=fixed(0.0), use_axis_flange=True)
    pin = rotational.Friction(tau_sliding=1.5, tau_static=1.8)

    def connections(self):
        yield from super().connections()
        yield chain(self.hinge.support, self.pin, self.hinge.axis)


@pytest.mark.parametrize("method", ["auto", "idas"])
def test_stiction_is_that_of_a_friction_at_the_drive(method):
    inside, beside = (ac.simulate(m(), stop_time=6, method=method, tolerance=1e-8) for m in (Pendulum, Beside))
    np.testing.assert_allclose(inside["hinge.phi"], beside["hinge.phi"], atol=1e-6)
    assert inside["hinge.stiction.mode"][-1] == 0
    assert abs(G * np.cos(inside["hinge.phi"][-1])) < 1.8


class UnderReaction(Pendulum):
    hinge = Revolute(phi=fixed(0.3), w=fixed(0.0), friction="reaction", mu=MU, r_pin=R)


def accelerated(phi, w):
    """Solve a = -g cos(phi) - mu R N sign(w), N^2 = (w^2 + g sin(phi))^2 + (a + g cos(phi))^2, of a unit mass at 1 m."""

    def gap(a):
        N = np.hypot(w**2 + G * np.sin(-phi), a + G * np.cos(phi))
        return a + G * np.cos(phi) + MU * R * N * np.sign(w)

    return brentq(gap, -100, 100, xtol=1e-13)


def test_pin_under_its_reaction():
    """Until the pendulum turns round at the other side."""
    result = ac.simulate(UnderReaction(), stop_time=1.2, tolerance=1e-9)
    start, w = [0.3, -1e-12], 1e-9
    run = solve_ivp(lambda t, y: [y[1], accelerated(*y)], (0, 1.2), start, rtol=1e-10, atol=1e-12, dense_output=True)
    assert np.all(result["hinge.w"][1:] < w)
    np.testing.assert_allclose(result["hinge.phi"], run.sol(result.time)[0], atol=1e-6)


class Slide(Model):
    """A block on a plane that falls to its back: it stops, and rests if mu is more than the slope."""

    world, block = World(n=(-0.3, -1, 0)), Body(m=2.0)
    rail = Prismatic(s=fixed(0.0), v=fixed(2.0), friction="reaction", mu=0.5)

    def connections(self):
        yield chain(self.world, self.rail, self.block)


@pytest.mark.parametrize("mu", [0.5, 0.2])
def test_block_on_a_slope(mu):
    result = ac.simulate(Slide(), stop_time=1.0, tolerance=1e-8, parameters={"rail.mu": mu})
    along, across = np.array([0.3, 1.0]) / np.hypot(0.3, 1) * G
    slows = along + mu * across
    stop, t = 2 / slows, result.time
    back = max(along - mu * across, 0) * (t - stop) ** 2 / 2
    np.testing.assert_allclose(
        result["rail.s"], np.where(t < stop, 2 * t - slows * t**2 / 2, 2 / slows - back), atol=1e-6
    )


class Leaning(Model):
    """Painleve's rod: where mu is more than 4 / 3, no reaction holds a rod that leans against its motion."""

    world, rod = World(), Body(m=1.0, r_CM=(0.5, 0, 0), I=np.eye(3) / 12)
    rail, hinge = (
        Prismatic(s=fixed(0), v=fixed(-1), friction="reaction"),
        Revolute(phi=fixed(np.pi / 2 - 0.4), w=fixed(0)),
    )

    def connections(self):
        yield chain(self.world, self.rail, self.hinge, self.rod)


def test_friction_without_a_solution_is_refused():
    with pytest.raises(ac.InitializationError, match=r"rail\.stiction"):
        ac.simulate(Leaning(), stop_time=0.1, parameters={"rail.mu": 1.5})
    assert ac.simulate(Leaning(), stop_time=0.1, parameters={"rail.mu": 0.5})["rail.v"][-1] > -1


class Engine(Model):
    """A slider-crank all of whose joints have friction; the wrist reverses at mid-stroke."""

    world = World()
    j1, b1 = (
        Revolute(phi=fixed(1.0), w=fixed(20.0), friction="reaction"),
        BodyShape(r=(0.3, 0, 0), m=5, r_CM=(0.15, 0, 0)),
    )
    j2, b2 = Revolute(phi=guess(-1.255), friction="reaction"), BodyShape(r=(1.0, 0, 0), m=1, r_CM=(0.5, 0, 0))
    j3, m = Revolute(phi=guess(0.255), friction="reaction"), Body(m=1)
    slide = Prismatic(s=guess(1.13), friction="reaction", mu=0.1)

    def connections(self):
        yield chain(self.world, self.j1, self.b1, self.j2, self.b2, self.j3, self.m)
        yield connect(self.world.frame_b, self.slide.frame_a)
        yield connect(self.slide.frame_b, self.m.frame_a)


def test_friction_in_all_joints_of_an_engine():
    pins = {f"j{k}.{name}": value for k in (1, 2, 3) for name, value in (("mu", 0.1), ("r_pin", 0.02))}
    result = ac.simulate(Engine(), stop_time=1.0, tolerance=1e-7, parameters=pins, energy=True)
    assert result.stats["energy_dissipated"] > 10
    assert abs(result.stats["energy_method"]) < 1e-5 * result.stats["energy_dissipated"]
