"""A frame of a reduced body."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from components.fe.arrays import Array, frozen


@dataclass(frozen=True, eq=False)
class Interface:
    """A frame of a reduced body: its undeformed place, and how it moves with the coordinates q of the modes.

    Its axes are parallel to those of the reference frame as long as the body is undeformed.

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
    """

    name: str
    place: Array
    displacement: Array
    rotation: Array
    turns: bool = True

    def __post_init__(self) -> None:
        what = f"interface {self.name!r}"
        shape = (3, np.shape(self.displacement)[-1] if np.ndim(self.displacement) == 2 else 0)
        object.__setattr__(self, "place", frozen(self.place, (3,), f"place of {what}"))
        object.__setattr__(self, "displacement", frozen(self.displacement, shape, f"displacement of {what}"))
        object.__setattr__(self, "rotation", frozen(self.rotation, shape, f"rotation of {what}"))
        object.__setattr__(self, "turns", bool(self.turns))

    def first(self, n: int) -> Interface:
        """The frame in a body of the first n modes."""
        return replace(self, displacement=self.displacement[:, :n], rotation=self.rotation[:, :n])
