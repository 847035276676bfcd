"""Interface frame of a reduced body."""

from __future__ import annotations

from dataclasses import dataclass, field, replace

import numpy as np

from acausal import DeclarationError
from components.fe.arrays import Array, frozen

SQUARE = 1e-6  # deviation of axes from orthonormal: files have six or seven digits


@dataclass(frozen=True, eq=False)
class Interface:
    """A frame of a reduced body: its undeformed position and axes, and its motion in terms of the modal coordinates q.

    Parameters
    ----------
    name : str
        Name of the port.
    place : array, shape (3,)
        X, position of the frame in the undeformed body in m, resolved in the reference frame.
    displacement : array, shape (3, n)
        Phi: the displacement of the frame is Phi q, resolved in the reference frame.
    rotation : array, shape (3, n)
        Psi: the small rotation vector of the frame is Psi q in rad, resolved in the reference frame.
    turns : bool
        Whether the nodes define all rotations. Frames at one node or at collinear nodes do not, and carry no moment.
    axes : array, shape (3, 3)
        Rows are the axes x, y, z of the frame in the undeformed body, resolved in the reference frame.
    averages : bool
        Whether the frame follows the average of several nodes without constraining them.
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
            raise DeclarationError(f"the axes of {what} are not orthonormal and right-handed")
        for name in ("turns", "averages"):
            object.__setattr__(self, name, bool(getattr(self, name)))

    @property
    def turned(self) -> bool:
        """True if the axes differ from those of the reference frame."""
        return not np.array_equal(self.axes, np.eye(3))

    @property
    def still(self) -> bool:
        """True if the frame is at the origin and no mode moves it: the reference frame, up to its axes."""
        return not (self.displacement.any() or self.rotation.any() or self.place.any())

    def first(self, n: int) -> Interface:
        """Return the frame of the body with the first n modes only."""
        return replace(self, displacement=self.displacement[:, :n], rotation=self.rotation[:, :n])
