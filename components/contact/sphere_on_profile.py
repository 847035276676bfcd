"""SphereOnProfile: contact of a sphere with uneven ground."""

from __future__ import annotations

from typing import ClassVar

from acausal import Scalar, expect, geometry, parameter, sqrt
from components.contact.point_on_profile import PointOnProfile
from components.contact.sphere_range import shallow
from components.frame import pose


class SphereOnProfile(PointOnProfile):
    """Contact of a sphere about the origin of frame_b with uneven ground, given by its height over a plane of frame_a.

    Notes
    -----
    The centre of an unloaded rolling sphere moves on the offset surface at the distance `radius` from the ground. x is the
    depth of the centre below this surface, measured along n_a, and r_a is the foot of the ground normal through the centre.
    The elastic force has the potential k x^2.5 / 2.5. In a valley of smaller radius of curvature the sphere would touch at
    several points: r_a is not unique, and the run warns or fails.
    """

    n: ClassVar[float] = 1.5
    radius: Scalar = parameter("radius of the sphere", unit="m", positive=True)
    k: Scalar = parameter("stiffness along n_a", unit="N/m^(3/2)", positive=True)

    def contact_radius(self):
        """Radius of the sphere."""
        return self.radius

    def validity(self):
        yield shallow(self.x, self.radius)
        # Largest eigenvalue of a matrix of rank 2 from tr(M) and tr(M^2).
        M, square = self.curvature, self.curvature @ self.curvature
        trace, squares = M[0, 0] + M[1, 1] + M[2, 2], square[0, 0] + square[1, 1] + square[2, 2]
        difference = 2 * squares - trace * trace
        tightest = (trace + sqrt((difference + abs(difference)) / 2)) / 2
        touches = (self.x + abs(self.x)) / (2 * abs(self.x))
        yield expect(
            (tightest + abs(tightest)) / 2 * self.radius * touches,
            1.0,
            1.0,
            "the radius of curvature of the profile is smaller than that of the sphere, which would touch at several points; "
            "smooth the profile, or use a smaller sphere",
        )

    def shapes(self):
        """The sphere, and the force."""
        yield geometry.Sphere(pose(self.frame_b), diameter=2 * self.radius)
        yield from super().shapes()
