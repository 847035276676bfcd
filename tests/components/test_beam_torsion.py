"""Torsion of beams: inertia about the axis, rigid and elastic."""

from __future__ import annotations

import numpy as np
import pytest

import acausal as ac
from acausal import Model, chain, connect, fixed, part, structural
from components import FlexibleBeam, Revolute, World, WorldTorque
from tests.components.test_beam import RUBBER, Swing
from tests.shared import pairwise


class Twisted(Model):
    """A torque about the axis of a straight beam that nothing holds."""

    kind = structural("values of the beam", default=None)
    world = World(gravity=None)
    hinge = Revolute(n=(1, 0, 0), phi=fixed(0.0), w=fixed(0.0))
    torque = WorldTorque(torque=(0.4, 0.0, 0.0))

    @part
    def beam(self):
        """The beam."""
        return FlexibleBeam(**RUBBER, **self.kind)

    def connections(self):
        yield chain(self.world, self.hinge, self.beam)
        yield connect(self.torque.frame_b, self.beam.frame_b)


@pytest.mark.parametrize("reference", ["tangent", "pinned"])
@pytest.mark.parametrize(
    ("given", "inertia"),
    [({}, 2 * 1000.0 * 1e-7), ({"J_y": 3e-7}, 1000.0 * 4e-7), ({"torsional_inertia": 0.02, "J_y": 3e-7}, 0.02)],
)
@pytest.mark.parametrize("rotary_inertia", [False, pytest.param(True, marks=pytest.mark.slow)])
def test_torsional_inertia(reference, given, inertia, rotary_inertia):
    kind = {"reference": reference, "torsion": False, "rotary_inertia": rotary_inertia} | given
    result = ac.simulate(Twisted(kind=kind), stop_time=0.1, intervals=2)
    np.testing.assert_allclose(result["hinge.a"], 0.4 / inertia, rtol=1e-9)
    np.testing.assert_allclose(result["beam.torsional_inertia"], inertia, rtol=1e-12)


@pytest.mark.parametrize(("reference", "rotary_inertia"), pairwise(("tangent", "pinned"), (False, True)))
def test_elastic_torsion(reference, rotary_inertia):
    """The spin of all sections grows with the torque, while the tip runs ahead of the root by the waves of a rod."""
    kind = {"elements": 8, "reference": reference, "rotary_inertia": rotary_inertia}
    given = {"torsional_inertia": 0.02, "J_y": 3e-7, "beta": 0.05}
    result = ac.simulate(Twisted(kind=kind | given), stop_time=1.0, tolerance=1e-8, intervals=10)
    phi, free = result["beam.node_deflection"][:, :, 3], result.tree.beam.free
    rates = np.zeros((11, 54))
    rates[:, free] = result["beam.qd"]
    if reference == "pinned":
        rates[:, 5] = -rates[:, -1]
    root = result["hinge.w"] - rates[:, 5]
    weights = np.r_[0.5, np.ones(7), 0.5] / 8
    np.testing.assert_allclose(0.02 * (root + rates[:, 5::6] @ weights), 0.4 * result.time, atol=1e-6)
    # Steadily accelerated, the torque falls linearly from the tip to the root: x^2 / (2 L) of its twist.
    twist = 0.4 / (1e7 / 2.6 * 4e-7) / 2
    np.testing.assert_allclose(phi[-1, -1] - phi[-1, 0], twist, rtol=1e-3)


def test_torsional_inertia_is_shared_by_the_volumes():
    result = ac.simulate(Swing(kind={}, volumes=4), stop_time=0.01, intervals=1)
    shares = [result[f"beam.volume[{k}].torsional_inertia"][0] for k in range(4)]
    np.testing.assert_allclose(shares, 2 * 1000.0 * 1e-7 / 4, rtol=1e-12)
