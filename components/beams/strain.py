"""Strain of a beam: elastic and damping forces, and the shortening of the axis by its slope."""

from __future__ import annotations

from dataclasses import dataclass
from math import sqrt
from typing import Any, NamedTuple

from acausal import as_expr


class Bend(NamedTuple):
    """Bending of an element: chord d = v_2 - v_1, symmetric q = l (theta_1 - theta_2), r = 2 d - l (theta_1 + theta_2), in m.

    With eta from 1 at the first node to -1 at the second one, l v' = d + eta q / 2 + (1 - 3 eta^2) r / 4 and
    l^2 v'' = 3 eta r - q: these modes are orthogonal in the integrals of v'^2 and of v''^2.
    """

    d: Any
    q: Any
    r: Any


@dataclass(frozen=True)
class Strain:
    """Strain of N elements with nodal coordinates U = (u, v, l theta) in m.

    With `second_order`, the slope v' = sin(phi) at arc length x shortens the projection on the axis by
    f = 1 - cos(phi) = v'^2 / 2 + v'^4 / 8 per unit length, and the curvature is v'' / cos(phi). The axial strain of an
    element is the mean of u' + f, because a linear u cannot balance f pointwise (membrane locking). An axial bubble
    c xi (1 - xi), with c such that the first moment of u' + v'^2 / 2 vanishes, balances the linear part of f. The strain
    energy is the sum of N^2 l / (2 E A) and of E J v''^2 (1 + v'^2) / 2, so that axial forces N act on the slopes.

    Parameters
    ----------
    elements : int
        N.
    l, EA, EJ, beta : Expr
        Length of an element in m, stiffnesses in N and N.m2, and stiffness-proportional damping in s.
    second_order : bool
        Whether the slope shortens the axis.
    """

    elements: int
    l: Any
    EA: Any
    EJ: Any
    beta: Any
    second_order: bool

    def _bends(self, U: Any) -> list[Bend]:
        """Bending of every element."""
        found = []
        for j in range(self.elements):
            _, v_1, a, _, v_2, b = (U[3 * j + k] for k in range(6))
            found.append(Bend(v_2 - v_1, a - b, 2 * (v_2 - v_1) - a - b))
        return found

    def _slopes(self, e: Bend, f: Bend) -> Any:
        """Integral of v' w' over an element, in m."""
        return (e.d * f.d + e.q * f.q / 12 + e.r * f.r / 20) / self.l

    def shortening(self, U: Any, Ud: Any, Udd: Any) -> list[tuple[Any, Any, Any]]:
        """Shortening of every element by its slope in m, and its derivatives; 0 without second order."""
        if not self.second_order:
            zero = as_expr(0.0)
            return [(zero, zero, zero)] * self.elements
        found = []
        for e, ed, edd in zip(self._bends(U), self._bends(Ud), self._bends(Udd), strict=True):
            s, half_rate, steep = self._slopes(e, e), self._slopes(e, ed), self._steepness(e)
            again = (self._slopes(ed, ed) + self._slopes(e, edd)) * steep + half_rate * half_rate / self.l
            found.append((s / 2 + s * s / (8 * self.l), half_rate * steep, again))
        return found

    def _steepness(self, e: Bend) -> Any:
        """Derivative of the shortening with respect to half the integral of v'^2."""
        return 1 + self._slopes(e, e) / (2 * self.l)

    def unstretched(self, U: Any, Ud: Any, Udd: Any) -> tuple[Any, Any, Any]:
        """Nodal coordinates and derivatives, with u such that all element lengths are constant."""
        g, gd, gdd = zip(*self.shortening(U, Ud, Udd), strict=True)
        return shifted(U, [-x for x in g]), shifted(Ud, [-x for x in gd]), shifted(Udd, [-x for x in gdd])

    def with_bubbles(self, U: Any, Ud: Any, Udd: Any) -> tuple[Any, Any, Any]:
        """Append c of every element and its derivatives, in m; unchanged without second order."""
        if not self.second_order:
            return U, Ud, Udd
        c, cd, cdd = [], [], []
        for e, ed, edd in zip(self._bends(U), self._bends(Ud), self._bends(Udd), strict=True):
            k, kd, kdd = (self._lean(x) for x in (e, ed, edd))
            c.append(e.q * k)
            cd.append(ed.q * k + e.q * kd)
            cdd.append(edd.q * k + 2 * ed.q * kd + e.q * kdd)
        return _joined(U, c), _joined(Ud, cd), _joined(Udd, cdd)

    def bubble(self, U: Any, j: int) -> Any:
        """Coefficient c of element j, in m; 0 without second order."""
        bend = self._bends(U)[j]
        return bend.q * self._lean(bend) if self.second_order else 0.0

    def middle(self, U: Any, j: int) -> tuple[Any, Any]:
        """Displacements (u, v) of the middle of element j, in m."""
        u_1, v_1, a, u_2, v_2, b = (U[3 * j + k] for k in range(6))
        return (u_1 + u_2) / 2 + self.bubble(U, j) / 4, (v_1 + v_2) / 2 + (a - b) / 8

    def tangents(self, U: Any) -> list[tuple[Any, Any]]:
        """Tangent d/dxi of the deformed axis, along and across the beam, at every node, in m.

        At a node the mean of the stretches on both sides is used.
        """
        stretches, found = [e for e, _ in self._extensions(U, U)], []
        for k in range(self.elements + 1):
            near, square = stretches[max(k - 1, 0) : k + 1], (U[3 * k + 2] / self.l) * (U[3 * k + 2] / self.l)
            shorter = self.l * (square / 2 + square * square / 8) if self.second_order else 0.0
            found.append((self.l - shorter + sum(near[1:], near[0]) / len(near), U[3 * k + 2]))
        return found

    def _lean(self, e: Bend) -> Any:
        return (e.r / 10 - e.d / 2) / self.l

    def without_bubbles(self, forces: Any, U: Any) -> Any:
        """Nodal forces equivalent to forces on the coordinates and on c, which is a function of the slopes."""
        n = 3 * self.elements + 3
        total = [forces[k] for k in range(n)]
        for j, e in enumerate(self._bends(U) if self.second_order else ()):
            on_q = forces[n + j] * e.q / self.l
            _add(total, j, Bend(-on_q / 2, forces[n + j] * self._lean(e), on_q / 10))
        return as_expr(total)

    def angle(self, turn: Any) -> Any:
        """Angle in rad of a section with the nodal coordinate turn = l v'; v' = sin(angle) in second order."""
        slope = turn / self.l
        return slope + slope * slope * slope / 6 if self.second_order else slope

    def angle_derivative(self, turn: Any) -> Any:
        """Derivative of the angle with respect to the slope."""
        slope = turn / self.l
        return 1 + slope * slope / 2 if self.second_order else 1.0

    def stretching(self, U: Any, Ud: Any) -> list[Any]:
        """Axial force of each element from its extension, in N."""
        return [self.EA / self.l * (e + self.beta * rate) for e, rate in self._extensions(U, Ud)]

    def _extensions(self, U: Any, Ud: Any) -> list[tuple[Any, Any]]:
        """Change of length of each element in m, and its rate."""
        return [
            (U[3 * j + 3] - U[3 * j] + g, Ud[3 * j + 3] - Ud[3 * j] + rate)
            for j, (g, rate, _) in enumerate(self.shortening(U, Ud, Ud))
        ]

    def forces(self, U: Any, Ud: Any, N: list[Any]) -> Any:
        """Nodal forces of the axial forces N and of bending, in N, conjugate to U; shape (3 elements + 3,)."""
        total = [as_expr(0.0)] * (3 * self.elements + 3)
        k = self.EJ / self.l**3
        for j, (force, e, ed) in enumerate(zip(N, self._bends(U), self._bends(Ud), strict=True)):
            total[3 * j] -= force
            total[3 * j + 3] += force
            on = Bend(as_expr(0.0), k * (e.q + self.beta * ed.q), 3 * k * (e.r + self.beta * ed.r))
            if self.second_order:
                turn = force * self._steepness(e) / self.l
                parts = [Bend(turn * e.d, turn * e.q / 12, turn * e.r / 20), self._steep_bending(e)]
                on = Bend(*(sum(entries[1:], entries[0]) for entries in zip(on, *parts, strict=True)))
            _add(total, j, on)
        return as_expr(total)

    def _steep_bending(self, e: Bend) -> Bend:
        """Derivatives of E J v''^2 v'^2 / 2, by two-point Gauss quadrature."""
        on = [as_expr(0.0)] * 3
        for sign, slope, bent in gauss(e):
            by_slope, by_bent = (self.EJ / (2 * self.l**5) * x for x in (slope * bent * bent, slope * slope * bent))
            more = (by_slope, sign / sqrt(12) * by_slope - by_bent, sign * sqrt(3) * by_bent)
            on = [a + b for a, b in zip(on, more, strict=True)]
        return Bend(*on)

    def energy(self, U: Any, stretches: bool) -> Any:
        """Strain energy in J; that of stretch only if `stretches`."""
        total = as_expr(0.0)
        for e in self._bends(U):
            total += self.EJ / self.l**3 * (e.q * e.q + 3 * e.r * e.r) / 2
            for _, slope, bent in gauss(e) if self.second_order else ():
                total += self.EJ / self.l**5 * (slope * bent) * (slope * bent) / 4
        return total + (self.EA / self.l * sum(e * e for e, _ in self._extensions(U, U)) / 2 if stretches else 0.0)

    def dissipated(self, U: Any, Ud: Any, stretches: bool) -> Any:
        """Power of the stiffness-proportional damping, in W."""
        bending = self.EJ / self.l**3 * sum(e.q * e.q + 3 * e.r * e.r for e in self._bends(Ud))
        axial = self.EA / self.l * sum(r * r for _, r in self._extensions(U, Ud)) if stretches else 0.0
        return self.beta * (bending + axial)


def shifted(U: Any, lengths: list[Any]) -> Any:
    """Add the cumulative lengths of the preceding elements to u of each node."""
    entries, total = [U[k] for k in range(U.shape[0])], as_expr(0.0)
    for j, length in enumerate(lengths):
        total = total + length
        entries[3 * j + 3] = entries[3 * j + 3] + total
    return as_expr(entries)


def gauss(e: Bend) -> list[tuple[int, Any, Any]]:
    """Return the sign of eta, l v' and l^2 v'' at the two Gauss points eta = 1 / sqrt(3) and -1 / sqrt(3)."""
    return [(sign, e.d + sign / sqrt(12) * e.q, sign * sqrt(3) * e.r - e.q) for sign in (1, -1)]


def _joined(U: Any, more: list[Any]) -> Any:
    return as_expr([*[U[k] for k in range(U.shape[0])], *more])


def _add(total: list[Any], j: int, on: Bend) -> None:
    """Add the nodal forces equivalent to generalised forces on the bending of element j."""
    across = on.d + 2 * on.r
    for k, force in ((1, -across), (2, on.q - on.r), (4, across), (5, -on.q - on.r)):
        total[3 * j + k] += force
