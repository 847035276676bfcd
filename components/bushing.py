"""Bushing: elastic mounting between two frames."""

from __future__ import annotations

from typing import Any

import numpy as np

from acausal import Vector3, apart, as_expr, dot, expect, parameter, quantity, require, sqrt, variable
from components.orientation import norm
from components.rotation_vector import NOTHING, rate, rotation_vector, sine_axis
from components.triaxial_spring import TriaxialSpring

LARGE = 2.5  # rotation angle in rad: from there to pi, the torque is ever more sensitive to the rotation axis
ASYMMETRIC = 1e-9  # asymmetry or negative eigenvalue over the largest entry: round-off of a computed matrix


class Bushing(TriaxialSpring):
    """Linear springs and dampers along and about the three axes of frame_a, as in an elastic mounting.

    Notes
    -----
    With r = r_rel - r_rel0, the rotation vector theta and the stiffness matrix K = diag(c, c_phi) + stiffness, the
    elastic energy is V = (r, theta)' K (r, theta) / 2 + f_0' r + t_0' theta. Its gradient (f, g) gives the force f and the
    torque J(theta)' g at frame_b, with der(theta) = J(theta) w_rel, so that the load is conservative in large rotations as
    well. At frame_a the opposite load acts, with the moment r_rel x f. The damping matrix diag(d, d_phi) + damping acts on
    v_rel and w_rel.

    No branch: the component does not relate the orientations of its ends; other parts must hold both. The rotation must stay
    below half a turn, where theta jumps; beyond 2.5 rad the run warns.
    """

    c: Vector3 = parameter("stiffness along the axes of frame_a", unit="N/m", default=(0, 0, 0), minimum=0)
    c_phi: Vector3 = parameter(
        "rotational stiffness about the axes of frame_a", unit="N.m/rad", default=(0, 0, 0), minimum=0
    )
    d_phi: Vector3 = parameter(
        "rotational damping about the axes of frame_a", unit="N.m.s/rad", default=(0, 0, 0), minimum=0
    )
    stiffness: Any = parameter(
        "additional stiffness matrix of (r_rel, theta), resolved in frame_a",
        shape=(6, 6),
        default=np.zeros((6, 6)),
        doc="Entries in N/m, N and N.m/rad. Symmetric; added to diag(c, c_phi).",
    )
    damping: Any = parameter(
        "additional damping matrix of (v_rel, w_rel), resolved in frame_a",
        shape=(6, 6),
        default=np.zeros((6, 6)),
        doc="Entries in N.s/m, N.s and N.m.s/rad. No negative eigenvalues; added to diag(d, d_phi).",
    )
    t_0: Vector3 = parameter("preload: torque t without rotation, resolved in frame_a", unit="N.m", default=(0, 0, 0))
    theta: Vector3 = variable("rotation vector from frame_a to frame_b, equal in both frames", unit="rad")
    w_rel: Vector3 = variable("angular velocity of frame_b relative to frame_a, resolved in frame_a", unit="rad/s")
    t: Vector3 = variable("restoring torque on frame_b, resolved in frame_a", unit="N.m")

    def equations(self):
        yield from super().equations()
        T, (_, g), (_, t_d) = self.rotation_matrix(), self._gradient(), self._damped()
        yield self.theta == rotation_vector(T)
        yield self.w_rel == T.T @ self.frame_b.R.w - self.frame_a.R.w
        yield self.t == rate(self.theta, g) + t_d

    def load(self):
        """Force and torque of springs and dampers."""
        return self._gradient()[0] + self._damped()[0], self.t

    def requirements(self):
        yield require(self.stiffness, _asymmetric)
        yield require(self.damping, _not_dissipative)

    def validity(self):
        T = self.rotation_matrix()
        elastic = self._gradient()[1]
        square = dot(elastic, elastic)
        yield expect(
            norm(self.theta) * sqrt(square / (square + NOTHING)),  # a bushing of dampers alone has no limit
            quantity(LARGE, "rad"),
            1.0,
            f"the rotation exceeds {LARGE} rad, near half a turn, where the direction of the torque is undetermined. "
            "Limit the rotation, or use a joint with a rotational spring on its axis",
        )
        yield apart(  # (sin(phi) n, 1 + cos(phi)), of length 2 cos(phi / 2), vanishes at half a turn only
            as_expr([*sine_axis(T), (1 + T[0, 0] + T[1, 1] + T[2, 2]) / 2]),
            -dot(sine_axis(T), T @ self.w_rel) / sqrt(1 + T[0, 0] + T[1, 1] + T[2, 2] + NOTHING),
            norm(rate(self.theta, elastic)),
            "the rotation reaches half a turn, where the torque reverses abruptly. Limit the rotation, or use a joint with a "
            "rotational spring on its axis: Revolute(use_axis_flange=True)",
        )

    def stored_energy(self):
        """Elastic energy and work of the preload."""
        (f, g), r = self._gradient(), self.r_rel - self.r_rel0
        return (dot(f + self.f_0, r) + dot(g + self.t_0, self.theta)) / 2

    def loss(self):
        """Power of the dampers."""
        f_d, t_d = self._damped()
        return dot(f_d, self.v_rel) + dot(t_d, self.w_rel)

    def _gradient(self) -> tuple[Any, Any]:
        """Derivatives of the elastic energy with respect to r_rel and theta."""
        K, r, theta = self.stiffness, self.r_rel - self.r_rel0, self.theta
        f = self.f_0 + self.c * r + K[:3, :3] @ r + K[:3, 3:] @ theta
        g = self.t_0 + self.c_phi * theta + K[3:, :3] @ r + K[3:, 3:] @ theta
        return f, g

    def _damped(self) -> tuple[Any, Any]:
        """Force and torque of the dampers at frame_b, resolved in frame_a."""
        D, v, w = self.damping, self.v_rel, self.w_rel
        return self.d * v + D[:3, :3] @ v + D[:3, 3:] @ w, self.d_phi * w + D[3:, :3] @ v + D[3:, 3:] @ w


def _asymmetric(K: np.ndarray) -> str:
    """Return why a stiffness matrix is invalid, "" if it is valid."""
    if np.max(np.abs(K - K.T)) <= ASYMMETRIC * np.max(np.abs(K)):
        return ""
    i, j = np.unravel_index(np.argmax(np.abs(K - K.T)), K.shape)
    return f"is not symmetric: entry [{i},{j}] is {K[i, j]:g}, [{j},{i}] is {K[j, i]:g}; give both entries of each coupling"


def _not_dissipative(D: np.ndarray) -> str:
    """Return why a damping matrix is invalid, "" if it is valid; an antisymmetric part, without power, is allowed."""
    least = np.linalg.eigvalsh(D + D.T)[0] / 2
    if least >= -ASYMMETRIC * np.max(np.abs(D)):
        return ""
    return f"has the negative eigenvalue {least:g} and would generate power; check the signs of its entries"
