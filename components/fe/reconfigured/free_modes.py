"""All modes of a free body, rigid and flexible, with the projections that motion in an inertial frame needs."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np

from acausal import as_expr
from components.fe.arrays import Array
from components.fe.reduction.interface import Interface
from components.fe.reduction.reduced_body import ReducedBody

# The Levi-Civita symbol: (e_k x r)_i = PERMUTED[i, k, l] r_l.
PERMUTED = np.array([[[(i - j) * (j - k) * (k - i) / 2 for k in range(3)] for j in range(3)] for i in range(3)])


@dataclass(frozen=True, eq=False)
class FreeModes:
    """Modes Psi of a free body: three translations, three rotations about its centre of mass, and n flexible modes.

    The rigid modes follow from the mass, the centre of mass and the second moments of the body, and are exact to
    round-off, unlike eigenvectors near 0 Hz. N = 6 + n is the number of all modes.

    Parameters
    ----------
    body : ReducedBody
        Body with mean axes: its modes are orthogonal to rigid motion.
    damping : array, shape (n,)
        Damping ratio of each flexible mode, added to the damping of the body.
    """

    body: ReducedBody
    damping: Array

    @property
    def size(self) -> int:
        """Number N of all modes."""
        return 6 + self.body.n

    @cached_property
    def inertia(self) -> Array:
        """Inertia tensor about the centre of mass in kg.m2, shape (3, 3)."""
        P = self.body.second_moment
        return np.trace(P) * np.eye(3) - P

    @cached_property
    def inverse(self) -> Array:
        """Inverse of the modal mass, shape (N, N)."""
        found = np.zeros((self.size, self.size))
        found[:3, :3] = np.eye(3) / self.body.mass
        found[3:6, 3:6] = np.linalg.inv(self.inertia)
        found[6:, 6:] = np.linalg.inv(self.body.M) if self.body.n else 0
        return found

    @cached_property
    def products(self) -> Array:
        """M_q^-1 times the integrals of psi_a psi_b' dm, shape (3, 3, N, N)."""
        body, E, e = self.body, np.eye(3), PERMUTED
        found = np.zeros((self.size, self.size, 3, 3))
        moves, turns, flexible = slice(0, 3), slice(3, 6), slice(6, None)
        found[moves, moves] = body.mass * np.einsum("ai,bj->abij", E, E)
        found[turns, turns] = np.einsum("ial,jbm,lm->abij", e, e, body.second_moment)
        found[turns, flexible] = np.einsum("ial,blj->abij", e, body.modal_second)
        found[flexible, turns] = found[turns, flexible].transpose(1, 0, 3, 2)
        found[flexible, flexible] = body.modal_products
        return np.einsum("ab,bcij->ijac", self.inverse, found)

    @cached_property
    def turning(self) -> Array:
        """M_q^-1 Psi' M (e_k~) Psi for the three axes, shape (3, N, N)."""
        return np.einsum("ikj,ijab->kab", PERMUTED, self.products)

    @cached_property
    def elastic(self) -> Array:
        """M^-1 K, shape (n, n), in 1/s2."""
        return np.linalg.solve(self.body.M, self.body.K) if self.body.n else np.zeros((0, 0))

    @cached_property
    def drag(self) -> Array:
        """M^-1 times the damping matrix, shape (n, n), in 1/s."""
        if not self.body.n:
            return np.zeros((0, 0))
        from scipy.linalg import eigh

        squares, shapes = eigh(self.body.K, self.body.M)
        rates = 2 * self.damping * np.sqrt(np.maximum(squares, 0))
        return np.linalg.solve(self.body.M, self.body.D) + shapes @ np.diag(rates) @ shapes.T @ self.body.M

    def load(self, interface: Interface) -> tuple[Array, Array]:
        """Return M_q^-1 Psi' of unit forces and unit moments at a frame, with the lever of the undeformed body.

        Parameters
        ----------
        interface : Interface
            The frame.

        Returns
        -------
        force, moment : array, shape (N, 3)
            Modal accelerations.
        """
        X = interface.place
        lever = np.cross(X, np.eye(3)).T
        force = np.vstack([np.eye(3), lever, interface.displacement.T])
        moment = np.vstack([np.zeros((3, 3)), np.eye(3), interface.rotation.T])
        return self.inverse @ force, self.inverse @ moment

    def turned(self, R: Any, z: Any) -> Any:
        """Project a rotated motion on the modes: M_q^-1 Psi' M R Psi z.

        Parameters
        ----------
        R : Expr, shape (3, 3)
            Rotation matrix.
        z : Expr, shape (N,)
            Amplitudes of all modes.
        """
        return sum((R[i, j] * (as_expr(self.products[i, j]) @ z) for i in range(3) for j in range(3)), _none(z))

    def crossed(self, w: Any, z: Any) -> Any:
        """Project w x the motion on the modes: M_q^-1 Psi' M (w~) Psi z.

        Parameters
        ----------
        w : Expr, shape (3,)
            Angular velocity in rad/s.
        z : Expr, shape (N,)
            Amplitudes of all modes.
        """
        return sum((w[k] * (as_expr(self.turning[k]) @ z) for k in range(3)), _none(z))

    def restored(self, q: Any, v: Any) -> Any:
        """Return the accelerations of the flexible modes by stiffness and damping, shape (n,).

        Parameters
        ----------
        q, v : Expr, shape (n,)
            Amplitudes of the flexible modes and their rates.
        """
        return -(as_expr(self.elastic) @ q + as_expr(self.drag) @ v)


def _none(z: Any) -> Any:
    return as_expr(np.zeros(len(z)))
