"""Revolute joint as a constraint."""

from __future__ import annotations

from typing import Any

from acausal import dot, geometry, structural
from components.constraints.position_constraint import PositionConstraint
from components.frame import pose
from components.orientation import across, unit_vector
from components.world import require_direction


class Revolute(PositionConstraint):
    """Keeps the origins and the axis n of two frames coincident; frame_b rotates about n."""

    n: Any = structural(
        "axis of rotation, the same in frame_a and frame_b", default=(0, 1, 0), shape=(3,), doc="Any nonzero length."
    )

    def check(self) -> None:
        """Reject an axis of length 0."""
        require_direction(self, self.n, "n")

    def rotational_constraints(self, t_b_a):
        n = unit_vector(self.n)
        for e in across(n):
            yield dot(e, self.resolved_in_a(n)) == 0
        yield dot(n, self.frame_b.t) == 0

    def shapes(self):
        """A pin."""
        yield geometry.Axle(pose(self.frame_b), unit_vector(self.n))
