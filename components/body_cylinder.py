"""BodyCylinder: a rigid body with the shape of a cylinder or a pipe."""

from __future__ import annotations

from typing import Any

import numpy as np

from acausal import DeclarationError, Matrix33, Scalar, Vector3, dot, geometry, parameter, require, sqrt
from components.frame import pose
from components.orientation import outer_product
from components.two_frame_body import TwoFrameBody


class BodyCylinder(TwoFrameBody):
    """Cylinder with its axis along r; mass, centre of mass and inertia follow from size and density."""

    r: Vector3 = parameter(
        "from frame_a to frame_b, resolved in frame_a",
        unit="m",
        doc="It is the axis of the cylinder; its entries that are 0 are structural.",
    )
    diameter: Scalar = parameter("outer diameter", unit="m", positive=True)
    inner_diameter: Scalar = parameter("inner diameter", unit="m", default=0, minimum=0, doc="Not 0 for a pipe.")
    density: Scalar = parameter("density", unit="kg/m3", default=7700, minimum=0)
    m: Scalar = parameter(
        "mass", unit="kg", default=lambda s: s.cylinder_mass(), minimum=0, doc="That of the cylinder if not given."
    )
    r_CM: Vector3 = parameter(
        "centre of mass, resolved in frame_a",
        unit="m",
        default=lambda s: s.r / 2,
        doc="That of the cylinder if not given.",
    )
    I: Matrix33 = parameter(
        "inertia tensor about the centre of mass",
        unit="kg.m2",
        default=lambda s: s.cylinder_inertia(),
        doc="Resolved in frame_a; that of the cylinder if not given.",
    )

    def requirements(self):
        name = self._path or "BodyCylinder"
        yield require(dot(self.r, self.r) > 0, f"`r` of {name} has length 0; give its axis, r=(1, 0, 0)")
        text = f"`inner_diameter` of {name} is not less than `diameter`; give the bore of the pipe, or 0 if it has none"
        yield require(self.inner_diameter < self.diameter, text)
        yield from super().requirements()

    def shapes(self):
        """The cylinder; it hides the bore of a pipe."""
        yield geometry.Cylinder(pose(self.frame_a), (0, 0, 0), self.r, self.diameter)

    def cylinder_mass(self) -> Any:
        """Mass in kg."""
        if all(entry.sx.is_zero() for entry in self.r):
            raise DeclarationError("`r` has length 0; give its axis, r=(1, 0, 0).")
        section = np.pi / 4 * (self.diameter**2 - self.inner_diameter**2)
        return self.density * section * sqrt(dot(self.r, self.r))

    def cylinder_inertia(self) -> Any:
        """Inertia tensor about the centre of mass, resolved in frame_a, in kg.m2."""
        squares, l2 = (self.diameter**2 + self.inner_diameter**2) / 4, dot(self.r, self.r)
        along = outer_product(self.r, self.r) / l2
        lengthwise, crosswise = self.m * squares / 2, self.m * (3 * squares + l2) / 12
        return lengthwise * along + crosswise * (np.eye(3) - along)
