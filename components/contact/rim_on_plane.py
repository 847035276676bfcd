"""RimOnPlane: contact of a wheel rim with a plane."""

from __future__ import annotations

from typing import Any

from acausal import Scalar, apart, cross, dot, geometry, parameter, piecewise, require, sqrt, structural
from components.contact.contact import Contact
from components.frame import pose
from components.orientation import resolve1, unit_vector
from components.world import require_direction

FLAT = 1e-6  # angle between rim and plane in rad: below it round-off determines the direction of the lowest point


class RimOnPlane(Contact):
    """Contact of a circle about the origin of frame_b with the plane through the origin of frame_a.

    Notes
    -----
    The lowest point of the circle is in contact; at the angle alpha between circle and plane, the penetration is
    x = radius sin(alpha) - height. At alpha = 0 there is no lowest point, and a run that reaches this singular configuration
    in contact ends with an error: a disc that falls over needs contacts at several points.
    """

    n_a: Any = structural(
        "normal of the plane towards the wheel, resolved in frame_a",
        default=(0, 1, 0),
        shape=(3,),
        doc="Any nonzero length.",
    )
    n_b: Any = structural(
        "axis of the wheel, resolved in frame_b", default=(0, 0, 1), shape=(3,), doc="Any nonzero length."
    )
    radius: Scalar = parameter("radius of the rim", unit="m", positive=True)
    k: Scalar = parameter("stiffness", unit="N/m", positive=True)

    def check(self) -> None:
        """Reject directions of length 0."""
        require_direction(self, self.n_a, "n_a")
        require_direction(self, self.n_b, "n_b")

    def contact_geometry(self):
        """Normal, penetration and position of the lowest point of the rim."""
        n, axis = self._directions()
        up, sine = self._up(n, axis)
        lowest = self.frame_b.r_0 - up * (self.radius / sine)
        return n, -dot(n, lowest - self.frame_a.r_0), lowest

    def requirements(self):
        yield from super().requirements()
        up, _ = self._up(*self._directions())
        name = self._path or type(self).__name__
        yield require(
            sqrt(dot(up, up)) > 2 * FLAT,
            f"the rim of {name} is parallel to the plane at the start and has no lowest point; rotate the wheel, or its "
            "axis: n_b=(0, 0, 1)",
        )

    def validity(self):
        n, axis = self._directions()
        up, sine = self._up(n, axis)
        w = resolve1(self.frame_b.R, self.frame_b.R.w) - resolve1(self.frame_a.R, self.frame_a.R.w)
        yield apart(
            up,
            -dot(n, axis) * dot(n, cross(w, axis)) / sine,
            self.f,
            "the rim is parallel to the plane and has no lowest point. Keep the wheel from falling over, or use contacts at "
            "several points of the rim",
        )

    def shapes(self):
        """The rim, and the force."""
        half = unit_vector(self.n_b) * self.radius / 8
        yield geometry.Cylinder(pose(self.frame_b), -half, half, 2 * self.radius, "wheel")
        yield from super().shapes()

    def _directions(self) -> tuple[Any, Any]:
        """Normal of the plane and axis of the wheel, resolved in the world."""
        return resolve1(self.frame_a.R, unit_vector(self.n_a)), resolve1(self.frame_b.R, unit_vector(self.n_b))

    def _up(self, n: Any, axis: Any) -> tuple[Any, Any]:
        """Component of the normal in the plane of the rim, and its length, the sine of the angle between both planes."""
        up = n - dot(n, axis) * axis
        square = dot(up, up)
        return up, sqrt(piecewise((square, square > FLAT**2), FLAT**2, smooth=True))
