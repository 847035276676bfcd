"""Equilibria near the guesses, where Newton's steps lead turns away or to another assembly of a loop."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.optimize import brentq

import acausal as ac
from acausal import Model, chain, guess, structural
from components import BodyRod, Revolute, World, rotational
from models import FourBar


class Hanging(FourBar):
    """Its damped motion from there ends in the same place."""

    j1 = Revolute(use_axis_flange=True, phi=guess(-1))


def test_a_four_bar_keeps_its_assembly():
    result = ac.simulate(Hanging(), stop_time=1.0, initial="steady")
    assert result["j1.phi"][0] == pytest.approx(-1.78386, abs=1e-5)
    assert result["j3.phi"][0] == pytest.approx(-0.78557, abs=1e-5)
    assert np.max(np.abs(result["j1.phi"] - result["j1.phi"][0])) < 1e-10


class Sprung(Model):
    """A rod on a hinge with a weak torsion spring, which can rest in several turns."""

    first: float = structural("guess of the angle", default=0.0)
    c: float = structural("stiffness of the spring", default=0.2)
    world = World()
    hinge = Revolute(phi=guess(first), use_axis_flange=True)
    rod = BodyRod(r=(1, 0, 0), m=1)
    spring = rotational.Spring(c=c)

    def connections(self):
        yield chain(self.world, self.hinge, self.rod)
        yield chain(self.hinge.support, self.spring, self.hinge.axis)


@pytest.mark.parametrize("c", [0.05, 0.2, 0.5])
@pytest.mark.parametrize("first", [-1.0, -0.3, 0.0, 0.3, 0.6])
def test_a_rod_hangs_where_it_falls(c, first):
    expected = brentq(lambda phi: 9.80665 * 0.5 * np.cos(phi) + c * phi, -np.pi, 0.0)
    result = ac.simulate(Sprung(first=first, c=c), stop_time=0.1, initial="steady")
    assert result["hinge.phi"][0] == pytest.approx(expected, abs=1e-6)


class Double(Model):
    """Two rods that nothing brakes: on their way down they whirl."""

    first: float = structural("guess of the upper angle", default=1.5)
    world = World()
    upper, lower = Revolute(phi=guess(first)), Revolute(phi=guess(0.1))
    rods = tuple(BodyRod(r=(1, 0, 0), m=1) for _ in range(2))

    def connections(self):
        yield chain(self.world, self.upper, self.rods[0], self.lower, self.rods[1])


@pytest.mark.parametrize("stop_time", [0.1, 1.0, 30.0])
@pytest.mark.parametrize("first", [1.5, 0.7, 4.0])
def test_whole_turns_are_taken_back(first: float, stop_time: float) -> None:
    result = ac.simulate(Double(first=first), stop_time=stop_time, intervals=1, initial="steady")
    assert result["upper.phi"][0] == pytest.approx(-np.pi / 2 if first < np.pi / 2 else 3 * np.pi / 2)
    assert result["lower.phi"][0] == pytest.approx(0, abs=1e-9)
