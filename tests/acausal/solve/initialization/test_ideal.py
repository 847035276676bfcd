"""Ideal parts: rigid lines and massless parts; derivatives at the start."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from scipy.integrate import solve_ivp

import acausal as ac
from acausal import Model, Scalar, chain, der, fixed, guess, parameter, variable
from components import Body, BodyRod, Prismatic, Revolute, Spring, World, rotational
from components.line_force import LineForce

G = 9.81


class RigidLine(LineForce):
    """Rod without mass between two points."""

    length: Scalar = parameter("length", unit="m", default=1)

    def law(self):
        yield self.s == self.length


def pendulum(times: np.ndarray, length: float) -> np.ndarray:
    """Angle below the horizontal of a point mass that starts there at rest."""
    found = solve_ivp(
        lambda _, y: [y[1], G / length * np.cos(y[0])], (0, times[-1]), [0, 0], "DOP853", times, rtol=1e-12, atol=1e-12
    )
    return found.y[0]


class OnALine(Model):
    world, rod = World(g=G), RigidLine()
    ball = Body(
        m=2, I=0.1 * np.eye(3), r_0=fixed((1, 0, 0)), v_0=fixed((0, 0, 0)), w_a=fixed((0, 1, 0)), angles_fixed=True
    )

    def connections(self):
        yield chain(self.world, self.rod, self.ball)


def test_a_rigid_line_makes_a_pendulum() -> None:
    result = ac.simulate(OnALine(), stop_time=2, tolerance=1e-9)
    angle = pendulum(result.time, 1)
    assert np.allclose(result["ball.r_0"][:, 0], np.cos(angle), atol=1e-5)
    assert np.allclose(result["ball.r_0"][:, 1], -np.sin(angle), atol=1e-5)
    speed = np.sum(result["ball.v_0"] ** 2, axis=1)
    assert np.allclose(result["rod.f"], 2 * (speed + G * np.sin(angle)), atol=1e-3)


class TwoLines(Model):
    """Double pendulum of two rigid lines, of which the first is given as a pendulum of joints."""

    world, rod = World(g=G), RigidLine(length=0.5)
    hinge, arm = Revolute(phi=fixed(0), w=fixed(0)), BodyRod(r=(1, 0, 0), m=1)
    ball = Body(
        m=2, I=0.1 * np.eye(3), r_0=fixed((1.5, 0, 0)), v_0=fixed((0, 0, 0)), w_a=fixed((0, 0, 0)), angles_fixed=True
    )

    def connections(self):
        yield chain(self.world, self.hinge, self.arm, self.rod, self.ball)


def test_a_rigid_line_at_a_body_keeps_the_energy() -> None:
    result = ac.simulate(TwoLines(), stop_time=1, tolerance=1e-9, energy=True)
    assert abs(result.stats["energy_method"]) < 1e-4
    apart = result["rod.frame_b.r_0"] - result["rod.frame_a.r_0"]
    assert np.allclose(np.linalg.norm(apart, axis=1), 0.5, atol=1e-8)


class MasslessRotor(Model):
    """Two springs in series with a rotor of no inertia between them."""

    ground, s1, s2 = rotational.Fixed(), rotational.Spring(c=10), rotational.Spring(c=20)
    rotor, load = rotational.Inertia(J=0), rotational.Inertia(J=1, phi=fixed(0.1), w=fixed(0))

    def connections(self):
        yield chain(self.ground, self.s1, self.rotor, self.s2, self.load)


class MasslessPoint(Model):
    """The same with springs along a line, and a slider of no mass."""

    world = World(g=0, gravity=None)
    p1, p2 = Prismatic(), Prismatic(s=guess(1))
    point, ball = Body(m=0), Body(m=1)
    s1, s2 = Spring(c=10, s_unstretched=1), Spring(c=20, s_unstretched=1)

    def connections(self):
        yield chain(self.world, self.p1, self.point)
        yield chain(self.world, self.p2, self.ball)
        yield chain(self.world, self.s1, self.point)
        yield chain(self.point.frame_a, self.s2, self.ball)

    def initial_equations(self):
        yield self.p2.s == 2.1
        yield self.p2.v == 0


def test_massless_parts_between_springs() -> None:
    rate = np.sqrt(10 * 20 / 30)
    result = ac.simulate(MasslessRotor(), stop_time=3, tolerance=1e-9)
    assert np.allclose(result["load.phi"], 0.1 * np.cos(rate * result.time), atol=1e-6)
    assert np.allclose(result["rotor.phi"], result["load.phi"] * 2 / 3, atol=1e-8)
    result = ac.simulate(MasslessPoint(), stop_time=3, tolerance=1e-9, initial="guesses")
    assert np.allclose(result["p2.s"] - 2, 0.1 * np.cos(rate * result.time), atol=1e-6)
    assert np.allclose(result["p1.s"] - 1, (result["p2.s"] - 2) * 2 / 3, atol=1e-7)


class Oscillator(Model):
    """X = cos 2t + sin 2t / 2."""

    x: Scalar = variable("coordinate")
    v: Scalar = variable("der(x)", start=0.5)
    double: Scalar = variable("2 x")
    square: Scalar = variable("x^2")

    def equations(self):
        yield self.v == der(self.x)
        yield der(self.v) == -4 * self.x
        yield self.double == 2 * self.x
        yield self.square == self.x**2

    def initial_equations(self):
        yield self.x == 1


CONDITIONS = {
    "of an alias": lambda s: der(s.double) == 2,
    "of an alias, three times": lambda s: der(der(der(s.double))) == -8,
    "of the second order": lambda s: der(der(der(s.x))) == -4,
    "of what is not linear": lambda s: der(s.square) == 2,
    "of what is not linear, twice": lambda s: der(der(s.square)) == 2 - 8,
    "of an expression": lambda s: der(s.x * s.v) == 1 - 4,
}


@pytest.mark.parametrize("condition", CONDITIONS.values(), ids=CONDITIONS)
def test_derivatives_in_initial_equations(condition: Any) -> None:
    class Started(Oscillator):
        def initial_equations(self):
            yield from super().initial_equations()
            yield condition(self)

    result = ac.simulate(Started(), stop_time=1, tolerance=1e-9)
    assert np.allclose(result["x"], np.cos(2 * result.time) + np.sin(2 * result.time) / 2, atol=1e-6)


def test_second_derivative_given_at_the_start() -> None:
    class Pushed(Oscillator):
        def initial_equations(self):
            yield der(der(self.x)) == -4
            yield self.v == 1

    result = ac.simulate(Pushed(), stop_time=1, tolerance=1e-9)
    assert result["x"][0] == pytest.approx(1)


def test_a_derivative_in_an_energy() -> None:
    class Spent(Oscillator):
        def initial_equations(self):
            yield from super().initial_equations()
            yield self.v == 1

        def dissipated_power(self):
            return der(self.square)

    result = ac.simulate(Spent(), stop_time=1, tolerance=1e-9, energy=True)
    assert result.stats["energy_dissipated"] == pytest.approx(result["x"][-1] ** 2 - 1, abs=1e-6)
