"""Strain of a beam in space: bending of its elements, and the shortening of the axis by its slope."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any, NamedTuple

import numpy as np

from acausal import as_expr
from components.beams.nodes import Nodes, along_nodes, first, last, to_first, to_last
from components.beams.pair import Pair
from components.beams.stiffness import Stiffness

Motion = tuple[Any, Any, Any]  # a quantity and its first two derivatives


class Bend(NamedTuple):
    """Bending of the elements in xy and xz, in m.

    d = v_2 - v_1, q = l (v_1' - v_2'), r = 2 d - l (v_1' + v_2'), and likewise for w. With s from -1 at the first node to 1
    at the second one, l v' = d - s q / 2 + (1 - 3 s^2) r / 4 and l^2 v'' = -q - 3 s r: these modes are orthogonal in the
    integrals of v'^2 and of v''^2. With shear, r is the part by bending.
    """

    d: Pair
    q: Pair
    r: Pair

    def plus(self, other: Bend) -> Bend:
        """Return the sum."""
        return Bend(*(a.plus(b) for a, b in zip(self, other, strict=True)))


@dataclass(frozen=True)
class Strain:
    """Strain of N elements in space.

    With `second_order`, the unit tangent (sqrt(1 - v'^2 - w'^2), v', w') at arc length x shortens the projection on the
    axis by f = (v'^2 + w'^2) / 2 + (v'^2 + w'^2)^2 / 8 per unit length. The axial strain of an element is the mean of
    u' + f, because a linear u cannot balance f pointwise (membrane locking). An axial bubble c xi (1 - xi), with c such
    that the first moment of u' + (v'^2 + w'^2) / 2 vanishes, balances the linear part of f.

    Parameters
    ----------
    elements : int
        N.
    l : Expr
        Length of an element in m.
    stiffness : Stiffness
        Stiffness of the elements.
    second_order : bool
        Whether slopes shorten the axis.
    known : dict
        Bends of nodal coordinates, by their identity, which many parts of the beam ask for.
    """

    elements: int
    l: Any
    stiffness: Stiffness
    second_order: bool
    known: dict[int, tuple[Nodes, Bend]] = field(default_factory=dict, repr=False, compare=False)

    @property
    def shortens(self) -> bool:
        """Return whether bending changes the length of the axis."""
        return self.second_order or not all(as_expr(x).sx.is_zero() for x in self.stiffness.centroid)

    @property
    def _shift(self) -> Pair:
        """Displacement of the shear centre by phi = 1 rad, from the axis, in m."""
        return self.stiffness.shear_centre.times(-1.0).quarter_turn()

    def bend(self, U: Nodes) -> Bend:
        """Bending of the elements."""
        if id(U) not in self.known:
            self.known[id(U)] = U, self._bend(U)
        return self.known[id(U)][1]

    def _bend(self, U: Nodes) -> Bend:
        turn = self.twist(U)
        d = Pair(*(last(x) - first(x) + turn * k for x, k in zip(U.across, self._shift, strict=True)))
        q = Pair(*(first(x) - last(x) for x in U.slopes))
        total = Pair(*(first(x) + last(x) for x in U.slopes))
        return Bend(d, q, d.times(2).plus(total.times(-1)).scaled(self.stiffness.psi))

    def twist(self, U: Nodes) -> Any:
        """Angle phi of the second node against the first one, in rad."""
        return (last(U.phi) - first(U.phi)) / self.l

    def _slopes(self, e: Bend, f: Bend) -> Any:
        """Integral of the product of the slopes of two shapes over each element, in m."""
        return (e.d.dot(f.d) + e.q.dot(f.q) / 12 + e.r.dot(f.r) / 20) / self.l

    def _steepness(self, e: Bend) -> Any:
        """Derivative of the shortening with respect to half the integral of v'^2 + w'^2."""
        return np.ones(self.elements) + self._slopes(e, e) / (2 * self.l)

    def shortening(self, e: Bend, ed: Bend, edd: Bend) -> Motion:
        """Extension of the elements at u = 0 in m, by their slopes and off the centroid, and its derivatives."""
        g, gd, gdd = (x.q.scaled(self.stiffness.centroid) for x in (e, ed, edd))
        g, gd, gdd = ((x.y + x.z) / self.l for x in (g, gd, gdd))
        if self.second_order:
            s, half_rate, steep = self._slopes(e, e), self._slopes(e, ed), self._steepness(e)
            g, gd = g + s / 2 + s * s / (8 * self.l), gd + half_rate * steep
            gdd = gdd + (self._slopes(ed, ed) + self._slopes(e, edd)) * steep + half_rate * half_rate / self.l
        return g, gd, gdd

    def unstretched(self, motion: tuple[Nodes, Nodes, Nodes]) -> tuple[Nodes, Nodes, Nodes]:
        """Nodal coordinates and derivatives, with u such that all element lengths are constant."""
        U, Ud, Udd = (shifted(U, -g) for U, g in zip(motion, self.shortening(*map(self.bend, motion)), strict=True))
        return U, Ud, Udd

    def extension(self, U: Nodes, Ud: Nodes) -> tuple[Any, Any]:
        """Change of length of the elements in m, and its rate."""
        e, ed = self.bend(U), self.bend(Ud)
        g, gd, _ = self.shortening(e, ed, ed)
        return last(U.u) - first(U.u) + g, last(Ud.u) - first(Ud.u) + gd

    def pull(self, e: Bend, force: Any) -> Bend:
        """Generalised forces of the axial forces on the bending of the elements, in N."""
        offset = self.stiffness.centroid.times(force / self.l)
        if not self.second_order:
            return Bend(offset.times(0.0), offset, offset.times(0.0))
        steep = force * self._steepness(e) / self.l
        return Bend(e.d.times(steep), e.q.times(steep / 12).plus(offset), e.r.times(steep / 20))

    def bubbles(self, motion: tuple[Nodes, Nodes, Nodes]) -> Motion:
        """Coefficients c of the elements and their derivatives, in m; empty without second order."""
        if not self.second_order:
            return (), (), ()
        (e, ed, edd), (k, kd, kdd) = zip(*((b, self._first_moment(b)) for b in map(self.bend, motion)), strict=True)
        rate = ed.q.dot(k) + e.q.dot(kd)
        return e.q.dot(k), rate, edd.q.dot(k) + 2 * ed.q.dot(kd) + e.q.dot(kdd)

    def _first_moment(self, e: Bend) -> Pair:
        """First moment of the slope over its mode q, which gives c = q (r / 10 - d / 2) / l in each plane."""
        return e.r.times(1 / (10 * self.l)).plus(e.d.times(-1 / (2 * self.l)))

    def with_bubbles(self, nodal: Nodes, on_c: Any, U: Nodes) -> Nodes:
        """Nodal forces equivalent to nodal forces and those on the coefficients c, which are functions of the slopes."""
        if not self.second_order:
            return nodal
        e = self.bend(U)
        across = e.q.times(on_c / self.l)
        return nodal.plus(
            self.on_nodes(Bend(across.times(-1 / 2), self._first_moment(e).times(on_c), across.times(1 / 10)))
        )

    def on_nodes(self, on: Bend) -> Nodes:
        """Nodal forces equivalent to generalised forces on the bending of the elements."""
        r = on.r.scaled(self.stiffness.psi)
        across = on.d.plus(r.times(2))
        turn = across.dot(self._shift) / self.l
        slopes = Pair(*(to_first(q - x) - to_last(q + x) for q, x in zip(on.q, r, strict=True)))
        v, w = (to_last(x) - to_first(x) for x in across)
        zero = np.zeros(self.elements)
        return along_nodes(to_first(zero), Pair(v, w), slopes, to_last(turn + zero) - to_first(turn + zero))


def shifted(U: Nodes, lengths: Any) -> Nodes:
    """Add the cumulative lengths of the preceding elements to u of each node."""
    entries, total = [as_expr(0.0)], as_expr(0.0)
    for length in lengths:
        total = total + length
        entries.append(total)
    return U._replace(u=U.u + as_expr(entries))
