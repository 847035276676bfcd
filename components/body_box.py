"""BodyBox: rigid body with the shape of a box."""

from __future__ import annotations

from typing import Any

import numpy as np

from acausal import (
    DeclarationError,
    Matrix33,
    Scalar,
    Vector3,
    as_expr,
    cross,
    dot,
    geometry,
    parameter,
    require,
    structural,
)
from components.frame import pose
from components.orientation import norm, outer_product
from components.two_frame_body import TwoFrameBody
from components.world import require_direction

PARALLEL = 1e-6  # sine of the angle between two directions that count as parallel: a smaller angle is a user error


class BodyBox(TwoFrameBody):
    """Box or rectangular pipe, by default from frame_a to frame_b; size and density determine its mass properties."""

    r: Vector3 = parameter("from frame_a to frame_b, resolved in frame_a", unit="m")
    r_shape: Vector3 = parameter("from frame_a to the start of the box", unit="m", default=(0, 0, 0))
    length_direction: Vector3 = parameter(
        "direction of the length, resolved in frame_a",
        unit="m",
        default=lambda s: s.r - s.r_shape,
        doc="From r_shape to frame_b if not given; entries equal to 0 are structural zeros.",
    )
    length: Scalar = parameter(
        "length", unit="m", default=lambda s: norm(s.r - s.r_shape), doc="From r_shape to frame_b if not given."
    )
    width: Scalar = parameter(
        "width", unit="m", default=lambda s: s.length / 20, positive=True, doc="Measured along width_direction."
    )
    height: Scalar = parameter(
        "height",
        unit="m",
        default=lambda s: s.width,
        positive=True,
        doc="Perpendicular to length and width; equal to the width if not given.",
    )
    inner_width: Scalar = parameter("inner width", unit="m", default=0, minimum=0, doc="Nonzero for a pipe.")
    inner_height: Scalar = parameter(
        "inner height",
        unit="m",
        default=lambda s: s.inner_width,
        minimum=0,
        doc="Equal to the inner width if not given.",
    )
    density: Scalar = parameter("density", unit="kg/m3", default=7700, minimum=0)
    width_direction: Any = structural(
        "direction of the width, resolved in frame_a",
        default=None,
        doc="Only its component normal to the length counts; (0, 1, 0) if not given, or (1, 0, 0) for a box along y.",
    )
    m: Scalar = parameter(
        "mass",
        unit="kg",
        default=lambda s: s.density * s.length * (s.width * s.height - s.inner_width * s.inner_height),
        minimum=0,
        doc="That of the box if not given.",
    )
    r_CM: Vector3 = parameter(
        "centre of mass, resolved in frame_a",
        unit="m",
        default=lambda s: s.centre(),
        doc="That of the box if not given.",
    )
    I: Matrix33 = parameter(
        "inertia tensor about the centre of mass",
        unit="kg.m2",
        default=lambda s: s.box_inertia(),
        doc="Resolved in frame_a; that of the box if not given.",
    )

    def requirements(self):
        name = self._path or "BodyBox"
        yield require(self.length > 0, f"`r` of {name} has length 0; give the axis of the box, r=(1, 0, 0)")
        for inner, outer in (("inner_width", "width"), ("inner_height", "height")):
            text = f"`{inner}` of {name} is not less than `{outer}`; give the size of the hole, or 0 for a solid box"
            yield require(getattr(self, inner) < getattr(self, outer), text)
        direction = self._width_direction()
        aside = cross(direction, self.length_direction / norm(self.length_direction))
        text = (
            f"`width_direction` of {name} is parallel to `r` or `length_direction`, so the orientation of the box is "
            "undefined; give a perpendicular direction, such as width_direction=(0, 1, 0) for r=(1, 0, 0)"
        )
        yield require(dot(aside, aside) > PARALLEL**2 * float(np.dot(direction, direction)), text)
        yield from super().requirements()

    def shapes(self):
        """The box."""
        size = as_expr((self.length, self.width, self.height))
        yield geometry.Box(pose(self.frame_a), self.centre(), size, as_expr(self.axes()))

    def centre(self) -> Any:
        """Centre, resolved in frame_a, in m."""
        return self.r_shape + self.length_direction * (self.length / norm(self.length_direction) / 2)

    def axes(self) -> tuple[Any, Any, Any]:
        """Directions of length, width and height, resolved in frame_a."""
        if all(entry.sx.is_zero() for entry in self.length_direction):
            raise DeclarationError("`r` has length 0; give the axis of the box, r=(1, 0, 0).")
        direction, along = self._width_direction(), self.length_direction / norm(self.length_direction)
        across = as_expr(direction) - dot(direction, along) * along
        across = across / norm(across)
        return along, across, cross(along, across)

    def _width_direction(self) -> tuple[float, ...]:
        """Return the specified direction of the width; default y, or x for a box along y."""
        given = self.width_direction
        if given is not None:
            array = np.asarray(given)
            if array.shape != (3,) or array.dtype.kind not in "iuf" or not np.all(np.isfinite(array)):
                where = f"{self._path} (BodyBox)"
                raise DeclarationError(f"`width_direction` of {where} is {given!r}; give three numbers, (0, 1, 0).")
            require_direction(self, array, "width_direction")
            return tuple(float(entry) for entry in array)
        along_y = self.length_direction[0].sx.is_zero() and self.length_direction[2].sx.is_zero()
        return (1.0, 0.0, 0.0) if along_y else (0.0, 1.0, 0.0)

    def box_inertia(self) -> Any:
        """Inertia tensor about the centre of mass, resolved in frame_a, in kg.m2."""
        along, across, up = (outer_product(e, e) for e in self.axes())
        whole, hole = self.width * self.height, self.inner_width * self.inner_height
        w2 = (whole * self.width**2 - hole * self.inner_width**2) / (whole - hole)
        h2 = (whole * self.height**2 - hole * self.inner_height**2) / (whole - hole)
        l2 = self.length**2
        return self.m / 12 * ((w2 + h2) * along + (l2 + h2) * across + (l2 + w2) * up)
