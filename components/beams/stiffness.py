"""Stiffness of beam elements, from their sections at the two points of Gauss."""

from __future__ import annotations

from dataclasses import dataclass
from math import sqrt
from typing import Any

from acausal import as_expr
from components.beams.pair import Pair, Symmetric, inverse
from components.beams.sections import Section

ONE, ZERO = Pair(1.0, 1.0), Pair(0.0, 0.0)


@dataclass(frozen=True)
class Stiffness:
    """Stiffness of the elements; each value is a scalar, or a vector with one entry per element if the section varies.

    Parameters
    ----------
    EA, GJ_t : Expr
        Axial stiffness in N and torsional stiffness in N.m2, the harmonic means of both sections: the axial force and the
        torque are constant in an element.
    bending : tuple of Symmetric
        Stiffness at each point of Gauss in N.m2, of the curvatures v'' and w''.
    psi : Pair
        Share of bending in the mode r in xy and xz: 1 / (1 + 12 EJ / (k G A l^2)), or 1 without shear.
    shear : Pair
        Stiffness of shear in the mode r in N.m2: 3 EJ (1 / psi - 1).
    centroid, shear_centre : Pair
        Places along y and z in m.
    """

    EA: Any
    GJ_t: Any
    bending: tuple[Symmetric, Symmetric]
    psi: Pair
    shear: Pair
    centroid: Pair
    shear_centre: Pair

    @classmethod
    def of(cls, sections: tuple[Section, Section], l: Any, shear: bool) -> Stiffness:
        """Return the stiffness of elements of length l with the given sections at their points of Gauss."""
        a, b = sections
        bending = a.bending(), (a if b is a else b).bending()
        psi, sheared = ONE, ZERO
        if shear:
            (EJ_v, _, EJ_w), kGA = (
                (_mean(*pair) for pair in zip(*bending, strict=True)),
                _mean(a.shear().y, b.shear().y),
            )
            rigid = [l * l * x for x in (kGA, _mean(a.shear().z, b.shear().z))]
            psi = Pair(*(x * inverse(x + 12 * EJ) for x, EJ in zip(rigid, (EJ_v, EJ_w), strict=True)))
            sheared = Pair(*(36 * EJ * EJ * inverse(x) for x, EJ in zip(rigid, (EJ_v, EJ_w), strict=True)))
        return cls(
            _harmonic(a.EA, b.EA),
            _harmonic(a.GJ_t, b.GJ_t),
            bending,
            psi,
            sheared,
            Pair(*map(_mean, a.centroid(), b.centroid())),
            Pair(*map(_mean, a.shear_centre(), b.shear_centre())),
        )

    @property
    def mean(self) -> Symmetric:
        """Mean of the bending stiffnesses in N.m2."""
        return Symmetric(*map(_mean, *self.bending))

    @property
    def slant(self) -> Symmetric:
        """Stiffness in N.m2 that couples the modes q and r where the sections differ."""
        return Symmetric(*(sqrt(3) / 2 * (b - a) for a, b in zip(*self.bending, strict=True)))

    @property
    def is_centred(self) -> bool:
        """Return whether centroid and shear centre lie on the axis of the beam."""
        return all(as_expr(x).sx.is_zero() for x in (*self.centroid, *self.shear_centre))


def _mean(a: Any, b: Any) -> Any:
    return a if a is b else (a + b) / 2


def _harmonic(a: Any, b: Any) -> Any:
    return a if a is b else 2 * a * b * inverse(a + b)
