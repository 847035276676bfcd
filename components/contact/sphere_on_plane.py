"""SphereOnPlane: contact of a sphere with a plane."""

from __future__ import annotations

from typing import Any, ClassVar

from acausal import Scalar, dot, geometry, parameter, structural
from components.contact.contact import Contact
from components.contact.sphere_range import shallow
from components.frame import pose
from components.orientation import resolve1, unit_vector
from components.world import require_direction


class SphereOnPlane(Contact):
    """Contact of a sphere about the origin of frame_b with the plane through the origin of frame_a.

    Notes
    -----
    Hertz: k = 4/3 E sqrt(radius), with 1 / E = (1 - nu_a^2) / E_a + (1 - nu_b^2) / E_b.
    """

    n: ClassVar[float] = 1.5
    n_a: Any = structural(
        "normal of the plane towards the sphere, resolved in frame_a",
        default=(0, 1, 0),
        shape=(3,),
        doc="Any nonzero length.",
    )
    radius: Scalar = parameter("radius of the sphere", unit="m", positive=True)
    k: Scalar = parameter("stiffness", unit="N/m^(3/2)", positive=True)

    def check(self) -> None:
        """Reject a normal of length 0."""
        require_direction(self, self.n_a, "n_a")

    def contact_geometry(self):
        """Normal, penetration and the point of the plane closest to the centre."""
        a, b = self.frame_a, self.frame_b
        n = resolve1(a.R, unit_vector(self.n_a))
        height = dot(n, b.r_0 - a.r_0)
        return n, self.radius - height, b.r_0 - n * height

    def validity(self):
        yield shallow(self.x, self.radius)

    def shapes(self):
        """The sphere, and the force."""
        yield geometry.Sphere(pose(self.frame_b), diameter=2 * self.radius)
        yield from super().shapes()
