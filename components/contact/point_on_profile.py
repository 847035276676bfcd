"""PointOnProfile: contact of a point with uneven ground."""

from __future__ import annotations

from typing import Any

import numpy as np

from acausal import Expr, Matrix33, Scalar, Vector3, as_expr, dot, expect, parameter, sqrt, structural, variable
from components.contact.contact import Contact
from components.gradient import gradient
from components.orientation import resolve1, resolve2, unit_vector
from components.world import require_direction

SHARE = 0.1  # penetration over radius of curvature: beyond it the ground profile is not flat across the contact


class PointOnProfile(Contact):
    """Contact of the origin of frame_b with uneven ground, given by its height over a plane fixed to frame_a.

    Notes
    -----
    The penetration x is measured along n_a. The force is f (n_a - grad(height)), normal to the ground, so that the elastic
    force has the potential k x^2 / 2. On a slope of angle alpha the normal force is f / cos(alpha) and the stiffness along
    the normal k / cos(alpha)^2.
    """

    n_a: Any = structural(
        "direction of the height, resolved in frame_a", default=(0, 1, 0), shape=(3,), doc="Any nonzero length."
    )
    height: Any = structural(
        "height of the ground in m, as a function of the position",
        choices=(callable,),
        doc="Its argument is a vector normal to n_a, resolved in frame_a, in m: lambda r: 0.1 * sin(r[0]). The first "
        "derivative must be continuous.",
    )
    k: Scalar = parameter("stiffness along n_a", unit="N/m", positive=True)
    r_a: Vector3 = variable("position of the point in the plane normal to n_a, resolved in frame_a", unit="m")
    ground: Scalar = variable("height of the ground", unit="m")
    slope: Vector3 = variable("gradient of the height, resolved in frame_a", unit="1")
    curvature: Matrix33 = variable("curvature of the ground, positive in a valley, resolved in frame_a", unit="1/m")

    def check(self) -> None:
        """Reject a direction of length 0."""
        require_direction(self, self.n_a, "n_a")

    def equations(self):
        yield from super().equations()
        n = unit_vector(self.n_a)
        across = np.eye(3) - np.outer(n, n)
        r_a = Expr(self.r_a.sx, shape=(3,))  # the user's function takes numbers without units
        ground = as_expr(self.height(r_a))
        slope = as_expr(across @ gradient(ground, r_a))
        steep = sqrt(1 + dot(slope, slope))
        r = resolve2(self.frame_a.R, self.frame_b.r_0 - self.frame_a.r_0)
        yield self.r_a == across @ r + self.contact_radius() / self.steepness() * self.slope
        yield self.ground == ground
        yield self.slope == slope
        yield self.curvature == gradient(slope / steep, r_a) @ across

    def contact_geometry(self):
        """Normal, penetration and point of contact: frame_b, or the point of the sphere with the slope of the ground."""
        a, b, n = self.frame_a, self.frame_b, unit_vector(self.n_a)
        up = dot(n, resolve2(a.R, b.r_0 - a.r_0))
        under = self.contact_radius() / self.steepness()
        normal = resolve1(a.R, n - self.slope)
        return normal, self.ground + under - up, b.r_0 - normal * (under / self.steepness())

    def steepness(self):
        """Return the length of the normal, 1 / cos(alpha)."""
        return sqrt(1 + dot(self.slope, self.slope))

    def contact_radius(self) -> Any:
        """Radius of the sphere, 0 for a point."""
        return 0.0

    def validity(self):
        rows = [self.curvature[k] for k in range(3)]
        yield expect(
            (self.x + abs(self.x)) / 2 * sqrt(sum((dot(row, row) for row in rows[1:]), dot(rows[0], rows[0]))),
            1.0,
            SHARE,
            "the penetration exceeds a tenth of the radius of curvature of the profile; smooth the profile, or increase `k`",
        )
