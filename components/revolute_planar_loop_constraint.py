"""RevolutePlanarLoopConstraint: revolute joint that closes a planar loop."""

from __future__ import annotations

from typing import Any

from acausal import as_expr, dot, geometry, structural, variable
from components.frame import TwoFrames, pose
from components.orientation import across, resolve1, resolve2, unit_vector
from components.world import require_direction


class RevolutePlanarLoopConstraint(TwoFrames):
    """Keeps the origins of both frames coincident in the plane normal to n, without other constraints.

    Notes
    -----
    Provided for compatibility with Modelica's library: a loop closed by a Revolute works as well. No branch: other parts of
    a planar mechanism normal to n must hold both frames. No force along n and no torque is transmitted.
    """

    n: Any = structural(
        "axis of rotation, the same in frame_a and frame_b", default=(0, 0, 1), shape=(3,), doc="Any nonzero length."
    )
    f_c: Any = variable("constraint force along two perpendicular directions normal to n", unit="N", shape=(2,))

    def check(self) -> None:
        """Reject an axis of length 0."""
        require_direction(self, self.n, "n")

    def equations(self):
        a, b = self.frame_a, self.frame_b
        e_x, e_y = across(unit_vector(self.n))
        r_rel_a = resolve2(a.R, b.r_0 - a.r_0)
        yield dot(e_x, r_rel_a) == 0
        yield dot(e_y, r_rel_a) == 0
        yield a.f == as_expr(e_x) * self.f_c[0] + as_expr(e_y) * self.f_c[1]
        yield b.f == -resolve2(b.R, resolve1(a.R, a.f))
        yield a.t == (0, 0, 0)
        yield b.t == (0, 0, 0)

    def shapes(self):
        """A pin."""
        yield geometry.Axle(pose(self.frame_a), unit_vector(self.n))
