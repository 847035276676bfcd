"""Conversion of a motion in reconfigured frames to a `Result` with the variable names of an `FEBody`."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np

from acausal import CompiledModel, Component, DeclarationError, Result, result_of
from components.fe.arrays import Array
from components.fe.reconfigured.motion import FrameMotion
from components.fe.reconfigured.step_limits import WHOLE, too_fast
from components.fe.reconfigured.steps import STAGES
from components.fe.reduction.interface import Interface

Named = dict[str, tuple[Any, str]]
UNITS = {"r_0": "m", "R.T": "1", "R.w": "rad/s", "v": "m/s", "a": "m/s2", "z": "rad/s2", "Q": "1"}


def as_result(
    motion: FrameMotion,
    name: str = "body",
    *,
    model: Component | CompiledModel | None = None,
    times: Sequence[float] | Array | None = None,
) -> Result:
    """Convert a motion to a `Result`.

    Parameters
    ----------
    motion : FrameMotion
        Result of `simulate_reconfigured`.
    name : str
        Name of the body, or its path in the model.
    model : Component or CompiledModel, optional
        Scene in which nothing else moves. The result then has all its variables and its outputs. Accelerations are
        those of the variant; forces are those of the scene.
    times : array_like, shape (n,), optional
        Times in s of the result, which must be ends of steps; by default all.

    Returns
    -------
    Result
        Variables with prefix `name`: q, qd, qdd; r_0, v_0, a_0, w_a, z_a of the reference frame; r_0, R.T, R.w, v, a, z
        of `ref` and of each frame; and the embedded rigid motion `name.embedded.FRAME.r_0`, `v_0` and `a_0`, resolved
        in the world. Accelerations are those of the variant.

    Raises
    ------
    DeclarationError
        If an argument is invalid, a time is not the end of a step, or the model has another body of this name.
    """
    if not isinstance(motion, FrameMotion):
        raise DeclarationError(f"as_result() needs the result of simulate_reconfigured(), not {motion!r}")
    values = _modes(motion) | _reference(motion)
    for interface in motion.modes.body.interfaces:
        own = _frame(motion, interface)
        if model is not None and not interface.rotation.any():
            # In a scene, such a frame rotates with the reference frame, without the rigid part of the printed
            # deformation.
            own = {key: value for key, value in own.items() if key not in ("R.T", "R.w", "z")}
        values |= {f"{interface.name}.{key}": value for key, value in own.items()}
        rigid = _embedded(motion, interface)
        values |= {f"embedded.{interface.name}.{key}": value for key, value in rigid.items()}
    rows = _rows(motion, times)
    return result_of(
        motion.time[rows],
        {f"{name}.{key}": (array[rows], unit) for key, (array, unit) in values.items()},
        () if model else [f"{name}.r_0", f"{name}.w_a"],
        model=model,
        title=f"{name}, reconfigured inertial frames, {motion.variant}",
        equations_reduced=motion.states.shape[1],
        states=motion.states.shape[1],
        algebraic=0,
        steps=motion.steps,
        tolerance=motion.tolerance,
        break_times=list(motion.breaks),
        # Step size control takes each pair of steps again as one step.
        residual_evaluations=len(STAGES) * (motion.steps + motion.rejected) * (3 if motion.tolerance else 2) // 2,
        operations=motion.march.operations,
        compile_seconds=motion.march.building,
        solve_seconds=motion.march.seconds,
        integration_seconds=motion.march.seconds,
        doubts=[doubt] if (doubt := too_fast(motion.modes, motion.w)) else [],
        method="RK4",
        method_reason=_reason(motion),
    )


def _rows(motion: FrameMotion, times: Any) -> Any:
    """Return the rows of times among the ends of steps."""
    if times is None:
        return slice(None)
    wanted = np.asarray(times, dtype=float).reshape(-1)
    places = np.clip(np.searchsorted(motion.time, wanted), 1, len(motion.time) - 1)
    places -= wanted - motion.time[places - 1] < motion.time[places] - wanted
    off = np.abs(motion.time[places] - wanted) > WHOLE * np.diff(motion.time).min()
    if off.any():
        raise DeclarationError(
            f"no step ends at t = {wanted[off][0]:.6g} s; use steps that divide the intervals between the times"
        )
    return places


def _reason(motion: FrameMotion) -> str:
    if not motion.tolerance:
        return "fixed steps were requested"
    return f"tolerance {motion.tolerance:g}: {motion.steps} steps accepted, {motion.rejected} rejected"


def _modes(motion: FrameMotion) -> Named:
    return {"q": (motion.q, "m"), "qd": (motion.qd, "m/s"), "qdd": (motion.qdd, "m/s2")}


def _reference(motion: FrameMotion) -> Named:
    """Return the reference frame; with mean axes its origin is the centre of mass of the undeformed body."""
    T, w, v, a = motion.T, motion.w, motion.rates[:, :3], motion.a
    local = {"r_0": motion.r_0, "R.T": T, "R.w": w, "v": v, "a": a, "z": motion.al, "Q": _quaternions(T)}
    found: Named = {f"ref.{key}": (value, UNITS[key]) for key, value in local.items()}
    v_0, a_0 = (np.einsum("tij,ti->tj", T, x) for x in (v, a))
    whole = {"r_0": (motion.r_0, "m"), "v_0": (v_0, "m/s"), "a_0": (a_0, "m/s2")}
    return found | whole | {"w_a": (w, "rad/s"), "z_a": (motion.al, "rad/s2")}


def _frame(motion: FrameMotion, interface: Interface) -> Named:
    """Return a frame, rotated relative to the reference frame by `rodrigues_rotation` of its rotation vector."""
    Psi = interface.rotation
    p, pd, pdd = (x @ Psi.T / 2 for x in (motion.q, motion.qd, motion.qdd))
    p = p + motion.amplitudes[:, 3:6] / 2
    square, E = (p * p).sum(axis=1)[:, None, None], np.eye(3)
    turned = (2 * (p[:, :, None] * p[:, None, :] - _skew(p)) + (1 - square) * E) / (1 + square)
    G = (E - _skew(p)) / (1 + square)
    w_rel = _apply(G, 2 * pd)
    slowing = 2 * (p * pd).sum(axis=1)[:, None] / (1 + square[:, :, 0])
    z_rel = _apply(G, 2 * pdd) - slowing * w_rel
    w_ref = _apply(turned, motion.w)
    T, A = interface.axes @ turned @ motion.T, np.broadcast_to(interface.axes, turned.shape)
    found = {
        "r_0": motion.place(interface.name),
        "R.T": T,
        "R.w": _apply(A, w_ref + w_rel),
        "v": _apply(T, motion.velocity(interface.name)),
        "a": _apply(T, motion.acceleration(interface.name)),
        "z": _apply(A, _apply(turned, motion.al) - np.cross(w_rel, w_ref) + z_rel),
    }
    return {key: (value, UNITS[key]) for key, value in found.items()}


def _embedded(motion: FrameMotion, interface: Interface) -> Named:
    """Return the motion of the same point in the embedded rigid body."""
    T, X, name = motion.T, interface.place, interface.name
    v = motion.rates[:, :3] + np.cross(motion.w, X)
    place, velocity = (np.einsum("tij,ti->tj", T, x) for x in (np.broadcast_to(X, v.shape), v))
    a = motion.acceleration(name, embedded=True)
    return {"r_0": (motion.r_0 + place, "m"), "v_0": (velocity, "m/s"), "a_0": (a, "m/s2")}


def _apply(T: Array, v: Array) -> Array:
    return np.einsum("tij,tj->ti", T, v)


def _skew(v: Array) -> Array:
    """Return the matrices of v x, with columns v x e_k."""
    return np.cross(v[:, None, :], np.eye(3)).transpose(0, 2, 1)


def _quaternions(T: Array) -> Array:
    """Return the quaternions of attitudes, with continuous signs."""
    from scipy.spatial.transform import Rotation

    found = Rotation.from_matrix(T.transpose(0, 2, 1)).as_quat()
    turned = (found[1:] * found[:-1]).sum(axis=1) < 0
    return found * np.where(np.concatenate([[0], np.cumsum(turned)]) % 2, -1, 1)[:, None]
