"""Joints as constraints between bodies with states of their own."""

from components.constraints.position_constraint import PositionConstraint
from components.constraints.prismatic import Prismatic
from components.constraints.revolute import Revolute
from components.constraints.spherical import Spherical
from components.constraints.universal import Universal

__all__ = ["PositionConstraint", "Prismatic", "Revolute", "Spherical", "Universal"]
