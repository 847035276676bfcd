"""One spatial loop of rigid bodies, as an open chain of screws that returns to the ground, by Lagrange multipliers.

All poses are written relative to the start: body k has the pose T_k = exp(S_1 q_1) ... exp(S_k q_k), with the joint screws
S of the start pose; the last body is the ground again, so that its pose is the identity. Redundant constraints cost
nothing: the linear system is solved in the sense of least squares (Murray, Li, Sastry, A Mathematical Introduction to
Robotic Manipulation, chapter 3).
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy.integrate import solve_ivp

Array = NDArray[np.float64]


@dataclass(frozen=True)
class Joint:
    """A joint in the start pose: axis of length 1, a point on it, and whether it slides along the axis."""

    axis: Sequence[float]
    point: Sequence[float] = (0.0, 0.0, 0.0)
    slides: bool = False


@dataclass(frozen=True)
class Rod:
    """The rigid body behind a joint in the start pose: mass, centre of mass and inertia tensor about it."""

    mass: float = 0.0
    centre: Sequence[float] = (0.0, 0.0, 0.0)
    inertia: Array | None = None

    @classmethod
    def between(cls, start: ArrayLike, end: ArrayLike, mass: float, crosswise: float, lengthwise: float) -> Rod:
        """Return a straight body with the two moments of inertia across and along its axis."""
        start, end = np.asarray(start, dtype=float), np.asarray(end, dtype=float)
        e = (end - start) / np.linalg.norm(end - start)
        along = np.outer(e, e)
        return cls(mass, tuple((start + end) / 2), crosswise * (np.eye(3) - along) + lengthwise * along)


@dataclass(frozen=True)
class Motion:
    """Motion of a body for given joint motion, all resolved in the world.

    Rows of `Jv` and `Jw` are velocity of the centre and angular velocity for each joint rate; `a` and `z` are the
    accelerations without those of the joints.
    """

    T: Array
    centre: Array
    Jv: Array
    Jw: Array
    a: Array
    z: Array


@dataclass(frozen=True)
class Loop:
    """A closed chain of as many joints as bodies, the last of which is the ground.

    Parameters
    ----------
    joints, bodies : sequences
        The joints from the ground on, and the body behind each of them but the last.
    gravity : array_like
        Acceleration of gravity.
    """

    joints: Sequence[Joint]
    bodies: Sequence[Rod]
    gravity: Sequence[float] = (0.0, 0.0, 0.0)

    @cached_property
    def size(self) -> int:
        """Number of joints."""
        return len(self.joints)

    def motions(self, q: Array, v: Array) -> list[Motion]:
        """Motion of every body, and of the ground at the end of the chain."""
        T, Jv0, Jw = np.eye(4), np.zeros((3, self.size)), np.zeros((3, self.size))
        a0, z = np.zeros(3), np.zeros(3)  # velocity and acceleration of the point that passes the origin
        found = []
        bodies = [*self.bodies, Rod()]
        for k, (joint, body) in enumerate(zip(self.joints, bodies, strict=True)):
            e = T[:3, :3] @ np.asarray(joint.axis)
            o = T[:3, :3] @ np.asarray(joint.point) + T[:3, 3]
            w = Jw @ v
            linear, turn = (e, np.zeros(3)) if joint.slides else (-cross(e, o), e)
            # The screw is fixed to the body before: its rate is the Lie bracket of that body's twist with it.
            z = z + cross(w, turn) * v[k]
            a0 = a0 + (cross(w, linear) + cross(Jv0 @ v, turn)) * v[k]
            Jv0, Jw = Jv0.copy(), Jw.copy()
            Jv0[:, k], Jw[:, k] = linear, turn
            T = T @ exponential(joint, q[k])
            c = T[:3, :3] @ np.asarray(body.centre) + T[:3, 3]
            Jv = Jv0 - skew(c) @ Jw
            w, v_c = Jw @ v, Jv @ v
            # Of the material point at c: spatial acceleration, carried over to c, and w x v.
            found.append(Motion(T, c, Jv, Jw, a0 + cross(z, c) + cross(w, v_c), z))
        return found

    def dynamics(self, q: Array, v: Array) -> tuple[Array, Array, Array, Array]:
        """Return M, f, the constraint Jacobian G and the curvature h with G q'' + h = 0."""
        M, f = np.zeros((self.size, self.size)), np.zeros(self.size)
        *moving, ground = self.motions(q, v)
        for body, motion in zip(self.bodies, moving, strict=True):
            w = motion.Jw @ v
            R = motion.T[:3, :3]
            I = np.zeros((3, 3)) if body.inertia is None else R @ body.inertia @ R.T
            M += body.mass * motion.Jv.T @ motion.Jv + motion.Jw.T @ I @ motion.Jw
            f -= body.mass * motion.Jv.T @ (motion.a - np.asarray(self.gravity))
            f -= motion.Jw.T @ (I @ motion.z + cross(w, I @ w))
        return M, f, np.vstack([ground.Jv, ground.Jw]), np.concatenate([ground.a, ground.z])

    def acceleration(self, q: Array, v: Array) -> Array:
        """Return q'', from M q'' + G' lambda = f and G q'' + h = 0."""
        M, f, G, h = self.dynamics(q, v)
        matrix = np.block([[M, G.T], [G, np.zeros((6, 6))]])
        return np.linalg.lstsq(matrix, np.concatenate([f, -h]), rcond=1e-10)[0][: self.size]

    def rates(self, joint: int, rate: float) -> Array:
        """Joint rates at the start that belong to one of them, in a loop of one freedom."""
        G = self.dynamics(np.zeros(self.size), np.zeros(self.size))[2]
        null = np.linalg.svd(G)[2][-1]
        return null * rate / null[joint]

    def simulate(self, times: ArrayLike, v: Array | None = None) -> Array:
        """Return q and q' at each of the increasing times from q = 0, shape (len(times), 2 size)."""
        times, n = np.asarray(times, dtype=float), self.size
        start = np.concatenate([np.zeros(n), np.zeros(n) if v is None else v])

        def derivative(_: float, y: Array) -> Array:
            return np.concatenate([y[n:], self.acceleration(y[:n], y[n:])])

        return solve_ivp(derivative, (0.0, times[-1]), start, "DOP853", times, rtol=1e-12, atol=1e-13).y.T

    def energy(self, state: Array) -> float:
        """Return the kinetic and potential energy."""
        q, v = state[: self.size], state[self.size :]
        centres = [motion.centre for motion in self.motions(q, v)]
        height = sum(b.mass * np.dot(self.gravity, c) for b, c in zip(self.bodies, centres[:-1], strict=True))
        return float(v @ self.dynamics(q, v)[0] @ v / 2 - height)

    def point(self, state: Array, body: int, at: ArrayLike) -> Array:
        """Position of a point of a body that was `at` at the start."""
        T = self.motions(state[: self.size], state[self.size :])[body].T
        return T[:3, :3] @ np.asarray(at) + T[:3, 3]

    def gap(self, state: Array) -> float:
        """Largest entry of the closed chain's pose less the identity."""
        return float(abs(self.motions(state[: self.size], state[self.size :])[-1].T - np.eye(4)).max())


def cross(a: Array, b: Array) -> Array:
    """Vector product; numpy's, which takes arrays of any shape, is most of the time of a derivative."""
    return np.array([a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]])


def skew(c: Array) -> Array:
    """Matrix of the vector product with c from the left."""
    return np.array([[0, -c[2], c[1]], [c[2], 0, -c[0]], [-c[1], c[0], 0]])


def exponential(joint: Joint, q: float) -> Array:
    """Displacement (4, 4) of a joint."""
    T, e = np.eye(4), np.asarray(joint.axis, dtype=float)
    if joint.slides:
        T[:3, 3] = q * e
        return T
    K, o = skew(e), np.asarray(joint.point, dtype=float)
    T[:3, :3] += np.sin(q) * K + (1 - np.cos(q)) * K @ K
    T[:3, 3] = o - T[:3, :3] @ o
    return T
