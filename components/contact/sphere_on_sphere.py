"""SphereOnSphere: contact of two spheres."""

from __future__ import annotations

from typing import ClassVar

from acausal import Scalar, apart, dot, geometry, parameter, piecewise, require, sqrt
from components.contact.contact import Contact
from components.contact.sphere_range import shallow
from components.frame import pose

CONCENTRIC = 1e-10  # distance of the centres over the sum of the radii: below it round-off determines the normal


class SphereOnSphere(Contact):
    """Contact of a sphere about the origin of frame_a with a sphere about the origin of frame_b.

    Notes
    -----
    Hertz: k = 4/3 E sqrt(radius), with 1 / radius = 1 / radius_a + 1 / radius_b and
    1 / E = (1 - nu_a^2) / E_a + (1 - nu_b^2) / E_b.
    """

    n: ClassVar[float] = 1.5
    radius_a: Scalar = parameter("radius of the sphere at frame_a", unit="m", positive=True)
    radius_b: Scalar = parameter("radius of the sphere at frame_b", unit="m", positive=True)
    k: Scalar = parameter("stiffness", unit="N/m^(3/2)", positive=True)

    def contact_geometry(self):
        """Normal, penetration and its midpoint on the line between the centres."""
        a, r = self.frame_a, self.frame_b.r_0 - self.frame_a.r_0
        square, least = dot(r, r), (CONCENTRIC * (self.radius_a + self.radius_b)) ** 2
        distance = sqrt(piecewise((square, square > least), least, smooth=True))
        n = r / distance
        return n, self.radius_a + self.radius_b - distance, a.r_0 + n * ((self.radius_a - self.radius_b + distance) / 2)

    def requirements(self):
        yield from super().requirements()
        name, r = self._path or type(self).__name__, self.frame_b.r_0 - self.frame_a.r_0
        yield require(
            sqrt(dot(r, r)) > 2 * CONCENTRIC * (self.radius_a + self.radius_b),
            f"the spheres of {name} are concentric at the start and their contact has no normal; separate frame_a and "
            "frame_b",
        )

    def validity(self):
        yield shallow(self.x, self.radius_a * self.radius_b / (self.radius_a + self.radius_b))
        yield apart(
            self.frame_b.r_0 - self.frame_a.r_0,
            -self.v,
            self.f,
            "the spheres are concentric and their contact has no normal; increase `k`, so that the spheres do not pass "
            "through each other",
        )

    def shapes(self):
        """The spheres, and the force."""
        yield geometry.Sphere(pose(self.frame_a), diameter=2 * self.radius_a)
        yield geometry.Sphere(pose(self.frame_b), diameter=2 * self.radius_b)
        yield from super().shapes()
