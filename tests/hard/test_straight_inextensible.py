"""Beams of constant length between walls: their closure depends on bending by its square alone, and holds nevertheless."""

from __future__ import annotations

import numpy as np
import pytest

import acausal as ac
from acausal import Model, chain, structural
from components import Body, Fixed, FlexibleBeam, Prismatic, World

BEAM = {"length": 1.0, "E": 7e10, "rho": 2700.0, "A": 1e-4, "J": 8e-10, "elements": 4, "beta": 1e-3}


class Clamped(Model):
    axial: str = structural("axial motion", default="none")
    world = World(g=981.0)
    beam = FlexibleBeam(**BEAM, axial=axial, geometric_stiffness=True)
    wall = Fixed(r=(1.0, 0, 0))

    def connections(self):
        yield chain(self.world, self.beam, self.wall.frame_b)


class Across(Model):
    """From a mass on a rail across to the wall."""

    axial: str = structural("axial motion", default="none")
    world = World(g=9.81)
    rail = Prismatic(n=(0, 1, 0))
    mass = Body(m=1.0)
    beam = FlexibleBeam(**BEAM, axial=axial, geometric_stiffness=True)
    wall = Fixed(r=(1.0, 0, 0))

    def connections(self):
        yield chain(self.world, self.rail, self.mass)
        yield chain(self.rail, self.beam, self.wall.frame_b)


@pytest.mark.parametrize("scene", [Clamped, Across])
@pytest.mark.parametrize("axial", ["none", "quasi_static"])
@pytest.mark.parametrize("method", ["auto", "idas"])
def test_what_cannot_bend_without_shortening_is_refused(scene, axial, method):
    with pytest.raises(ac.InitializationError, match="singular configuration"):
        ac.simulate(scene(axial=axial), stop_time=0.1, initial="guesses", method=method)


@pytest.mark.parametrize("scene", [Clamped, Across])
def test_what_stretches_keeps_its_ends_where_they_are_connected(scene):
    result = ac.simulate(scene(axial="dynamic"), stop_time=0.1, initial="guesses", tolerance=1e-4, intervals=50)
    start = result["rail.frame_b.r_0"] if scene is Across else np.zeros((51, 3))
    np.testing.assert_allclose(result["beam.frame_b.r_0"], np.tile([1.0, 0, 0], (51, 1)), atol=1e-8)
    np.testing.assert_allclose(result["beam.frame_a.r_0"], start, atol=1e-8)
    assert np.max(np.abs(result["beam.frame_b.f"][:, 0])) > 1.0
