"""The car of models.vehicle: linkage, equilibrium, energy, symmetry, steering, and a part that is replaced."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from scipy.optimize import least_squares
from scipy.spatial.transform import Rotation

import acausal as ac
from acausal import Model, chain, connect, exp, fixed, part
from acausal.flatten.component_tree import walk
from components import (
    Body,
    FixedTranslation,
    Prismatic,
    SphericalSpherical,
    SpringDamperParallel,
    World,
)
from models.vehicle import Car, Corner, DoubleWishbone
from tests.shared import compiled

G = 9.80665
CORNERS = [f"{axle}.{side}" for axle in ("front", "rear") for side in ("right", "left")]
EVEN = {"bump": 1e-9, "travel": 1e-9}  # not 0: the model is compiled once


class Quarter(Model):
    """A quarter of the car on one corner, at 20 m/s over a bump."""

    world = World()
    road, lift = Prismatic(n=(1, 0, 0), s=fixed(0), v=fixed(20)), Prismatic(n=(0, 1, 0), s=fixed(0.0037), v=fixed(0))
    chassis, tie = Body(m=252.5), FixedTranslation(r=(-0.12, 0.25, 0.38))

    @part
    def corner(self) -> Any:
        return Corner(v=20, preload=3658, height=lambda x, y: 0.03 * exp(-(((x - 3) / 0.5) ** 2)))

    def connections(self):
        yield chain(self.world, self.road, self.lift, self.chassis)
        yield chain(self.lift, self.tie, self.corner.frame_tie)
        yield connect(self.lift.frame_b, self.corner.frame_a)


def closures(x: np.ndarray, lower: float) -> np.ndarray:
    """What is open of the upper arm and of the tie rod, with the angles of the upper arm and of the upright."""
    at, ball, upper, top = (0, 0.2, 0.35), np.array([0, 0.2, 0.7]), (0, 0.45, 0.42), np.array([0, 0.45, 0.68])
    low, turned = (Rotation.from_euler("x", angle) for angle in (lower, lower + x[1]))
    upright = turned * Rotation.from_euler("ZY", x[2:])
    place = at + low.apply(ball - at)
    gap = place + upright.apply(top - ball) - upper - Rotation.from_euler("x", x[0]).apply(top - upper)
    rod = place + upright.apply(np.array([-0.12, 0.25, 0.7]) - ball) - (-0.12, 0.25, 0.38)
    return np.array([*gap, rod @ rod - 0.32**2])


def test_corner_moves_as_its_linkage_does():
    """Angles of the arms and the upright against a solution of the loop; the load is the weight at first."""
    result = ac.simulate(Quarter(), stop_time=0.5, tolerance=1e-6, intervals=10)
    assert result["corner.wheel.tyre.f_z"][0] == pytest.approx((252.5 + 45) * G, rel=5e-3)
    assert np.ptp(result["corner.suspension.lower.bearing.phi"]) > 0.05
    names = ("upper.bearing.phi", "tilt.phi_a", "tilt.phi_b", "steer.phi")
    angles = np.stack([result[f"corner.suspension.{name}"] for name in names], axis=1)
    for lower, found in zip(result["corner.suspension.lower.bearing.phi"], angles, strict=True):
        solved = least_squares(closures, np.zeros(4), args=(lower,), xtol=1e-15, ftol=None, gtol=None).x
        np.testing.assert_allclose(found, solved, atol=1e-6)


def loads(result: ac.Result) -> np.ndarray:
    """Load of each wheel over time."""
    return np.array([result[f"{corner}.wheel.tyre.f_z"] for corner in CORNERS])


def weight(result: ac.Result) -> float:
    """Weight of the whole car."""
    return G * sum(result[c.m][0] for c in walk(result.tree) if isinstance(c, Body | SphericalSpherical))


@pytest.mark.slow
def test_it_stands_on_its_wheels():
    """On an even road the loads are equal and carry the weight, and the car runs straight on."""
    result = ac.simulate(compiled(Car), stop_time=1.0, tolerance=1e-6, parameters=EVEN)
    np.testing.assert_allclose(loads(result)[:, 0], weight(result) / 4, rtol=0.01)
    np.testing.assert_allclose(loads(result).sum(axis=0), weight(result), rtol=0.01)
    np.testing.assert_allclose(result["y"], result["y"][0], atol=2e-4)
    np.testing.assert_allclose(result["yaw_rate"], 0, atol=1e-6)
    np.testing.assert_allclose(result["chassis.v_0"][:, 0], 20, rtol=1e-4)


@pytest.mark.slow
def test_it_passes_the_bump_and_the_energy_balances():
    """More than 20 bodies, one freedom for each suspension and each wheel; wheels lift off behind the bump."""
    model = compiled(Car)
    bodies = [c for c in walk(model.tree) if isinstance(c, Body | SphericalSpherical)]
    assert len(bodies) > 20
    result = ac.simulate(model, stop_time=0.5, tolerance=1e-6, intervals=100, energy=True)
    assert loads(result).max() > 1.5 * weight(result) / 4
    assert loads(result).min() < 1e-6
    assert 0.01 < result["y"].max() < 0.05
    assert result.stats["energy_dissipated"] > 300
    assert abs(result.stats["energy_method"]) < 1e-3 * result.stats["energy_dissipated"]


@pytest.mark.slow
def test_rack_to_the_right_turns_left_and_the_mirror_image_turns_right():
    left, right = (
        ac.simulate(compiled(Car), stop_time=0.6, tolerance=1e-6, parameters={"travel": travel})
        for travel in (2e-3, -2e-3)
    )
    assert left["yaw_rate"].max() > 0.05
    np.testing.assert_allclose(right["yaw_rate"], -left["yaw_rate"], atol=1e-5)
    np.testing.assert_allclose(right["chassis.r_0"][:, 2], -left["chassis.r_0"][:, 2], atol=1e-5)
    np.testing.assert_allclose(loads(right)[[1, 0, 3, 2]], loads(left), atol=1)


class Stiff(DoubleWishbone):
    """A suspension with another strut."""

    @part
    def strut(self) -> Any:
        return SpringDamperParallel(c=2 * self.c, d=2 * self.d, s_unstretched=0.4657 + self.preload / self.c / 2)


class Sporty(Quarter):
    """The quarter of the car with that suspension."""

    @part
    def corner(self) -> Any:
        class Firm(Corner):
            suspension = part(lambda s: Stiff(side=s.side, preload=s.preload))

        return Firm(v=20, preload=3658, height=lambda x, y: 0.03 * exp(-(((x - 3) / 0.5) ** 2)))


def test_strut_is_replaced():
    """With another class in an assembly two levels down; the rest is handed down as before."""
    plain, firm = (ac.simulate(model(), stop_time=0.3, tolerance=1e-6) for model in (Quarter, Sporty))
    assert firm["corner.suspension.strut.c"][0] == 8e4
    travel = [np.ptp(result["corner.suspension.lower.bearing.phi"]) for result in (plain, firm)]
    assert travel[1] < 0.8 * travel[0]
