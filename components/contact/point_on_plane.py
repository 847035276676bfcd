"""PointOnPlane: contact of a point with a plane."""

from __future__ import annotations

from typing import Any

from acausal import Scalar, dot, parameter, structural
from components.contact.contact import Contact
from components.orientation import resolve1, unit_vector
from components.world import require_direction


class PointOnPlane(Contact):
    """Contact of the origin of frame_b with the plane through the origin of frame_a."""

    n_a: Any = structural(
        "normal of the plane towards the side of frame_b, resolved in frame_a",
        default=(0, 1, 0),
        shape=(3,),
        doc="Any nonzero length.",
    )
    k: Scalar = parameter("stiffness", unit="N/m", positive=True)

    def check(self) -> None:
        """Reject a normal of length 0."""
        require_direction(self, self.n_a, "n_a")

    def contact_geometry(self):
        """Normal, penetration and position of the point."""
        a, b = self.frame_a, self.frame_b
        n = resolve1(a.R, unit_vector(self.n_a))
        return n, -dot(n, b.r_0 - a.r_0), b.r_0
