"""One step of a body in reconfigured inertial frames: as published, and corrected."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from acausal import DeclarationError, as_expr, cross
from components.fe.arrays import Array
from components.fe.reconfigured.free_modes import FreeModes
from components.fe.reduction.node_frames import ON_A_LINE
from components.rotation_vector import attitude, rate

STAGES = (0.0, 0.5, 0.5, 1.0)
WEIGHTS = (1 / 6, 1 / 3, 1 / 3, 1 / 6)
READINGS = {
    "rotation": ("accumulated", "restarted"),
    "rigid_part": ("kept", "zeroed"),
    "increments": ("summed", "mapped"),
    "force": ("stage", "step"),
    "middle": ("mean", "middle"),
}


@dataclass(frozen=True)
class Readings:
    """Choices that the paper leaves open; the defaults follow its text.

    Parameters
    ----------
    rotation : str
        "accumulated": the rotation vector of (38) is integrated over all steps, so that (22) is singular at each full
        turn, near which a run can jump; "restarted": it starts at 0 in each step.
    rigid_part : str
        Rigid part q_R of the deformation, of which (40) removes the increments only: "kept", although rotations of the
        frame excite it again; "zeroed" in each step.
    increments : str
        "summed": (39) adds increments resolved in four frames, which reduces the order to 1; "mapped": they are first
        rotated back to the frame at the start of the step. That changes the error constant; the order stays near 1.
    force : str
        Attitude that resolves world forces in the body: of the "stage", or of the start of the "step". It changes the
        error constant, not the order.
    middle : str
        Load of the two middle stages: the "mean" of the ends of the step, or the value in its "middle".
    points : two vectors
        Directions from the reference point R to P and Q. In the stages of a step, their relative velocities are not
        those of a rigid motion, so that the angular velocity of (5) to (8) depends on these directions.
    """

    rotation: str = "accumulated"
    rigid_part: str = "kept"
    increments: str = "summed"
    force: str = "stage"
    middle: str = "mean"
    points: tuple[Sequence[float], Sequence[float]] = ((1, 0, 0), (0, 1, 0))

    def __post_init__(self) -> None:
        for name, choices in READINGS.items():
            if getattr(self, name) not in choices:
                known = " or ".join(map(repr, choices))
                raise DeclarationError(f"the reading `{name}` must be {known}, not {getattr(self, name)!r}")
        try:
            p, q = (np.asarray(point, dtype=float).reshape(3) for point in self.points)
        except (TypeError, ValueError):
            raise DeclarationError(
                f"the reading `points` must be two directions, such as ((1, 0, 0), (0, 1, 0)), not {self.points!r}"
            ) from None
        if np.linalg.norm(np.cross(p, q)) <= ON_A_LINE * np.linalg.norm(p) * np.linalg.norm(q):
            raise DeclarationError(
                f"P, Q and R are collinear: the directions {self.points!r} do not determine the angular velocity"
            )


@dataclass(frozen=True)
class State:
    """State at the start of a step.

    Attributes
    ----------
    O : Expr, shape (3,)
        Position of the origin of the frame in m, resolved in the world.
    A : Expr, shape (3, 3)
        Rotation matrix from world to frame components.
    m : Expr, shape (3,)
        Accumulated rotation vector in rad.
    q, v : Expr, shape (N,)
        Modal coordinates of all modes and their rates in the inertial frame, resolved in the frame.
    """

    O: Any
    A: Any
    m: Any
    q: Any
    v: Any

    @classmethod
    def of(cls, x: Any) -> State:
        """Split a state vector."""
        N = (len(x) - 15) // 2
        A = as_expr([[x[3 + 3 * i + j] for j in range(3)] for i in range(3)])
        return cls(x[:3], A, x[12:15], x[15 : 15 + N], x[15 + N :])

    @property
    def vector(self) -> Any:
        """State vector."""
        return as_expr([*self.O, *(a for row in self.A for a in row), *self.m, *self.q, *self.v])


@dataclass(frozen=True, eq=False)
class Loads:
    """Loads at the start, in the middle and at the end of a step.

    Attributes
    ----------
    world, follower : array, shape (N, 3 k)
        Modal accelerations by components of loads resolved in the world and in the body.
    inputs : Expr, shape (3 (3 + 3 k + 3 l),)
        For each instant: gravity resolved in the world, loads in the world, loads in the body.
    """

    world: Array
    follower: Array
    inputs: Any

    def at(self, part: float, A: Any) -> Any:
        """Return the modal accelerations at the fraction `part` of the step, for a frame of attitude A, shape (N,)."""
        k, l = self.world.shape[1], self.follower.shape[1]
        size = 3 + k + l
        u = self.inputs[int(2 * part) * size : (int(2 * part) + 1) * size]
        found = _extended(A @ u[:3], len(self.world))
        if k:
            turned = [a for i in range(0, k, 3) for a in A @ u[3 + i : 6 + i]]
            found += as_expr(self.world) @ as_expr(turned)
        return found + as_expr(self.follower) @ u[3 + k :] if l else found


def corrected(body: FreeModes, loads: Loads, state: State, dt: float) -> tuple[Any, Any]:
    """Take a classical Runge-Kutta step of the equations of motion in one frame.

    v' = M_q^-1 (Psi' f - K_q q - C_q v) - M_q^-1 Psi' M (w~) Psi v, q' = v - M_q^-1 Psi' M (w~) Psi q with q_R = 0, and
    the rotation vector starts at 0 in each step. The rows of rotation are Euler's equations.

    Returns
    -------
    state, rates : Expr
        State after the step, and v' at its start.
    """
    start = (state.O, as_expr(np.zeros(3)), state.q[6:], state.v)
    sums: list[Any] = list(start)
    slopes: Any = None
    first = None
    for part, weight in zip(STAGES, WEIGHTS, strict=True):
        O, m, q, v = start if slopes is None else (x + part * dt * d for x, d in zip(start, slopes, strict=True))
        A = attitude(m) @ state.A if part else state.A
        whole, w = as_expr([*np.zeros(6), *q]), v[3:6]
        dv = loads.at(part, A) + _flexible(body.restored(q, v[6:])) - body.crossed(w, v)
        slopes = (A.T @ v[:3], rate(m, w) if part else w, v[6:] - body.crossed(w, whole)[6:], dv)
        first = dv if first is None else first
        sums = [x + weight * dt * d for x, d in zip(sums, slopes, strict=True)]
    O, m, q, v = sums
    return State(O, attitude(m) @ state.A, state.m, as_expr([*np.zeros(6), *q]), v).vector, first


def printed(body: FreeModes, loads: Loads, state: State, dt: float, readings: Readings) -> tuple[Any, Any]:
    """Take a step of equations (36) to (40) of the paper, with increments resolved in the frames of four stages.

    Returns
    -------
    state, rates : Expr
        State after the step; modal accelerations (32) and the angular acceleration (37) at its start.
    """
    goes_on = readings.rotation == "accumulated"
    base = state.m if goes_on else as_expr(np.zeros(3))
    relative = Relative(*readings.points)
    start = (state.q, state.v, *relative.of_turn(state.v[3:6]), base)
    sums: list[Any] = [0 * x for x in start]
    steps: Any = None
    first = None
    for part, weight in zip(STAGES, WEIGHTS, strict=True):
        dq, dv, dP, dQ, dm = (0 * x if steps is None else part * d for x, d in zip(start, steps or start, strict=True))
        P, Q, m = start[2] + dP, start[3] + dQ, base + dm
        A = state.A if not part else attitude(m) if goes_on else attitude(m) @ state.A
        R = A @ state.A.T
        q, v = _turned(body, R, state.q + _flexible(dq[6:]), state.v + dv) if part else start[:2]
        w = relative.velocity(P, Q)
        a = loads.at(part, A if readings.force == "stage" else state.A) + _flexible(body.restored(q[6:], v[6:]))
        aP, aQ = relative.of_turn(a[3:6])
        first = (a, relative.acceleration(P, Q, aP, aQ, w)) if first is None else first
        back = _turned(body, R.T, v, a) if part and readings.increments == "mapped" else (v, a)
        slopes = (*back, aP - cross(w, P), aQ - cross(w, Q), rate(m, w))
        steps = [dt * d for d in slopes]
        sums = [x + weight * d for x, d in zip(sums, steps, strict=True)]
    A = attitude(base + sums[4]) if goes_on else attitude(sums[4]) @ state.A
    q, v = _turned(body, A @ state.A.T, state.q + _flexible(sums[0][6:]), state.v + sums[1])
    q = q if readings.rigid_part == "kept" else _flexible(q[6:])
    moved = State(state.O + state.A.T @ sums[0][:3], A, base + sums[4] if goes_on else state.m, q, v)
    return moved.vector, as_expr([*first[0], *first[1]]) if first else None


@dataclass(frozen=True)
class Relative:
    """Angular velocity and acceleration from the relative motion of three points: (5) to (14).

    Parameters
    ----------
    p, q : sequence of 3 floats
        Directions from R to P and Q; the distances cancel.
    """

    p: Sequence[float]
    q: Sequence[float]

    @property
    def axes(self) -> tuple[Array, Array, Array, float]:
        """e1, e2, e3, and the length of e1 x e2."""
        e1, e2 = (np.asarray(d, dtype=float) / np.linalg.norm(d) for d in (self.p, self.q))
        normal = np.cross(e1, e2)
        return e1, e2, normal / np.linalg.norm(normal), float(np.linalg.norm(normal))

    def of_turn(self, w: Any) -> tuple[Any, Any]:
        """Return the velocities of P and Q relative to R in a rotation, at distance 1."""
        e1, e2, _, _ = self.axes
        return cross(w, e1), cross(w, e2)

    def velocity(self, P: Any, Q: Any) -> Any:
        """Return the angular velocity of (5) to (8)."""
        e1, e2, e3, size = self.axes
        third = P @ (e2 - (e1 @ e2) * e1) / size
        return Q @ e3 / size * e1 - P @ e3 / size * e2 + third * e3

    def acceleration(self, P: Any, Q: Any, aP: Any, aQ: Any, w: Any) -> Any:
        """Return the angular acceleration of (10) to (13), with (e3 x (w x P) - e3 x aP) . e1 in (10)."""
        e1, e2, e3, size = self.axes
        third = (cross(e3, cross(w, P)) - cross(e3, aP)) @ e1
        second = (cross(w, P) - aP) @ e3 / size
        return (aQ - cross(w, Q)) @ e3 / size * e1 + second * e2 + third * e3


def _turned(body: FreeModes, R: Any, q: Any, v: Any) -> tuple[Any, Any]:
    return body.turned(R, q), body.turned(R, v)


def _flexible(a: Any) -> Any:
    """Prepend a rigid part of 0."""
    return as_expr([*np.zeros(6), *a])


def _extended(a: Any, size: int) -> Any:
    return as_expr([*a, *np.zeros(size - 3)])
