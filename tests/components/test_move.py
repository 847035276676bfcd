"""Move: angle, speed and acceleration are those of the signal, of which none is differentiated."""

from __future__ import annotations

import numpy as np
import pytest

import acausal as ac
from acausal import Component, Model, chain, connect, cos, der, fixed, input, output, quantity, sin, time
from components import rotational, translational

UNITS = ("m", "m/s", "m/s2")
WAVE = (sin(time), cos(time), -sin(time))


class Reference(Component):
    """Position and speed that are integrated, beside an acceleration that is not theirs."""

    y = output("reference", unit=UNITS, shape=(3,))

    def equations(self):
        yield der(self.y[0]) == self.y[1]
        yield der(self.y[1]) == quantity(3, "m/s2")
        yield self.y[2] == 7


class Followed(Model):
    reference, move = Reference(y=fixed((1, 2, None))), translational.Move()
    mass = translational.Mass(m=2)

    def connections(self):
        yield connect(self.reference.y, self.move.u)
        yield connect(self.move.flange, self.mass.flange_a)


class Driven(Model):
    """A motion that is given from outside."""

    u = input("position, speed and acceleration", unit=UNITS, shape=(3,))
    move, mass = translational.Move(u=u), translational.Mass(m=2)

    def connections(self):
        yield connect(self.move.flange, self.mass.flange_a)


class Series(Model):
    """A drive that stands on a mass that another drive moves."""

    move1, mass1 = rotational.Move(u=WAVE), rotational.Inertia(J=2)
    move2, mass2 = rotational.Move(use_support=True, u=tuple(2 * x for x in WAVE)), rotational.Inertia(J=1)

    def connections(self):
        yield chain(self.move1.flange, self.mass1, self.move2.support)
        yield connect(self.move2.flange, self.mass2.flange_a)


class Floating(Model):
    """A drive between two masses, of which none is held."""

    move, one, other = translational.Move(use_support=True, u=WAVE), translational.Mass(m=2), translational.Mass(m=3)

    def connections(self):
        yield connect(self.move.flange, self.one.flange_a)
        yield connect(self.move.support, self.other.flange_a)


class OnDamper(Model):
    """The speed alone acts on a massless part."""

    move, damper, wall = translational.Move(u=(1, 2, 5)), translational.Damper(d=3), translational.Fixed()

    def connections(self):
        yield chain(self.move.flange, self.damper, self.wall.flange)


def test_all_levels_are_those_of_the_signal():
    """Here its acceleration is not the derivative of its speed."""
    result = ac.simulate(Followed(), stop_time=2, tolerance=1e-9)
    t = result.time
    np.testing.assert_allclose(result["mass.s"], 1 + 2 * t + 1.5 * t**2, rtol=1e-7)
    np.testing.assert_allclose(result["mass.v"], 2 + 3 * t, rtol=1e-7)
    np.testing.assert_allclose(result["mass.a"], 7)
    np.testing.assert_allclose(result["mass.flange_a.f"], 14)


def test_an_input_of_the_whole_model_needs_no_derivative():
    compiled = ac.compile(Driven())
    assert compiled.states == ()
    result = ac.simulate(compiled, stop_time=1, parameters={"u": (1, 2, 5)})
    assert result["mass.s"][-1] == 1
    assert result["mass.v"][-1] == 2
    assert result["mass.flange_a.f"][-1] == pytest.approx(10)


def test_drives_in_series_add():
    result = ac.simulate(Series(), stop_time=2)
    t = result.time
    np.testing.assert_allclose(result["mass2.phi"], 3 * np.sin(t), atol=1e-12)
    np.testing.assert_allclose(result["mass2.flange_a.tau"], -3 * np.sin(t), atol=1e-12)
    np.testing.assert_allclose(result["move1.flange.tau"], 5 * np.sin(t), atol=1e-12)


def test_between_masses_their_centre_stays():
    parts = {"other": translational.Mass(m=3, s=fixed(0), v=fixed(-0.4))}
    result = ac.simulate(Floating(**parts), stop_time=2, tolerance=1e-9)
    t = result.time
    np.testing.assert_allclose(result["one.s"], 0.6 * np.sin(t), atol=1e-7)
    np.testing.assert_allclose(result["other.s"], -0.4 * np.sin(t), atol=1e-7)


def test_on_a_damper():
    result = ac.simulate(OnDamper(), stop_time=1)
    assert result["damper.flange_a.f"][-1] == pytest.approx(6)
    assert result["move.v"][-1] == pytest.approx(2)
