"""Contacts with height profiles: energy, the highest position that touches, pendulums in valleys."""

from __future__ import annotations

import numpy as np
import pytest

import acausal as ac
from acausal import sin
from components.contact import PointOnProfile, SphereOnProfile
from tests.components.test_contact import Ball


def test_a_point_slides_in_a_valley():
    """Along x and z, without friction, from rest on the slope: energy, and the height of the ground where it is."""
    k, g = 1e6, 9.81
    it = PointOnProfile(k=k, height=lambda r: 0.5 * r[0] ** 2 + r[2] ** 2, dissipation=0.01)
    result = ac.simulate(Ball(it=it, g=g, r=(0.2, 0.03, 0.1)), stop_time=2.0, tolerance=1e-8, energy=True)
    x, y, z = result["body.r_0"].T
    np.testing.assert_allclose(y, 0.5 * x**2 + z**2, atol=1e-3)
    assert np.ptp(x) > 0.3
    assert np.ptp(z) > 0.15
    energy = np.sum(result["body.v_0"] ** 2, axis=1) / 2 + g * y + k * np.maximum(result["it.x"], 0) ** 2 / 2
    lost = result.stats["energy_dissipated"]
    assert 0 < lost < 1e-2
    assert energy[0] - energy[-1] == pytest.approx(lost, abs=1e-6)


def test_a_place_on_a_profile_has_the_frequency_of_its_curvature():
    linear = ac.linearize(
        Ball(it=PointOnProfile(k=1e8, height=lambda r: 0.5 * r[0] ** 2 + r[2] ** 2), g=9.81, r=(0, -9.81e-8, 0))
    )
    expected = np.sqrt([9.81, 2 * 9.81, 1e8]) / (2 * np.pi)
    np.testing.assert_allclose(linear.frequencies_hz, expected, rtol=1e-5)


def test_a_sphere_on_waves():
    """The depth below the highest position at which the sphere touches some point of the ground; without losses."""
    R, g, k = 0.1, 9.81, 1e6
    it = SphereOnProfile(k=k, radius=R, height=lambda r: 0.04 * sin(5 * r[0]) + 0.1 * r[2])
    result = ac.simulate(Ball(it=it, g=g, r=(0.1, 0.2, 0), v=(1, 0, 0.2)), stop_time=1.5, tolerance=1e-9)
    x, y, z = result["body.r_0"].T
    q = np.linspace(-R, R, 4001)[1:-1]
    # Across a slope that is uniform along z, the section of the sphere's reach is widened by its inclination.
    reach = np.sqrt(R**2 - q**2) * np.sqrt(1.01)
    highest = [np.max(0.04 * np.sin(5 * (place + q)) + reach) for place in x]
    np.testing.assert_allclose(result["it.x"], highest + 0.1 * z - y, atol=1e-6)
    assert np.max(result["it.x"]) > 1e-4
    assert np.ptp(x) > 1
    energy = np.sum(result["body.v_0"] ** 2, axis=1) / 2 + g * y + k * np.maximum(result["it.x"], 0) ** 2.5 / 2.5
    np.testing.assert_allclose(energy, energy[0], rtol=1e-5)


def test_a_sphere_in_a_valley_is_a_pendulum():
    """Its length is the radius of curvature less that of the sphere."""
    it = SphereOnProfile(k=1e10, radius=0.1, height=lambda r: 0.5 * r[0] ** 2 + r[2] ** 2)
    linear = ac.linearize(Ball(it=it, g=9.81, r=(0, 0.1 - (9.81e-10) ** (2 / 3), 0)))
    expected = np.sqrt([9.81 / 0.9, 9.81 / 0.4]) / (2 * np.pi)
    np.testing.assert_allclose(linear.frequencies_hz[:2], expected, rtol=1e-5)
