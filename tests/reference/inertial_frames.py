"""The third seed node by node in numpy: equations (1) to (40) as printed, and the corrected equations, without integrals."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from scipy.linalg import expm

Array = np.ndarray


def skew(v: Array) -> Array:
    """The matrix of v x."""
    return np.array([[0, -v[2], v[1]], [v[2], 0, -v[0]], [-v[1], v[0], 0]])


@dataclass
class Nodes:
    """A free body at its nodes: modes Psi, the rigid ones about the centre of mass first; load at one node."""

    mass: Any
    places: Array
    flexible: Array
    squares: Array
    damping: Array
    loaded: int

    def __post_init__(self) -> None:
        moves = np.tile(np.eye(3), (len(self.places), 1))
        turns = np.column_stack([np.cross(axis, self.places).ravel() for axis in np.eye(3)])
        self.modes = np.column_stack([moves, turns, self.flexible])
        self.weighed = self.mass @ self.modes
        self.inverse = np.linalg.inv(self.modes.T @ self.weighed)
        self.at_load = self.modes.reshape(-1, 3, self.modes.shape[1])[self.loaded]

    def project(self, x: Array) -> Array:
        """Inverse modal expansion, (30) and (31)."""
        return self.inverse @ (self.weighed.T @ x)

    def turn(self, R: Array, x: Array) -> Array:
        """Apply a matrix to the vector of each node."""
        return (x.reshape(-1, 3) @ R.T).ravel()

    def acceleration(self, q: Array, v: Array, force: Array) -> Array:
        """(32), the force being resolved in the frame of q."""
        a = self.inverse @ (self.at_load.T @ force)
        a[6:] -= self.squares * q[6:] + self.damping * v[6:]
        return a


def rotation_rate(m: Array, w: Array) -> Array:
    """(20) with (22) as rotation vectors."""
    angle = np.linalg.norm(m)
    rest = 1 / 12 if angle < 1e-4 else (1 - angle / 2 / np.tan(angle / 2)) / angle**2
    return w + np.cross(m, w) / 2 + rest * np.cross(m, np.cross(m, w))


def printed(body: Nodes, force: Any, start: tuple[Array, Array], dt: float, count: int) -> dict[str, Array]:
    """(36) to (40) with the points P, Q, R along x and y; M is accumulated, the force turned by the stage."""
    q, v = (np.array(x, dtype=float) for x in start)
    O, m, rows = np.zeros(3), np.zeros(3), []
    for n in range(count + 1):
        A = expm(-skew(m))
        forces = [force(n * dt), (force(n * dt) + force(n * dt + dt)) / 2]
        forces += [forces[1], force(n * dt + dt)]
        rows.append((O, A, q, v, body.acceleration(q, v, A @ forces[0])))
        vP, vQ = np.cross(v[3:6], [1, 0, 0]), np.cross(v[3:6], [0, 1, 0])
        kq, kv, kP, kQ, km = ([np.zeros_like(x)] for x in (q, v, vP, vQ, m))
        for part, f in zip((0, 0.5, 0.5, 1), forces, strict=True):
            P, Q = vP + part * kP[-1], vQ + part * kQ[-1]
            w = np.array([Q[2], -P[2], P[1]])
            stage = m + part * km[-1]
            turned = expm(-skew(stage)) @ A.T
            moved = q + part * kq[-1]
            moved[:6] -= part * kq[-1][:6]
            q_k = body.project(body.turn(turned, body.modes @ moved)) if part else q
            v_k = body.project(body.turn(turned, body.modes @ (v + part * kv[-1]))) if part else v
            a = body.acceleration(q_k, v_k, expm(-skew(stage)) @ f)
            kq.append(dt * v_k)
            kv.append(dt * a)
            kP.append(dt * (np.cross(a[3:6], [1, 0, 0]) - np.cross(w, P)))
            kQ.append(dt * (np.cross(a[3:6], [0, 1, 0]) - np.cross(w, Q)))
            km.append(dt * rotation_rate(stage, w))
        dq, dv, dm = ((k[1] + 2 * k[2] + 2 * k[3] + k[4]) / 6 for k in (kq, kv, km))
        turned = expm(-skew(m + dm)) @ A.T
        O = O + A.T @ dq[:3]
        moved = q + dq
        moved[:6] -= dq[:6]
        q = body.project(body.turn(turned, body.modes @ moved))
        v = body.project(body.turn(turned, body.modes @ (v + dv)))
        m = m + dm
    return dict(zip(("O", "A", "q", "v", "a"), map(np.array, zip(*rows, strict=True)), strict=True))


def corrected(body: Nodes, force: Any, start: tuple[Array, Array], dt: float, count: int) -> dict[str, Array]:
    """One frame in each step: the equations in body axes, by RK4."""
    q, v = (np.array(x, dtype=float) for x in start)
    O, A, rows = np.zeros(3), np.eye(3), []

    def rates(t: float, state: tuple[Array, ...], A: Array) -> tuple[Array, ...]:
        _, m, q, v = state
        T, w = expm(-skew(m)) @ A, v[3:6]
        dv = body.acceleration(q, v, T @ force(t)) - body.project(body.turn(skew(w), body.modes @ v))
        dq = v - body.project(body.turn(skew(w), body.modes @ q))
        dq[:6] = 0
        return T.T @ v[:3], rotation_rate(m, w), dq, dv

    for n in range(count + 1):
        state = (O, np.zeros(3), q, v)
        k = [rates(n * dt, state, A)]
        rows.append((O, A, q, v, k[0][3]))
        for part in (0.5, 0.5, 1):
            moved = tuple(x + part * dt * d for x, d in zip(state, k[-1], strict=True))
            k.append(rates(n * dt + part * dt, moved, A))
        mean = [(a + 2 * b + 2 * c + d) / 6 for a, b, c, d in zip(*k, strict=True)]
        O, m, q, v = (x + dt * d for x, d in zip(state, mean, strict=True))
        A = expm(-skew(m)) @ A
    return dict(zip(("O", "A", "q", "v", "a"), map(np.array, zip(*rows, strict=True)), strict=True))
