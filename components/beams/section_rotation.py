"""Rotation of a section of a beam, as a function of the slopes v', w' and of the angle phi about the tangent."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from acausal import as_expr, cos, cross, dot, sin
from components.orientation import (
    RelativeOrientation,
    absolute_rotation,
    axis_matrix,
    null_rotation,
    planar_rotation,
)

E_X, E_Y, E_Z = np.eye(3)


@dataclass(frozen=True)
class SectionRotation:
    """Turns by alpha about z, by -beta about the new y and by psi about the new x.

    With second order, the section is turned from the axis x to the tangent (sqrt(1 - v'^2 - w'^2), v', w') on the shortest
    way, and by phi about it:

    alpha = v' + v'^3 / 6 + v' w'^2 / 2, beta = w' + w'^3 / 6, psi = phi - v' w' / 2.

    Otherwise the rotation vector is (phi, -w', v') up to the second order: alpha = v' - w' phi / 2, beta = w' + v' phi / 2,
    psi = phi - v' w' / 2. With alpha = v', beta = w', psi = phi, a chain of frames would converge with order 1.

    Parameters
    ----------
    v, w, phi : Expr
        Slopes v' and w', and phi in rad.
    second_order : bool
        Whether slopes are those of the unit tangent at arc length.
    """

    v: Any
    w: Any
    phi: Any
    second_order: bool

    @property
    def angles(self) -> tuple[Any, Any, Any]:
        """Angles alpha, beta and psi in rad."""
        v, w, phi = self.v, self.w, self.phi
        if self.second_order:
            return v + v * v * v / 6 + v * w * w / 2, w + w * w * w / 6, phi - v * w / 2
        return v - w * phi / 2, w + v * phi / 2, phi - v * w / 2

    @property
    def _slopes(self) -> tuple[Any, Any, Any]:
        """Derivatives of each angle with respect to v', w' and phi."""
        v, w, phi = self.v, self.w, self.phi
        if self.second_order:
            rows = (1 + (v * v + w * w) / 2, v * w, 0.0), (0.0, 1 + w * w / 2, 0.0), (-w / 2, -v / 2, 1.0)
        else:
            rows = (1.0, -phi / 2, -w / 2), (phi / 2, 1.0, v / 2), (-w / 2, -v / 2, 1.0)
        alpha, beta, psi = map(as_expr, rows)
        return alpha, beta, psi

    def _turns(self) -> list[tuple[Any, Any]]:
        """Return axis and angle of every turn that is not zero."""
        alpha, beta, psi = self.angles
        return [(n, angle) for n, angle in ((E_Z, alpha), (E_Y, -beta), (E_X, psi)) if not angle.sx.is_zero()]

    def orientation(self) -> RelativeOrientation:
        """Return the orientation of the section relative to the reference frame."""
        R = null_rotation()
        for n, angle in self._turns():
            R = absolute_rotation(R, planar_rotation(n, angle))
        return R

    def matrix(self) -> Any:
        """Return the rotation matrix from the reference frame to the section, shape (3, 3)."""
        T = as_expr(np.eye(3))
        for n, angle in self._turns():
            T = axis_matrix(n, angle) @ T
        return T

    def rates(self, first: Any, second: Any) -> tuple[Any, Any]:
        """Return the angular velocity and acceleration of the section in the reference frame, resolved in it.

        Parameters
        ----------
        first, second : Expr, shape (3,)
            First and second derivatives of (v', w', phi).
        """
        alpha, beta, psi = (dot(row, first) for row in self._slopes)
        pairs = zip(self._slopes, self._slope_rates(first), strict=True)
        second_rates = [dot(row, second) + dot(change, first) for row, change in pairs]
        (z, y, x), c, s = self._axes(), cos(self.angles[0]), sin(self.angles[0])
        change_y = alpha * as_expr((c, s, 0.0))
        change_x = cross(alpha * z + beta * y, x)
        turning = sum((axis * rate for axis, rate in zip((z, y, x), second_rates, strict=True)), as_expr(np.zeros(3)))
        return alpha * z + beta * y + psi * x, turning + beta * change_y + psi * change_x

    def _slope_rates(self, rates: Any) -> tuple[Any, Any, Any]:
        """Rates of `_slopes`, at the rates of (v', w', phi)."""
        v, w, (dv, dw, dphi) = self.v, self.w, rates
        if self.second_order:
            rows = (v * dv + w * dw, dv * w + v * dw, 0.0), (0.0, w * dw, 0.0), (-dw / 2, -dv / 2, 0.0)
        else:
            rows = (0.0, -dphi / 2, -dw / 2), (dphi / 2, 0.0, dv / 2), (-dw / 2, -dv / 2, 0.0)
        alpha, beta, psi = map(as_expr, rows)
        return alpha, beta, psi

    def vector(self) -> tuple[Any, Any, Any]:
        """Return the rotation vector in rad, resolved in the reference frame, to the order of the angles."""
        steep = 1 + (self.v * self.v + self.w * self.w) / 6 if self.second_order else 1.0
        return self.phi, -self.w * steep, self.v * steep

    def _axes(self) -> tuple[Any, Any, Any]:
        """Return the axes of the angles alpha, beta and psi, resolved in the reference frame."""
        alpha, beta, _ = self.angles
        c, s = cos(alpha), sin(alpha)
        return E_Z, as_expr((s, -c, 0.0)), as_expr((cos(beta) * c, cos(beta) * s, sin(beta)))

    def axis(self) -> Any:
        """Return the axis of the beam in this section, resolved in the reference frame, shape (3,)."""
        return self._axes()[2]

    def forces(self, torque: Any) -> tuple[Any, Any, Any]:
        """Return the torques on v', w' and phi in N.m of a torque resolved in the reference frame."""
        on = [dot(axis, torque) for axis in self._axes()]
        total = sum((x * row for x, row in zip(on, self._slopes, strict=True)), as_expr(np.zeros(3)))
        return total[0], total[1], total[2]

    def torque(self, on: Any) -> Any:
        """Return the torque resolved in the reference frame in N.m, with the given torques on v', w' and phi."""
        (a, b, c), m = self._slopes, as_expr(on)
        det = dot(a, cross(b, c))
        on_alpha, on_beta, on_psi = (dot(column, m) / det for column in (cross(b, c), cross(c, a), cross(a, b)))
        alpha, beta, _ = self.angles
        along = (on_psi - sin(beta) * on_alpha) / cos(beta)
        c, s = cos(alpha), sin(alpha)
        return as_expr((c * along + s * on_beta, s * along - c * on_beta, on_alpha))
