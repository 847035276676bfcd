"""Spherical joint as a constraint."""

from __future__ import annotations

from acausal import geometry
from components.constraints.position_constraint import PositionConstraint
from components.frame import pose


class Spherical(PositionConstraint):
    """Keeps the origins of two frames coincident; rotation is free."""

    def rotational_constraints(self, t_b_a):
        yield self.frame_b.t == (0, 0, 0)

    def shapes(self):
        """A ball."""
        yield geometry.Axle(pose(self.frame_b), (0, 0, 1), style="ball")
