"""Rods whose length is the distance of their ends at the start."""

from __future__ import annotations

import numpy as np
import pytest

import acausal as ac
from acausal import DeclarationError, Model, chain, fixed, guess
from components import (
    BodyCylinder,
    FixedTranslation,
    Prismatic,
    Revolute,
    SphericalSpherical,
    World,
)

LENGTH = np.sqrt(1.0**2 + 0.3**2 + 0.1**2)  # from (1, 0.2, 0) to (0, 0.5, 0.1)


class FourBar(Model):
    """A crank about x drives a slide along x through a rod."""

    world, b3 = World(), FixedTranslation(r=(1.2, 0, 0))
    j1, j2 = Revolute(n=(1, 0, 0), phi=fixed(0), w=fixed(5)), Prismatic(n=(1, 0, 0), s=fixed(-0.2))
    b1, b2 = BodyCylinder(r=(0, 0.5, 0.1), diameter=0.05), BodyCylinder(r=(0, 0.2, 0), diameter=0.05)

    def connections(self):
        yield chain(self.world, self.j1, self.b1, self.rod.frame_b)
        yield chain(self.world, self.b3, self.j2, self.b2, self.rod.frame_a)


class Balls(FourBar):
    rod = SphericalSpherical(compute_rod_length=True, m=1)


KNOWN = SphericalSpherical(rod_length=LENGTH, m=1)


def test_the_motion_is_that_with_the_length_known():
    """At the start all positions are given, none of them follows from the length."""
    result = ac.simulate(Balls(), stop_time=1, tolerance=1e-8, energy=True)
    expected = ac.simulate(Balls(rod=KNOWN, j2=Prismatic(n=(1, 0, 0), s=guess(-0.2))), stop_time=1, tolerance=1e-8)
    length = np.linalg.norm(result["rod.frame_b.r_0"] - result["rod.frame_a.r_0"], axis=1)
    np.testing.assert_allclose(length, LENGTH, rtol=1e-7)
    for name in ("j1.phi", "j2.s"):
        assert np.ptp(expected[name]) > 0.1
        np.testing.assert_allclose(result[name], expected[name], atol=2e-6)
    assert abs(result.stats["energy_method"]) < 1e-4


def test_the_length_is_a_result():
    result = ac.simulate(Balls(), stop_time=0.1)
    np.testing.assert_allclose(result["rod.length"], LENGTH, rtol=1e-6)
    known = ac.simulate(Balls(rod=KNOWN, j2=Prismatic(n=(1, 0, 0), s=guess(-0.2))), stop_time=0.1)
    np.testing.assert_allclose(known["rod.length"], LENGTH)


def test_another_start_gives_another_length():
    result = ac.simulate(Balls(j2=Prismatic(n=(1, 0, 0), s=fixed(-0.5))), stop_time=0.1)
    np.testing.assert_allclose(result["rod.length"], np.sqrt(0.7**2 + 0.3**2 + 0.1**2), rtol=1e-6)


def test_a_length_is_needed_otherwise():
    with pytest.raises(DeclarationError, match="rod_length"):
        ac.compile(Balls(rod=SphericalSpherical(m=1)))
