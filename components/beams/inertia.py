"""Inertia forces of a beam in a moving frame, with all couplings of rigid-body motion and deformation."""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cached_property
from typing import Any

import numpy as np

from acausal import as_expr, cross, dot
from components.beams.element import BeamMatrices, element_dofs, element_matrices


@dataclass(frozen=True)
class Inertia:
    """Inertia of N elements in a frame with acceleration a, angular acceleration z and angular velocity w.

    A point of the beam has the position u = (x + S1 U, S2 U, 0), resolved in the frame, and the acceleration
    a + z x u + w x (w x u) + 2 w x du + ddu. The inertia forces are its mass integrals (Schiavo, Vigano, Ferretti 2006,
    equations 36 to 38), expressed by `BeamMatrices`.

    Parameters
    ----------
    matrices : BeamMatrices
        Assembled integrals.
    elements : int
        N.
    l, mu : Expr
        Length in m and mass in kg of an element.
    U, Ud, Udd : Expr, shape (n,)
        Coordinates of the matrices in m, and their derivatives.
    centrifugal, coriolis : bool
        Whether w x (w x u) includes U, beside the straight beam, and whether 2 w x du is included.
    rest : Expr or float
        U of the undeformed beam.
    """

    matrices: BeamMatrices
    elements: int
    l: Any
    mu: Any
    U: Any
    Ud: Any
    Udd: Any
    centrifugal: bool = True
    coriolis: bool = True
    rest: Any = 0.0

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
            Acceleration minus gravity, angular acceleration and angular velocity of the frame, resolved in it.

        Returns
        -------
        force, moment : Expr, shape (3,)
            In N and N.m, resolved in the frame.
        nodal : Expr, shape (n,)
            In N, conjugate to the nodal coordinates in m.
        """
        b, mu, Ud, Udd = self.matrices, self.mu, self.Ud, self.Udd
        P, Pdd, turning = self.first(), self._moment(Udd), self if self.centrifugal else self._straight()
        x_1, y_1, x_2, y_2 = self._position
        c_1, d_1, c_2, d_2 = turning._position
        relative = as_expr((0.0, 0.0, self._spin(Udd)))
        force = self.mass * a + cross(z, P) + cross(w, cross(w, turning.first())) + Pdd
        moment = cross(P, a) + self._tensor @ z + cross(w, turning._tensor @ w) + relative
        wx, wy, wz = w
        nodal = mu * (
            a[0] * b.s1
            + a[1] * b.s2
            + z[2] * (x_2 - y_1)
            + wx * wy * (c_2 + d_1)
            - (wy**2 + wz**2) * c_1
            - (wx**2 + wz**2) * d_2
            + (b.M11 + b.M22) @ Udd
        )
        if self.coriolis:
            xxd, yyd = mu * dot(Ud, x_1), mu * dot(Ud, y_2)
            xyd, yxd = mu * dot(Ud, x_2), mu * dot(Ud, y_1)
            force += 2 * cross(w, self._moment(Ud))
            moment += 2 * as_expr((wx * yyd - wy * yxd, wy * xxd - wx * xyd, wz * (xxd + yyd)))
            nodal += 2 * mu * wz * (b.M12.T @ Ud - b.M12 @ Ud)
        return force, moment, nodal

    @cached_property
    def _position(self) -> tuple[Any, Any, Any, Any]:
        """Integrals of S1' u_x, S1' u_y, S2' u_x, S2' u_y."""
        b, l, U = self.matrices, self.l, self.U
        return b.M11 @ U + l * b.x1, b.M12 @ U, b.M12.T @ U + l * b.x2, b.M22 @ U

    @cached_property
    def _tensor(self) -> Any:
        """Inertia tensor about the origin in kg.m2."""
        b, l, mu, U = self.matrices, self.l, self.mu, self.U
        x_1, _, x_2, y_2 = self._position
        xx = mu * (self.elements**3 / 3 * l**2 + l * dot(b.x1, U) + dot(U, x_1))
        yy, xy = mu * dot(U, y_2), mu * dot(U, x_2)
        return as_expr([[yy, -xy, 0.0], [-xy, xx, 0.0], [0.0, 0.0, xx + yy]])

    def _straight(self) -> Inertia:
        """Inertia of the undeformed beam."""
        return replace(self, U=as_expr(np.ones(self.U.shape)) * self.rest)

    def momentum(self) -> Any:
        """Generalised momenta of the deformation rates, without rigid-body motion, in kg.m/s, shape (n,)."""
        return self.mu * ((self.matrices.M11 + self.matrices.M22) @ self.Ud)

    def kinetic_energy(self, v: Any, w: Any) -> Any:
        """Kinetic energy in J, with velocity and angular velocity of the frame resolved in it."""
        Ud, I = self.Ud, self._tensor
        own = dot(Ud, self.momentum())
        translation = self.mass * dot(v, v) + 2 * dot(v, cross(w, self.first()) + self._moment(Ud))
        return (translation + dot(w, I @ w) + 2 * w[2] * self._spin(Ud) + own) / 2

    def deformation_momentum(self) -> tuple[Any, Any]:
        """Momentum of the deformation rates in kg.m/s, and their angular momentum about the origin along z, in kg.m2/s."""
        return self._moment(self.Ud), self._spin(self.Ud)

    def _spin(self, rates: Any) -> Any:
        _, y_1, x_2, _ = self._position
        return self.mu * (dot(x_2, rates) - dot(y_1, rates))

    def element(self, j: int) -> Inertia:
        """Inertia of element j alone, in the same frame."""
        # An element with its root at x = j l equals one at the origin with both nodes displaced by j l.
        bubble = self.matrices.bubbles > 0
        rest = self.l * np.array([j, 0, 0, j, 0, 0, *[0] * bubble])
        U, Ud, Udd = ([x[k] for k in element_dofs(j, self.elements, bubble)] for x in (self.U, self.Ud, self.Udd))
        return replace(
            self,
            matrices=element_matrices(bubble),
            elements=1,
            U=as_expr(U) + rest,
            Ud=as_expr(Ud),
            Udd=as_expr(Udd),
            rest=rest,
        )
