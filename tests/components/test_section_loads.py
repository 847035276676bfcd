"""Moments in the sections of a beam that alpha brakes: E J times the curvature, by the theory of beams."""

from __future__ import annotations

import numpy as np
import pytest

import acausal as ac
from acausal import Model, as_expr, chain, connect, initial, structural
from components import FlexibleBeam, World, WorldForce, WorldTorque

E, J, LENGTH, COUNT = 5e7, 3.2e-7, 0.5, 8
J_Y, J_T, G = 2 * J, 0.6 * J, 2e7


class Released(Model):
    """A cantilever whose load ends at the start."""

    reference: str = structural("reference frame", default="tangent")
    alpha: float = structural("mass-proportional damping", default=0.0)
    beta: float = structural("stiffness-proportional damping", default=0.0)
    world, load, turn = World(gravity=None), WorldForce(), WorldTorque()
    beam = FlexibleBeam(
        length=LENGTH,
        E=E,
        G=G,
        rho=1100,
        A=24e-4,
        J=J,
        J_y=J_Y,
        J_t=J_T,
        elements=COUNT,
        alpha=alpha,
        beta=beta,
        reference=reference,
        initial="static",
    )

    def connections(self):
        yield chain(self.world, self.beam)
        yield connect(self.load.frame_b, self.beam.frame_b)
        yield connect(self.turn.frame_b, self.beam.frame_b)

    def equations(self):
        yield self.load.force == as_expr((0.0, 1.0 * initial, 0.7 * initial))
        yield self.turn.torque == as_expr((0.1 * initial, 0.0, 0.0))


@pytest.mark.parametrize("reference", ["tangent", "pinned"])
@pytest.mark.parametrize("alpha", [0.0, 20.0, 2000.0])
def test_moments_are_those_of_the_curvature(alpha: float, reference: str) -> None:
    result = ac.simulate(Released(alpha=alpha, reference=reference), stop_time=0.05, tolerance=1e-9, intervals=50)
    l, (_, v, w, _, turn, slope) = LENGTH / COUNT, np.moveaxis(result["beam.node_deflection"], 2, 0)
    for axis, deflection, angle, EJ in ((2, v, slope, E * J), (1, w, -turn, -E * J_Y)):
        ends = 6 * (deflection[:, :-1] - deflection[:, 1:]) / l**2 + 2 * (angle[:, :-1] + 2 * angle[:, 1:]) / l
        starts = 6 * (deflection[:, 1:] - deflection[:, :-1]) / l**2 - 2 * (2 * angle[:, :-1] + angle[:, 1:]) / l
        inside = (ends[1:, :-1] + starts[1:, 1:]) / 2  # of cubic elements, the mean counts
        moment = result["beam.node_moment"][1:, 1:-1, axis]
        assert np.abs(moment).max() > 0.01
        assert np.abs(moment - EJ * inside).max() < 0.02 * np.abs(moment).max()


@pytest.mark.parametrize("reference", ["tangent", "pinned"])
def test_torques_are_those_of_the_twist(reference: str) -> None:
    """Of linear elements, that of each is the mean between its nodes."""
    result = ac.simulate(Released(beta=1e-3, reference=reference), stop_time=0.05, tolerance=1e-9, intervals=500)
    phi, torque = result["beam.node_deflection"][1:, :, 3], result["beam.node_moment"][1:, :, 0]
    inside = G * J_T * np.diff(phi, axis=1) * COUNT / LENGTH
    rate = np.gradient(inside, result.time[1:], axis=0)
    mean = (torque[:, 1:] + torque[:, :-1]) / 2
    off = mean - inside - 1e-3 * rate
    later = result.time[1:] > 0.01  # the front of the release has gone through
    assert np.abs(torque[later]).max() > 0.05
    assert np.abs(off[later]).max() < 0.02 * np.abs(torque[later]).max()


@pytest.mark.parametrize("reference", ["tangent", "pinned"])
def test_ends_bear_the_drag_that_acts_on_the_reference_frame(reference: str) -> None:
    """Drag is an inner force: what it does to the beam beside the forces of the frames is balanced."""
    result = ac.simulate(Released(alpha=2000.0, reference=reference), stop_time=0.05, tolerance=1e-9, intervals=50)
    force, clamp = result["beam.node_force"][:, 0, 1], -result["beam.frame_a.f"][:, 1]
    tip = result["beam.node_force"][:, -1, 1]
    assert np.abs(force - clamp).max() > 0.1 * np.abs(clamp).max()  # the rest of it acts on the root
    assert (np.abs(tip[1:]).max() > 1e-3 * np.abs(force).max()) == (reference == "pinned")
