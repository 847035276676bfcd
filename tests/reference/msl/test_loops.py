"""Spatial four-bars of ModelicaTest.MultiBody.FourbarVariants."""

from __future__ import annotations

from acausal import Model, chain, connect, fixed, guess
from components import (
    BodyCylinder,
    FixedTranslation,
    Prismatic,
    Revolute,
    Spherical,
    SphericalSpherical,
    Universal,
    UniversalSpherical,
    World,
)
from tests.reference.msl.published import compare

VARIANTS = "ModelicaTest.MultiBody.FourbarVariants."


class FourBar(Model):
    """A crank about x drives a slide along x through a rod."""

    world, b3 = World(), FixedTranslation(r=(1, 0, 0))
    j1, j2 = Revolute(n=(1, 0, 0), phi=fixed(0), w=fixed(5.235987755982989)), Prismatic(n=(1, 0, 0), s=guess(0))
    b1, b2 = BodyCylinder(r=(0, 0.5, 0.1), diameter=0.05), BodyCylinder(r=(0, 0.2, 0), diameter=0.05)

    def connections(self):
        yield chain(self.world, self.j1, self.b1)
        yield chain(self.world, self.b3, self.j2, self.b2)
        yield from self.rod_connections()


class BallRod(FourBar):
    j2 = Prismatic(n=(1, 0, 0), s=fixed(0))
    rod = SphericalSpherical(compute_rod_length=True, m=1)

    def rod_connections(self):
        yield connect(self.b1.frame_b, self.rod.frame_b)
        yield connect(self.rod.frame_a, self.b2.frame_b)


def test_spherical_spherical():
    compare(VARIANTS + "SphericalSpherical", BallRod())


class BallAndUniversal(FourBar):
    spherical, rod, universal = (
        Spherical(),
        FixedTranslation(r=(1, -0.3, -0.1)),
        Universal(n_a=(0, 0, 1), n_b=(0, 1, 0)),
    )

    def rod_connections(self):
        yield chain(self.b1, self.spherical, self.rod, self.universal)
        yield connect(self.universal.frame_b, self.b2.frame_b)


def test_spherical_and_universal():
    compare(VARIANTS + "SphericalAndUniversal", BallAndUniversal())


class RodOfBoth(FourBar):
    """The same rod as one part."""

    rod = UniversalSpherical(n1_a=(0, 1, 0), r_rod_ia=(-1, 0.3, 0.1))

    def rod_connections(self):
        yield connect(self.rod.frame_a, self.b2.frame_b)
        yield connect(self.rod.frame_b, self.b1.frame_b)


def test_universal_spherical():
    compare(VARIANTS + "SphericalAndUniversal", RodOfBoth())
