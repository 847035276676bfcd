"""Bodies from mass and stiffness matrices of any finite-element program."""

from components.fe.nodal_field import NodalField
from components.fe.reduced_body import Interface, ReducedBody

__all__ = ["Interface", "NodalField", "ReducedBody"]
