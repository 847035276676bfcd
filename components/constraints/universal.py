"""Universal joint as a constraint."""

from __future__ import annotations

from typing import Any

from acausal import DeclarationError, dot, geometry, structural
from components.constraints.position_constraint import PositionConstraint
from components.frame import pose
from components.orientation import parallel, unit_vector
from components.world import require_direction


class Universal(PositionConstraint):
    """Keeps the origins of two frames coincident and the angle between n_a and n_b constant."""

    n_a: Any = structural("first axis, resolved in frame_a", default=(1, 0, 0), shape=(3,), doc="Any nonzero length.")
    n_b: Any = structural("second axis, resolved in frame_b", default=(0, 1, 0), shape=(3,), doc="Not parallel to n_a.")

    def check(self) -> None:
        """Reject axes of length 0, and parallel axes."""
        require_direction(self, self.n_a, "n_a")
        require_direction(self, self.n_b, "n_b")
        if parallel(self.n_a, self.n_b):
            raise DeclarationError("`n_b` is parallel to `n_a`; give another axis, for instance n_b=(0, 1, 0).")

    def rotational_constraints(self, t_b_a):
        n_a, n_b = unit_vector(self.n_a), unit_vector(self.n_b)
        yield dot(n_a, self.resolved_in_a(n_b)) == float(n_a @ n_b)
        yield dot(n_a, t_b_a) == 0
        yield dot(n_b, self.frame_b.t) == 0

    def shapes(self):
        """A pin along each axis."""
        yield geometry.Axle(pose(self.frame_a), unit_vector(self.n_a), style="pin")
        yield geometry.Axle(pose(self.frame_b), unit_vector(self.n_b), style="pin")
