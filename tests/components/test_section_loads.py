"""Moments in the sections of a beam that alpha brakes: E J times the curvature, by the theory of beams."""

from __future__ import annotations

import numpy as np
import pytest

import acausal as ac
from acausal import Model, as_expr, chain, connect, initial, structural
from components import FlexibleBeam, World, WorldForce

E, J, LENGTH, COUNT = 5e7, 3.2e-7, 0.5, 8


class Released(Model):
    """A cantilever whose load ends at the start."""

    reference: str = structural("reference frame", default="tangent")
    alpha: float = structural("mass-proportional damping", default=0.0)
    world, load = World(gravity=None), WorldForce()
    beam = FlexibleBeam(
        length=LENGTH, E=E, rho=1100, A=24e-4, J=J, elements=COUNT, alpha=alpha, reference=reference, initial="static"
    )

    def connections(self):
        yield chain(self.world, self.beam)
        yield connect(self.load.frame_b, self.beam.frame_b)

    def equations(self):
        yield self.load.force == as_expr((0.0, 1.0 * initial, 0.0))


@pytest.mark.parametrize("reference", ["tangent", "pinned"])
@pytest.mark.parametrize("alpha", [0.0, 20.0, 2000.0])
def test_moments_are_those_of_the_curvature(alpha: float, reference: str) -> None:
    result = ac.simulate(Released(alpha=alpha, reference=reference), stop_time=0.05, tolerance=1e-9, intervals=50)
    l, (_, v, slope) = LENGTH / COUNT, np.moveaxis(result["beam.node_deflection"], 2, 0)
    ends = 6 * (v[:, :-1] - v[:, 1:]) / l**2 + 2 * (slope[:, :-1] + 2 * slope[:, 1:]) / l
    starts = 6 * (v[:, 1:] - v[:, :-1]) / l**2 - 2 * (2 * slope[:, :-1] + slope[:, 1:]) / l
    inside = (ends[1:, :-1] + starts[1:, 1:]) / 2  # of cubic elements, the mean counts
    moment = result["beam.node_moment"][1:, 1:-1, 2]
    assert np.abs(moment - E * J * inside).max() < 0.02 * np.abs(moment).max()


@pytest.mark.parametrize("reference", ["tangent", "pinned"])
def test_ends_bear_the_drag_that_acts_on_the_reference_frame(reference: str) -> None:
    """Drag is an inner force: what it does to the beam beside the forces of the frames is balanced."""
    result = ac.simulate(Released(alpha=2000.0, reference=reference), stop_time=0.05, tolerance=1e-9, intervals=50)
    force, clamp = result["beam.node_force"][:, 0, 1], -result["beam.frame_a.f"][:, 1]
    tip = result["beam.node_force"][:, -1, 1]
    assert np.abs(force - clamp).max() > 0.1 * np.abs(clamp).max()  # the rest of it acts on the root
    assert (np.abs(tip[1:]).max() > 1e-3 * np.abs(force).max()) == (reference == "pinned")
