"""Prismatic joint as a constraint."""

from __future__ import annotations

from acausal import geometry
from components.constraints.position_constraint import PositionConstraint
from components.frame import turn_between


class Prismatic(PositionConstraint):
    """Keeps two frames parallel and their origins coincident along the locked directions."""

    def rotational_constraints(self, t_b_a):
        yield turn_between(self.frame_a, self.frame_b) == (0, 0, 0)

    def shapes(self):
        """A rail."""
        yield geometry.Span(self.frame_a.r_0, self.frame_b.r_0, "rail")
