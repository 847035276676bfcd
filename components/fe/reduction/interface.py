"""A frame of a reduced body."""

from __future__ import annotations

from dataclasses import dataclass, field, replace

import numpy as np

from acausal import DeclarationError
from components.fe.arrays import Array, frozen

SQUARE = 1e-6  # of a length of 1: what is rounding of axes that a file holds


@dataclass(frozen=True, eq=False)
class Interface:
    """A frame of a reduced body: its undeformed place and axes, and how it moves with the coordinates q of the modes.

    Parameters
    ----------
    name : str
        Name of the port.
    place : array, shape (3,)
        X, place of the frame in the undeformed body, in m, resolved in the reference frame.
    displacement : array, shape (3, n)
        Phi: the frame is displaced by Phi q, resolved in the reference frame.
    rotation : array, shape (3, n)
        Psi: the frame is turned by the small rotation vector Psi q in rad, resolved in the reference frame.
    turns : bool
        Whether the nodes hold every rotation; where they do not (one node, nodes on a line), no moment may be carried.
    axes : array, shape (3, 3)
        Directions x, y, z of the frame in the undeformed body as rows, resolved in the reference frame.
    averages : bool
        Whether the frame follows the average of several nodes, which it does not hold together.
    """

    name: str
    place: Array
    displacement: Array
    rotation: Array
    turns: bool = True
    axes: Array = field(default_factory=lambda: np.eye(3))
    averages: bool = False

    def __post_init__(self) -> None:
        what = f"interface {self.name!r}"
        shape = (3, np.shape(self.displacement)[-1] if np.ndim(self.displacement) == 2 else 0)
        object.__setattr__(self, "place", frozen(self.place, (3,), f"place of {what}"))
        object.__setattr__(self, "displacement", frozen(self.displacement, shape, f"displacement of {what}"))
        object.__setattr__(self, "rotation", frozen(self.rotation, shape, f"rotation of {what}"))
        object.__setattr__(self, "axes", frozen(self.axes, (3, 3), f"axes of {what}"))
        if np.abs(self.axes @ self.axes.T - np.eye(3)).max() > SQUARE or np.linalg.det(self.axes) < 0:
            raise DeclarationError(f"the axes of {what} are no right-handed ones at right angles")
        for name in ("turns", "averages"):
            object.__setattr__(self, name, bool(getattr(self, name)))

    @property
    def turned(self) -> bool:
        """True if the axes are not those of the reference frame."""
        return not np.array_equal(self.axes, np.eye(3))

    @property
    def still(self) -> bool:
        """True if no mode moves the frame, and it is at the origin: it is the reference frame, but for its axes."""
        return not (self.displacement.any() or self.rotation.any() or self.place.any())

    def first(self, n: int) -> Interface:
        """The frame in a body of the first n modes."""
        return replace(self, displacement=self.displacement[:, :n], rotation=self.rotation[:, :n])
