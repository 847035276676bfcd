"""Strain of a beam: elastic and damping forces, and the shortening of the axis by its slope."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from acausal import as_expr, dot
from components.beam_element import beam_matrices, gauss_points


@dataclass(frozen=True)
class Strain:
    """Strain of N elements with nodal coordinates U = (u, v, l theta) in m.

    With `second_order`, a beam that slopes by v' = sin(phi) at arc length x reaches less far along the axis: by
    f = 1 - cos(phi) = v'^2 / 2 + v'^4 / 8 per length; and its curvature is v'' / cos(phi). The axial strain of an element is
    the mean of u' + f: linear u cannot balance f at each point (membrane locking). What varies linearly in an element is
    taken up by a displacement c xi (1 - xi) along the beam, with c such that the first moment of the strain is 0. The
    energy is the sum of N^2 l / (2 E A) and of E J v''^2 (1 + v'^2) / 2, so that axial forces N act on the slopes.

    Parameters
    ----------
    elements : int
        N.
    l, EA, EJ, beta : Expr
        Length of an element in m, stiffnesses in N and N.m2, and damping in proportion to stiffness in s.
    second_order : bool
        Whether the slope shortens the axis.
    """

    elements: int
    l: Any
    EA: Any
    EJ: Any
    beta: Any
    second_order: bool

    def _slope(self, U: Any, j: int) -> Any:
        """Slope v' at the points of element j."""
        return gauss_points().slope @ U[3 * j : 3 * j + 6] / self.l

    def _integrals(self, weights: np.ndarray, U: Any, Ud: Any, Udd: Any, j: int) -> tuple[Any, Any, Any]:
        """Integral of the weighted shortening over element j in m, and its first and second derivatives."""
        v, vd, vdd = (self._slope(x, j) for x in (U, Ud, Udd))
        f, f_1, again = v * v / 2 + v * v * v * v / 8, _f_1(v), vd * vd + 1.5 * v * v * vd * vd
        return self.l * dot(weights, f), self.l * dot(weights, f_1 * vd), self.l * dot(weights, again + f_1 * vdd)

    def shortening(self, U: Any, Ud: Any, Udd: Any) -> list[tuple[Any, Any, Any]]:
        """Shortening of every element by its slope in m, and its derivatives; 0 without second order."""
        if not self.second_order:
            return [(as_expr(0.0),) * 3] * self.elements
        return [self._integrals(gauss_points().weights, U, Ud, Udd, j) for j in range(self.elements)]

    def unstretched(self, U: Any, Ud: Any, Udd: Any) -> tuple[Any, Any, Any]:
        """Nodal coordinates and derivatives, with u such that no element changes its length."""
        each = zip(*self.shortening(U, Ud, Udd), strict=True)
        return tuple(shifted(x, [-g for g in own]) for x, own in zip((U, Ud, Udd), each, strict=True))  # type: ignore[return-value]

    def with_bubbles(self, U: Any, Ud: Any, Udd: Any) -> tuple[Any, Any, Any]:
        """Append c and its derivatives of every element; nothing without second order."""
        if not self.second_order:
            return U, Ud, Udd
        each = zip(*[self._integrals(_bubble_weights(), U, Ud, Udd, j) for j in range(self.elements)], strict=True)
        return tuple(_joined(x, list(own)) for x, own in zip((U, Ud, Udd), each, strict=True))  # type: ignore[return-value]

    def without_bubbles(self, forces: Any, U: Any) -> Any:
        """Nodal forces of forces on the coordinates and on c, which follows from the slopes."""
        n = 3 * self.elements + 3
        total = [forces[k] for k in range(n)]
        for j in range(self.elements if self.second_order else 0):
            _add(total, j, forces[n + j] * (gauss_points().slope.T @ (_bubble_weights() * _f_1(self._slope(U, j)))))
        return as_expr(total)

    def angle(self, turn: Any) -> Any:
        """Angle in rad of a section whose nodal coordinate is turn = l v', with v' = sin(angle) in second order."""
        slope = turn / self.l
        return slope + slope * slope * slope / 6 if self.second_order else slope

    def turning(self, turn: Any) -> Any:
        """Derivative of the angle by the slope."""
        slope = turn / self.l
        return 1 + slope * slope / 2 if self.second_order else 1.0

    def stretching(self, U: Any, Ud: Any) -> list[Any]:
        """Axial force of each element by its extension, in N."""
        return [self.EA / self.l * (e + self.beta * rate) for e, rate in self._extensions(U, Ud)]

    def _extensions(self, U: Any, Ud: Any) -> list[tuple[Any, Any]]:
        """Change of length of each element in m, and its rate."""
        return [
            (U[3 * j + 3] - U[3 * j] + g, Ud[3 * j + 3] - Ud[3 * j] + rate)
            for j, (g, rate, _) in enumerate(self.shortening(U, Ud, Ud))
        ]

    def forces(self, U: Any, Ud: Any, N: list[Any]) -> Any:
        """Nodal forces of the axial forces N and of bending, in N, conjugate to U; shape (3 elements + 3,)."""
        bending = self.EJ / self.l**3 * (beam_matrices(self.elements).K_bending @ (U + self.beta * Ud))
        total = [bending[k] for k in range(3 * self.elements + 3)]
        points = gauss_points()
        for j, force in enumerate(N):
            total[3 * j] -= force
            total[3 * j + 3] += force
            if self.second_order:
                v, curvature = self._slope(U, j), self._curvature(U, j)
                turning = force * _f_1(v) + self.EJ * curvature * curvature * v
                bent = self.EJ * curvature * v * v / self.l
                _add(
                    total, j, points.slope.T @ (points.weights * turning) + points.curvature.T @ (points.weights * bent)
                )
        return as_expr(total)

    def _curvature(self, U: Any, j: int) -> Any:
        """Curvature v'' at the points of element j."""
        return gauss_points().curvature @ U[3 * j : 3 * j + 6] / self.l**2

    def energy(self, U: Any, stretches: bool) -> Any:
        """Elastic energy in J; that of stretch only if the axis stretches."""
        total = self.EJ / self.l**3 * dot(U, beam_matrices(self.elements).K_bending @ U) / 2
        for j in range(self.elements if self.second_order else 0):
            bent = self._slope(U, j) * self._curvature(U, j)
            total += self.EJ * self.l / 2 * dot(gauss_points().weights, bent * bent)
        return total + (self.EA / self.l * sum(e * e for e, _ in self._extensions(U, U)) / 2 if stretches else 0.0)

    def dissipated(self, U: Any, Ud: Any, stretches: bool) -> Any:
        """Power of the damping in proportion to stiffness, in W."""
        bending = self.EJ / self.l**3 * dot(Ud, beam_matrices(self.elements).K_bending @ Ud)
        axial = self.EA / self.l * sum(r * r for _, r in self._extensions(U, Ud)) if stretches else 0.0
        return self.beta * (bending + axial)


def shifted(U: Any, lengths: list[Any]) -> Any:
    """Add to u of each node the lengths of the elements before it."""
    entries, total = [U[k] for k in range(U.shape[0])], as_expr(0.0)
    for j, length in enumerate(lengths):
        total = total + length
        entries[3 * j + 3] = entries[3 * j + 3] + total
    return as_expr(entries)


def _f_1(v: Any) -> Any:
    """Derivative of the shortening f by the slope."""
    return v + v * v * v / 2


def _bubble_weights() -> np.ndarray:
    """Weights of the points for c = -3 times the integral of (1 - 2 xi) f."""
    points = gauss_points()
    return -3 * points.weights * (1 - 2 * points.xi)


def _joined(U: Any, more: list[Any]) -> Any:
    return as_expr([*[U[k] for k in range(U.shape[0])], *more])


def _add(total: list[Any], j: int, local: Any) -> None:
    """Add the six forces of element j."""
    for k in range(6):
        total[3 * j + k] += local[k]
