"""Inertia forces of a beam in a moving frame: every coupling of rigid motion and deformation."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from acausal import as_expr, cross, dot
from components.beam_element import BeamMatrices, element_matrices


@dataclass(frozen=True)
class Inertia:
    """Inertia of N elements in a frame with acceleration a, angular acceleration z and angular velocity w.

    A point of the beam is at u = (x + S1 U, S2 U, 0), resolved in the frame, and its acceleration is
    a + z x u + w x (w x u) + 2 w x du + ddu. The forces are integrals of that over the mass (Schiavo, Vigano, Ferretti
    2006, equations 36 to 38), written with the integrals of `BeamMatrices`.

    Parameters
    ----------
    matrices : BeamMatrices
        Assembled integrals.
    elements : int
        N.
    l, mu : Expr
        Length in m and mass in kg of an element.
    U, Ud, Udd : Expr, shape (3 N + 3,)
        Nodal coordinates in m, and derivatives.
    """

    matrices: BeamMatrices
    elements: int
    l: Any
    mu: Any
    U: Any
    Ud: Any
    Udd: Any

    @property
    def mass(self) -> Any:
        """Mass of the beam in kg."""
        return self.elements * self.mu

    def first(self) -> Any:
        """First moment of mass, the integral of u, in kg.m."""
        return self._moment(self.U, self.elements**2 / 2 * self.l)

    def _moment(self, U: Any, straight: Any = 0.0) -> Any:
        b = self.matrices
        return self.mu * as_expr((straight + dot(b.s1, U), dot(b.s2, U), 0.0))

    def forces(self, a: Any, z: Any, w: Any) -> tuple[Any, Any, Any]:
        """Force, moment about the origin, and nodal forces of inertia.

        Parameters
        ----------
        a, z, w : Expr, shape (3,)
            Acceleration less gravity, angular acceleration and velocity of the frame, resolved in it.

        Returns
        -------
        force, moment : Expr, shape (3,)
            In N and N.m, resolved in the frame.
        nodal : Expr, shape (3 N + 3,)
            In N, conjugate to the nodal coordinates in m.
        """
        b, l, mu, U, Ud, Udd = self.matrices, self.l, self.mu, self.U, self.Ud, self.Udd
        P, Pd, Pdd = self.first(), self._moment(Ud), self._moment(Udd)
        force = self.mass * a + cross(z, P) + cross(w, cross(w, P)) + 2 * cross(w, Pd) + Pdd
        # Integrals of S1' u_x, S1' u_y, S2' u_x, S2' u_y.
        x_1, y_1 = b.M11 @ U + l * b.x1, b.M12 @ U
        x_2, y_2 = b.M12.T @ U + l * b.x2, b.M22 @ U
        xx = mu * (self.elements**3 / 3 * l**2 + l * dot(b.x1, U) + dot(U, x_1))
        yy, xy = mu * dot(U, y_2), mu * dot(U, x_2)
        I = as_expr([[yy, -xy, 0.0], [-xy, xx, 0.0], [0.0, 0.0, xx + yy]])
        xxd, yyd = mu * dot(Ud, x_1), mu * dot(Ud, y_2)
        xyd, yxd = mu * dot(Ud, x_2), mu * dot(Ud, y_1)
        coriolis = 2 * as_expr((w[0] * yyd - w[1] * yxd, w[1] * xxd - w[0] * xyd, w[2] * (xxd + yyd)))
        relative = as_expr((0.0, 0.0, mu * (dot(x_2, Udd) - dot(y_1, Udd))))
        moment = cross(P, a) + I @ z + cross(w, I @ w) + coriolis + relative
        wx, wy, wz = w
        nodal = mu * (
            a[0] * b.s1
            + a[1] * b.s2
            + (wx * wy - z[2]) * y_1
            - (wy**2 + wz**2) * x_1
            + (wx * wy + z[2]) * x_2
            - (wx**2 + wz**2) * y_2
            + 2 * wz * (b.M12.T @ Ud - b.M12 @ Ud)
            + (b.M11 + b.M22) @ Udd
        )
        return force, moment, nodal

    def kinetic_energy(self, v: Any, w: Any) -> Any:
        """Kinetic energy in J, with velocity and angular velocity of the frame resolved in it."""
        b, l, mu, U, Ud = self.matrices, self.l, self.mu, self.U, self.Ud
        x_1, x_2, y_1, y_2 = b.M11 @ U + l * b.x1, b.M12.T @ U + l * b.x2, b.M12 @ U, b.M22 @ U
        xx = mu * (self.elements**3 / 3 * l**2 + l * dot(b.x1, U) + dot(U, x_1))
        yy, xy = mu * dot(U, y_2), mu * dot(U, x_2)
        I = as_expr([[yy, -xy, 0.0], [-xy, xx, 0.0], [0.0, 0.0, xx + yy]])
        spin = mu * (dot(x_2, Ud) - dot(y_1, Ud))
        own = mu * dot(Ud, (b.M11 + b.M22) @ Ud)
        translation = self.mass * dot(v, v) + 2 * dot(v, cross(w, self.first()) + self._moment(Ud))
        return (translation + dot(w, I @ w) + 2 * w[2] * spin + own) / 2

    def element_forces(self, j: int, a: Any, z: Any, w: Any) -> tuple[Any, Any]:
        """Force and moment about the origin of the inertia of element j alone."""
        nodes = slice(3 * j, 3 * j + 6)
        shift = np.array([j, 0, 0, j, 0, 0])
        # An element whose root lies at x = j l is one at the origin with both nodes moved by j l.
        own = Inertia(
            element_matrices(), 1, self.l, self.mu, self.U[nodes] + self.l * shift, self.Ud[nodes], self.Udd[nodes]
        )
        force, moment, _ = own.forces(a, z, w)
        return force, moment
