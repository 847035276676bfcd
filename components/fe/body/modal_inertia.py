"""Inertia forces of a body with modal deformation in a moving frame, with all couplings to its rigid motion."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np

from acausal import as_expr, cross, dot, quantity
from components.fe.reduction.reduced_body import ReducedBody

# Entries that represent a symmetric matrix together with its trace. The trace of B is M, which is sparse for orthogonal
# modes, so that five instead of six products of full matrices remain.
PAIRS = ((0, 0), (1, 1), (0, 1), (0, 2), (1, 2))
AXES = ((1, 2), (2, 0), (0, 1))  # entries of an antisymmetric matrix, by axis


@dataclass(frozen=True)
class ModalInertia:
    """Inertia of a body of n modes in a frame with acceleration a, angular acceleration z and angular velocity w.

    A point of the body is at r = r_0 + phi q, resolved in the frame, with acceleration a + z x r + w x (w x r) + 2 w x
    r' + r''. Its mass integrals, alone, with r x and with phi', give the force, the moment and the modal forces. With
    the first moments s(q) of the mass, the second moments P(q) and J = trace(P) E - P, half their derivatives g_b, the
    moments H_b(q) of the modes, and W = w w' - w^2 E,

    force = m a + z x s + w x (w x s) + 2 w x s' + s'',
    moment = s x a + J z + w x J w + J' w + w x (H q') + H q'',
    row b = S_b . a + H_b . z + W : g_b + 2 w . H_b' + (M q'')_b,

    which is Vlasenko, Kasper 2008, equations 49 to 98, in the axes of the frame and with the sign of their equation 77
    corrected. H is linear in q with antisymmetric coefficients, so that H' q' = 0.

    Parameters
    ----------
    body : ReducedBody
        Mass integrals of the undeformed body and its modes.
    q, qd, qdd : Expr, shape (n,)
        Modal coordinates in m, and derivatives.
    order : str
        "second_order": all terms of u = phi q, if the body has their integrals. "first_order": mass matrix to first
        order in q; it conserves energy as well. "constant": s, P and H of the undeformed body, for negligible
        amplitudes; it does not conserve energy.
    centrifugal, coriolis : bool
        Whether to include the terms in w^2 that depend on q (those of the undeformed body are always included), and the
        terms in w and q'.
    """

    body: ReducedBody
    q: Any
    qd: Any
    qdd: Any
    order: str = "second_order"
    centrifugal: bool = True
    coriolis: bool = True

    def forces(self, a: Any, z: Any, w: Any) -> tuple[Any, Any, Any]:
        """Return force, moment about the origin, and modal inertia forces.

        Parameters
        ----------
        a, z, w : Expr, shape (3,)
            Acceleration less gravity, angular acceleration and velocity of the frame, resolved in it.

        Returns
        -------
        force, moment : Expr, shape (3,)
            In N and N.m, resolved in the frame.
        modal : Expr, shape (n,)
            In N, conjugate to q.
        """
        body, S = self.body, self.body.modal_first
        s, turned, J = self.first(), self._turned_first, self._turned_tensor
        force = self.mass * a + cross(z, s) + cross(w, cross(w, turned)) + S @ self.qdd
        moment = cross(s, a) + self._tensor @ z + cross(w, J @ w) + self._spin(self.qdd)
        modal = S.T @ a + self._along(self._modal_moments, z) + self._centrifugal(w) + body.M @ self.qdd
        if self.coriolis:
            force += 2 * cross(w, self.relative_momentum())
            moment += cross(w, self._spin(self.qd))
            if self.order != "constant":
                moment += _tensor([dot(g, self.qd) for g in self._slopes]) @ (2 * w)
                modal += self._along([C @ self.qd for C in self._gyroscopic], 2 * w)
        return force, moment, modal

    @property
    def mass(self) -> Any:
        """Mass in kg."""
        return quantity(self.body.mass, "kg")

    def first(self) -> Any:
        """Return the first moment s of the mass in kg.m, shape (3,), resolved in the frame."""
        rest = quantity(self.body.first_moment, "kg.m")
        return rest if self.order == "constant" else rest + self.body.modal_first @ self.q

    def relative_momentum(self) -> Any:
        """Return the momentum of the modal rates in kg.m/s, shape (3,), resolved in the frame."""
        return self.body.modal_first @ self.qd

    def rates(self, w: Any) -> Any:
        """Return the modal rates on which damping acts in m/s, shape (n,), at the angular velocity w of the frame."""
        return self.qd

    def momentum(self) -> Any:
        """Return the modal momenta M q' in kg.m/s, shape (n,)."""
        return self.body.M @ self.qd

    def kinetic_energy(self, v: Any, w: Any) -> Any:
        """Return the kinetic energy in J, with velocity and angular velocity of the frame resolved in it."""
        translation = self.mass * dot(v, v) + 2 * dot(v, cross(w, self.first()) + self.relative_momentum())
        spin = dot(w, self._spin(self.qd))
        return (translation + dot(w, self._tensor @ w) + 2 * spin + dot(self.qd, self.momentum())) / 2

    def _centrifugal(self, w: Any) -> Any:
        """Return the modal forces W : g_b."""
        return self._turned(w, self._slopes if self.centrifugal else self._straight)

    def _turned(self, w: Any, slopes: list[Any]) -> Any:
        """Return the products W : g_b, with g_b given as PAIRS and trace."""
        x, y, z = (w[k] * w[k] for k in range(3))
        W = (x - z, y - z, 2 * (w[0] * w[1]), 2 * (w[0] * w[2]), 2 * (w[1] * w[2]), -(x + y))
        return sum((factor * g for factor, g in zip(W, slopes, strict=True)), self._none)

    def _spin(self, rates: Any) -> Any:
        """Return the sum of H_b times the rate of mode b, shape (3,)."""
        return as_expr([dot(H, rates) for H in self._modal_moments])

    def _along(self, moments: list[Any], w: Any) -> Any:
        """Return the components of the modal moments along w, shape (n,)."""
        return sum((H * w[k] for k, H in enumerate(moments)), self._none)

    @property
    def _none(self) -> Any:
        return as_expr(np.zeros(len(self.body.M)))

    @cached_property
    def _straight(self) -> list[Any]:
        """Half the derivatives of the second moments of the undeformed body: PAIRS and trace, each (n,)."""
        A = self.body.modal_second
        return [as_expr(v) for v in (*((A[:, i, j] + A[:, j, i]) / 2 for i, j in PAIRS), np.trace(A, axis1=1, axis2=2))]

    @cached_property
    def _slopes(self) -> list[Any]:
        """Half the derivatives g_b of the second moments: PAIRS and trace, each (n,), in kg.m."""
        if self.order != "second_order" or not self.body.second_order:
            return self._straight
        B = self.body.modal_products
        products = [*((B[:, :, i, j] + B[:, :, j, i]) / 2 for i, j in PAIRS), self.body.M]
        return [A + G @ self.q for A, G in zip(self._straight, products, strict=True)]

    @cached_property
    def _gyroscopic(self) -> list[np.ndarray]:
        """Coefficients of q in the moments H_b, by axis: antisymmetric, each (n, n), in kg."""
        B = self.body.modal_products * (self.order != "constant")
        return [B[:, :, j, i] - B[:, :, i, j] for i, j in AXES]

    @cached_property
    def _modal_moments(self) -> list[Any]:
        """Moments H_b of the modes, the integrals of r x phi_b, by axis, each (n,), in kg.m."""
        A = self.body.modal_second
        rest = [as_expr(A[:, i, j] - A[:, j, i]) for i, j in AXES]
        return [H + C @ self.q for H, C in zip(rest, self._gyroscopic, strict=True)]

    @cached_property
    def _rest(self) -> list[Any]:
        P = self.body.second_moment
        return [quantity(value, "kg.m2") for value in (*(P[i, j] for i, j in PAIRS), np.trace(P))]

    @cached_property
    def _tensor(self) -> Any:
        """Inertia tensor J about the origin in kg.m2."""
        if self.order == "constant":
            return _tensor(self._rest)
        sums = [A + g for A, g in zip(self._straight, self._slopes, strict=True)]
        return _tensor([P + dot(g, self.q) for P, g in zip(self._rest, sums, strict=True)])

    @property
    def _turned_first(self) -> Any:
        return self.first() if self.centrifugal else quantity(self.body.first_moment, "kg.m")

    @property
    def _turned_tensor(self) -> Any:
        return self._tensor if self.centrifugal else _tensor(self._rest)


def _tensor(P: Any) -> Any:
    """Return the inertia tensor of second moments given as PAIRS and trace."""
    xx, yy, xy, xz, yz, trace = P
    return as_expr([[trace - xx, -xy, -xz], [-xy, trace - yy, -yz], [-xz, -yz, xx + yy]])
