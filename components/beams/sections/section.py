"""Section: stiffness and inertia of a cross-section, per length where they are inertias."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, fields, replace
from typing import Any, ClassVar

from acausal import DeclarationError, as_expr, cos, geometry, quantity, sin, sqrt
from components.beams.pair import Pair, Symmetric

UNITS = {
    "EA": "N",
    "EJ_y": "N.m2",
    "EJ_z": "N.m2",
    "GJ_t": "N.m2",
    "mass": "kg/m",
    "I_y": "kg.m",
    "I_z": "kg.m",
    "kGA_y": "N",
    "kGA_z": "N",
    "y_c": "m",
    "z_c": "m",
    "y_s": "m",
    "z_s": "m",
    "angle": "rad",
}


@dataclass(frozen=True)
class Section:
    """Stiffnesses and inertias of a cross-section, about its principal axes.

    Parameters
    ----------
    EA : float
        Axial stiffness in N.
    EJ_y, EJ_z : float
        Bending stiffnesses about y and z in N.m2: EJ_z for bending in xy.
    GJ_t : float
        Torsional stiffness in N.m2.
    mass : float
        Mass per length in kg/m.
    I_y, I_z : float
        Moments of inertia per length about y and z in kg.m, rho J_y and rho J_z of a solid section.
    kGA_y, kGA_z : float, optional
        Shear stiffnesses along y and z in N, required by `shear=True` only.
    y_c, z_c : float
        Centroid in m, the centre of mass as well, from the axis of the beam.
    y_s, z_s : float
        Shear centre in m, from the axis of the beam.
    angle : float
        Angle in rad by which the axes of the section are turned about x. All other values refer to the turned axes.

    Notes
    -----
    Torsion is Saint-Venant's: warping, which stiffens open thin-walled sections, is neglected.
    """

    EA: Any
    EJ_y: Any
    EJ_z: Any
    GJ_t: Any
    mass: Any
    I_y: Any
    I_z: Any
    kGA_y: Any = None
    kGA_z: Any = None
    y_c: Any = 0.0
    z_c: Any = 0.0
    y_s: Any = 0.0
    z_s: Any = 0.0
    angle: Any = 0.0
    profile: ClassVar[geometry.Profile] = "ellipse"

    @property
    def half_axes(self) -> tuple[Any, Any]:
        """Half-axes of the drawn profile along y and z in m: of the ellipse with the radii of gyration of the stiffness."""
        return 2 * sqrt(self.EJ_z / self.EA), 2 * sqrt(self.EJ_y / self.EA)

    def with_units(self) -> Section:
        """Return the section with expressions instead of numbers."""
        given = {f.name: getattr(self, f.name) for f in fields(self)}
        return replace(self, **{n: _expression(v, UNITS[n]) for n, v in given.items() if v is not None})

    def section(self, E: Any, G: Any, rho: Any) -> Section:
        """Return the section itself, which needs no material."""
        return self

    def bending(self) -> Symmetric:
        """Return the stiffness in N.m2 of the curvatures v'' and w'' along the axes of the beam."""
        return _turned(self.EJ_z, self.EJ_y, self.angle)

    def shear(self) -> Pair:
        """Return the shear stiffnesses along y and z of the beam in N.

        Raises
        ------
        DeclarationError
            They are not given.
        """
        if self.kGA_y is None or self.kGA_z is None:
            raise DeclarationError(
                "shear=True needs the shear stiffnesses of the section, Section(..., kGA_y=..., kGA_z=...)."
            )
        turned = _turned(self.kGA_y, self.kGA_z, self.angle)
        return Pair(turned.yy, turned.zz)

    def inertia(self) -> Symmetric:
        """Return the second moments of mass per length along y and z of the beam in kg.m."""
        return _turned(self.I_z, self.I_y, self.angle)

    def centroid(self) -> Pair:
        """Return the place of the centroid along y and z of the beam in m."""
        return _place(self.y_c, self.z_c, self.angle)

    def shear_centre(self) -> Pair:
        """Return the place of the shear centre along y and z of the beam in m."""
        return _place(self.y_s, self.z_s, self.angle)


def _expression(value: Any, unit: str) -> Any:
    return value if hasattr(value, "sx") else quantity(value, unit)


def _turned(first: Any, second: Any, angle: Any) -> Symmetric:
    """Matrix diag(first, second) of the axes of a section in those of the beam."""
    if angle.sx.is_zero():
        return Symmetric(first, 0.0 * first, second)
    c, s = cos(angle), sin(angle)
    return Symmetric(c * c * first + s * s * second, c * s * (first - second), s * s * first + c * c * second)


def _place(y: Any, z: Any, angle: Any) -> Pair:
    if angle.sx.is_zero():
        return Pair(y, z)
    c, s = cos(angle), sin(angle)
    return Pair(c * y - s * z, s * y + c * z)


def joined(sections: Sequence[Section]) -> Section:
    """Return a section whose values are vectors, with one entry for each of the given sections."""
    columns = ((f.name, [getattr(s, f.name) for s in sections]) for f in fields(Section))
    return Section(**{name: as_expr(column) for name, column in columns if all(x is not None for x in column)})
