"""BodyCylinder: rigid body with the shape of a cylinder or a pipe."""

from __future__ import annotations

from typing import Any

import numpy as np

from acausal import DeclarationError, Matrix33, Scalar, Vector3, dot, geometry, parameter, require
from components.frame import pose
from components.orientation import norm, outer_product
from components.two_frame_body import TwoFrameBody


class BodyCylinder(TwoFrameBody):
    """Cylinder or pipe, by default from frame_a to frame_b; size and density determine its mass properties."""

    r: Vector3 = parameter("from frame_a to frame_b, resolved in frame_a", unit="m")
    r_shape: Vector3 = parameter("from frame_a to the start of the cylinder", unit="m", default=(0, 0, 0))
    length_direction: Vector3 = parameter(
        "direction of the axis, resolved in frame_a",
        unit="m",
        default=lambda s: s.r - s.r_shape,
        doc="From r_shape to frame_b if not given; entries equal to 0 are structural zeros.",
    )
    length: Scalar = parameter(
        "length", unit="m", default=lambda s: norm(s.r - s.r_shape), doc="From r_shape to frame_b if not given."
    )
    diameter: Scalar = parameter("outer diameter", unit="m", default=lambda s: s.length / 20, positive=True)
    inner_diameter: Scalar = parameter("inner diameter", unit="m", default=0, minimum=0, doc="Nonzero for a pipe.")
    density: Scalar = parameter("density", unit="kg/m3", default=7700, minimum=0)
    m: Scalar = parameter(
        "mass", unit="kg", default=lambda s: s.cylinder_mass(), minimum=0, doc="That of the cylinder if not given."
    )
    r_CM: Vector3 = parameter(
        "centre of mass, resolved in frame_a",
        unit="m",
        default=lambda s: s.r_shape + s.axis() / 2,
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
        yield require(self.length > 0, f"`r` of {name} has length 0; give its axis, r=(1, 0, 0)")
        text = f"`inner_diameter` of {name} is not less than `diameter`; give the bore of the pipe, or 0 for a bar"
        yield require(self.inner_diameter < self.diameter, text)
        yield from super().requirements()

    def shapes(self):
        """The cylinder, drawn without the bore of a pipe."""
        yield geometry.Cylinder(pose(self.frame_a), self.r_shape, self.r_shape + self.axis(), self.diameter)

    def axis(self) -> Any:
        """Vector from one end to the other, resolved in frame_a, in m."""
        return self.length_direction * (self.length / norm(self.length_direction))

    def cylinder_mass(self) -> Any:
        """Mass in kg."""
        if all(entry.sx.is_zero() for entry in self.length_direction):
            raise DeclarationError("`r` has length 0; give its axis, r=(1, 0, 0).")
        section = np.pi / 4 * (self.diameter**2 - self.inner_diameter**2)
        return self.density * section * self.length

    def cylinder_inertia(self) -> Any:
        """Inertia tensor about the centre of mass, resolved in frame_a, in kg.m2."""
        squares, l2 = (self.diameter**2 + self.inner_diameter**2) / 4, self.length**2
        along = outer_product(self.length_direction, self.length_direction) / dot(
            self.length_direction, self.length_direction
        )
        lengthwise, crosswise = self.m * squares / 2, self.m * (3 * squares + l2) / 12
        return lengthwise * along + crosswise * (np.eye(3) - along)
