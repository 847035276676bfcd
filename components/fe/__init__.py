"""Bodies from mass and stiffness matrices of any finite-element program."""

from components.fe.elements import assemble, box
from components.fe.fe_body import FEBody
from components.fe.formats import read_npz
from components.fe.interface import average, rigid
from components.fe.nodal_field import NodalField
from components.fe.reduced_body import Interface, ReducedBody
from components.fe.reduction import reduce_body

__all__ = [
    "FEBody",
    "Interface",
    "NodalField",
    "ReducedBody",
    "assemble",
    "average",
    "box",
    "read_npz",
    "reduce_body",
    "rigid",
]
