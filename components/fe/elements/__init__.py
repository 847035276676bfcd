"""Mass and stiffness of solids of one material: bricks and linear tetrahedra of one's own, quadratic elements by scikit-fem."""

from components.fe.elements.assembly import assemble
from components.fe.elements.box import box

__all__ = ["assemble", "box"]
