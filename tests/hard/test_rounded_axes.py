"""Axes and coefficients with small entries: rounding, and slight misalignments, cost neither steps nor accuracy."""

from __future__ import annotations

from math import cos, pi, sin
from typing import Any

import numpy as np
import pytest
import scipy

import acausal as ac
from acausal import AVOID, Component, Model, Scalar, chain, connect, fixed, guess, parameter, port, variable
from components import Body, BodyBox, BodyCylinder, Flange, Prismatic, Revolute, World
from components.orientation import unit_vector
from components.rotational import Fixed as Ground
from components.rotational import Inertia, Spring

ENTRIES = (1e-17, 6e-17, 1e-15, 1e-12, 1e-8, 1e-3)


def slider_crank(axis: Any) -> Model:
    """A slider-crank whose piston slides along an axis in its plane."""

    class SliderCrank(Model):
        world = World()
        hinge, pin, eye = Revolute(phi=fixed(0.5), w=fixed(3)), Revolute(), Revolute()
        crank, rod, piston = BodyBox(r=(0.3, 0, 0), width=0.03), BodyBox(r=(1, 0, 0), width=0.03), Body(m=1)
        rail = Prismatic(n=axis, s=guess(1.2))

        def connections(self):
            yield chain(self.world, self.hinge, self.crank, self.pin, self.rod, self.eye, self.piston)
            yield chain(self.world, self.rail, self.piston)

    return SliderCrank()


def runs(axis: Any) -> tuple[np.ndarray, np.ndarray]:
    """Steps of the runs of a slider-crank at two tolerances, and their errors against one at a tight tolerance."""
    compiled = ac.compile(slider_crank(axis))
    right, *found = (ac.simulate(compiled, stop_time=2, tolerance=t) for t in (1e-11, 1e-6, 1e-8))
    errors = [[np.max(np.abs(r[n] - right[n])) for n in ("hinge.phi", "eye.phi", "rail.s")] for r in found]
    return np.array([r.stats["steps"] for r in found]), np.array(errors)


@pytest.mark.parametrize("entry", ENTRIES)
def test_rail_with_a_small_entry_takes_as_many_steps(entry: float) -> None:
    steps, errors = runs((1, entry, 0))
    exact_steps, exact_errors = runs((1, 0, 0))
    assert np.all(steps <= 1.1 * exact_steps)
    assert np.all(errors <= 2 * exact_errors)


def test_axis_as_users_compute_it() -> None:
    result = ac.simulate(slider_crank((sin(pi / 2), cos(pi / 2), 0)), stop_time=2, tolerance=1e-8)
    assert result["piston.r_0"][-1, 0] == pytest.approx(1.29952429, abs=2e-8)
    assert result.stats["steps"] < 520


def scotch_yoke(entry: float) -> Model:
    """A crank whose pin slides in a slot across a yoke on a rail; both axes are off by an angle."""

    class ScotchYoke(Model):
        world = World(gravity=None)
        hinge, pin = Revolute(phi=fixed(0.7), w=fixed(3)), Revolute(phi=guess(-0.7))
        crank = BodyCylinder(r=(0.2, 0, 0), diameter=0.04)
        slot = Prismatic(n=(-entry, 1, 0), s=guess(-0.1))
        yoke = Body(m=0.8)
        rail = Prismatic(n=(1, entry, 0), s=guess(0.15))

        def connections(self):
            yield chain(self.world, self.hinge, self.crank, self.pin, self.slot, self.yoke)
            yield chain(self.world, self.rail, self.yoke)

    return ScotchYoke()


@pytest.mark.parametrize("entry", ENTRIES)
def test_scotch_yoke_keeps_its_energy(entry: float) -> None:
    # The yoke moves at R w sin(phi), and J w^2 + M (R w sin(phi))^2 stays.
    result = ac.simulate(scotch_yoke(entry), stop_time=3, tolerance=1e-8)
    r, mass = 0.2, 7700 * pi * 0.02**2 * 0.2
    J = mass * (r**2 / 3 + 0.02**2 / 4)
    angle = result["hinge.phi"] - np.arctan(entry)
    inertia = J + 0.8 * (r * np.sin(angle)) ** 2
    assert result["hinge.w"] == pytest.approx(3 * np.sqrt(inertia[0] / inertia), rel=2e-6)
    assert result.stats["steps"] <= 1.1 * ac.simulate(scotch_yoke(0.0), stop_time=3, tolerance=1e-8).stats["steps"]


class Sum(Component):
    """Differential: the third shaft turns by the angle of the first and a fraction of that of the second."""

    first = port(Flange, "first shaft")
    second = port(Flange, "second shaft")
    third = port(Flange, "third shaft")
    fraction: Scalar = parameter("weight of the second shaft", unit="1")

    def equations(self):
        yield self.first.phi + self.fraction * self.second.phi == self.third.phi
        yield self.first.tau == -self.third.tau
        yield self.second.tau == -self.fraction * self.third.tau


class Rotor(Inertia):
    """A rotor whose motion should rather follow from that of others."""

    phi: Scalar = variable("absolute angle", unit="rad", select=AVOID)
    w: Scalar = variable("der(phi)", unit="rad/s", select=AVOID)


def differential(value: float) -> Model:
    """Three rotors on a differential, two of them on springs."""

    class Differential(Model):
        sum = Sum(fraction=value)
        a, b, c = Inertia(J=1, phi=fixed(0), w=fixed(1)), Rotor(J=1, phi=fixed(0.5), w=fixed(3)), Inertia(J=1)
        soft, stiff = Spring(c=30), Spring(c=50)
        ground = Ground()

        def connections(self):
            for shaft, rotor in ((self.sum.first, self.a), (self.sum.second, self.b), (self.sum.third, self.c)):
                yield connect(shaft, rotor.flange_b)
            yield chain(self.c.flange_a, self.soft, self.ground.flange)
            yield chain(self.b.flange_a, self.stiff, self.ground.flange)

    return Differential()


@pytest.mark.parametrize("fraction", ENTRIES)
def test_state_does_not_follow_through_a_small_coefficient(fraction: float) -> None:
    result = ac.simulate(differential(fraction), stop_time=10, tolerance=1e-8)
    M = np.array([[2, fraction], [fraction, 1 + fraction**2]])
    K = np.array([[30, 30 * fraction], [30 * fraction, 50 + 30 * fraction**2]])
    A = np.block([[np.zeros((2, 2)), np.eye(2)], [-np.linalg.solve(M, K), np.zeros((2, 2))]])
    right = scipy.linalg.expm(10 * A) @ (0, 0.5, 1, 3)
    found = [result[name][-1] for name in ("a.phi", "b.phi", "a.w", "b.w")]
    assert found == pytest.approx(right, abs=2e-5)
    assert result.stats["steps"] <= 1.1 * ac.simulate(differential(0.0), stop_time=10, tolerance=1e-8).stats["steps"]


@pytest.mark.parametrize("angle", [1e-17, 1e-12, 1e-3, pi / 2, pi])
def test_turned_machine_moves_alike(angle: float) -> None:
    def turned(value: float) -> Model:
        c, s = cos(value), sin(value)

        class Turned(Model):
            world = World(n=(s, -c, 0))
            hinge, pin, eye = Revolute(phi=fixed(0.5), w=fixed(3)), Revolute(), Revolute()
            crank = BodyCylinder(r=(0.3 * c, 0.3 * s, 0), diameter=0.03)
            rod = BodyCylinder(r=(c, s, 0), diameter=0.03)
            piston, rail = Body(m=1), Prismatic(n=(c, s, 0), s=guess(1.2))

            def connections(self):
                yield chain(self.world, self.hinge, self.crank, self.pin, self.rod, self.eye, self.piston)
                yield chain(self.world, self.rail, self.piston)

        return Turned()

    straight, result = (ac.simulate(turned(a), stop_time=2, tolerance=1e-8) for a in (0.0, angle))
    assert result.stats["steps"] <= 1.1 * straight.stats["steps"]
    assert result["rail.s"] == pytest.approx(straight["rail.s"], abs=1e-7)


def test_rounding_of_axes_counts_as_zero() -> None:
    assert unit_vector((sin(pi / 2), cos(pi / 2), 0)).tolist() == [1, 0, 0]
    assert unit_vector((0, 1e-17, -1e-300)).tolist() == [0, 1, 0]
    assert unit_vector((1e200, 1e188, 0))[1] == pytest.approx(1e-12)
