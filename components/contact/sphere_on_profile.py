"""SphereOnProfile: a sphere that touches ground of varying height."""

from __future__ import annotations

from typing import ClassVar

from acausal import Scalar, expect, geometry, parameter, sqrt
from components.contact.point_on_profile import PointOnProfile
from components.contact.sphere_range import shallow
from components.frame import pose


class SphereOnProfile(PointOnProfile):
    """Contact of a sphere about the origin of frame_b with ground whose height over a plane fixed to frame_a is a function.

    Notes
    -----
    The centre of a sphere that rolls without load moves on the surface at the distance of its radius from the ground; x is the
    depth of the centre below that, measured along n_a, and r_a the place where the normal of the ground leads to it. The elastic
    force has the potential k x^2.5 / 2.5. In a valley that is tighter than the radius the sphere would touch at several points:
    r_a is not unique, and the run warns or fails.
    """

    n: ClassVar[float] = 1.5
    radius: Scalar = parameter("radius of the sphere", unit="m", positive=True)
    k: Scalar = parameter("stiffness along n_a", unit="N/m^(3/2)", positive=True)

    def ball(self):
        """Radius of the sphere."""
        return self.radius

    def validity(self):
        yield shallow(self.x, self.radius)
        # Largest eigenvalue of a matrix of rank 2 from its trace and that of its square.
        M, square = self.curvature, self.curvature @ self.curvature
        trace, squares = M[0, 0] + M[1, 1] + M[2, 2], square[0, 0] + square[1, 1] + square[2, 2]
        difference = 2 * squares - trace * trace
        tightest = (trace + sqrt((difference + abs(difference)) / 2)) / 2
        touches = (self.x + abs(self.x)) / (2 * abs(self.x))
        yield expect(
            (tightest + abs(tightest)) / 2 * self.radius * touches,
            1.0,
            1.0,
            "its profile is tighter than the radius of its sphere, which would touch it at several points; smooth the profile, "
            "or take a smaller sphere",
        )

    def shapes(self):
        """The sphere, and the force."""
        yield geometry.Sphere(pose(self.frame_b), diameter=2 * self.radius)
        yield from super().shapes()
