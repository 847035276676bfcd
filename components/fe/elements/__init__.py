"""Mass and stiffness matrices of solids: hex8 and tet4 implemented here, tet10 and hex20 assembled by scikit-fem."""

from components.fe.elements.assembly import assemble
from components.fe.elements.box import box

__all__ = ["assemble", "box"]
