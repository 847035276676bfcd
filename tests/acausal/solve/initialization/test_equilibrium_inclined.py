"""Loops of beams that only ranks show to be planar come to rest as those in a plane of coordinates do."""

from __future__ import annotations

import numpy as np
import pytest

import acausal as ac
from acausal import Model, Scalar, chain, connect, part, structural
from components import FixedRotation, FixedTranslation, FlexibleBeam, World, WorldForce

E, RHO, A, J, WIDTH = 2e11, 7800, 1e-4, 8e-10, 1.5
HALF = np.pi / 2
BEAM = {"E": E, "rho": RHO, "A": A, "initial": "free"}


class Portal(Model):
    """Two clamped columns and a beam, pushed sideways, in a plane turned about a skew axis."""

    tilt: Scalar = structural("angle of the plane, rad", default=0.0)
    n: int = structural("elements of each beam", default=4)
    world, foot = World(gravity=None), FixedTranslation(r=(WIDTH, 0, 0))
    left = FlexibleBeam(length=1, J=J, elements=n, **BEAM)
    right = FlexibleBeam(length=1, J=J, elements=n, **BEAM)
    beam = FlexibleBeam(length=WIDTH, J=2 * J, elements=n, reference="tangent", **BEAM)
    up, corner, down, clamp = (FixedRotation(n=(0, 0, 1), angle=angle) for angle in (HALF, -HALF, -HALF, -HALF))
    push = WorldForce(resolve_in_frame="frame_b")

    @part
    def plane(self):
        """Turns all of it."""
        return FixedRotation(n=(1, 2, 3), angle=self.tilt)

    def connections(self):
        yield chain(self.world, self.plane, self.up, self.left, self.corner, self.beam)
        yield chain(self.beam, self.down, self.right, self.clamp.frame_b)
        yield chain(self.plane, self.foot, self.clamp)
        yield connect(self.push.frame_b, self.corner.frame_b)

    def equations(self):
        yield self.push.force == (1, 0, 0)


@pytest.mark.parametrize("tilt", [0.0, 0.3, 0.7, 2.0])
@pytest.mark.parametrize("n", [4, pytest.param(16, marks=pytest.mark.slow)])
def test_a_portal_sways_alike_in_every_plane(tilt: float, n: int) -> None:
    """Slope deflection of a clamped portal: F h^3 (3 k + 2) / (12 E J (6 k + 1)), k = 2 J h / (J b).

    With 16 elements rounding accelerates modes by 3e-5 m/s2.
    """
    result = ac.simulate(Portal(tilt=tilt, n=n), stop_time=0.01, initial="steady", intervals=2, tolerance=1e-8)
    k = 2 / WIDTH
    sway = (3 * k + 2) / (12 * E * J * (6 * k + 1))
    assert np.allclose(-result["left.node_deflection"][:, -1, 1], sway, rtol=1e-3)
