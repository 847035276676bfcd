"""Flexible motion of a free body by single steps in inertial frames that follow its embedded rigid motion."""

from __future__ import annotations

import warnings
from collections.abc import Callable, Sequence
from functools import partial
from typing import Any

import numpy as np

from acausal import AcausalWarning, DeclarationError, March, SimulationError, march
from components.fe.arrays import Array
from components.fe.frame_checks import check_free, check_step, limit, steps_of, too_fast
from components.fe.frame_load import FrameLoad, check_loads, sampled
from components.fe.frame_motion import FrameMotion
from components.fe.frame_steps import Loads, Readings, State, corrected, printed
from components.fe.free_modes import FreeModes
from components.fe.reduced_body import ReducedBody

Vector = Sequence[float] | Array
VARIANTS = ("corrected", "paper")
# Of the size of a body: where the deflections of a run that diverges end it, long before they overflow.
FAR = 1e3
# Of a step: how far inside of it its ends are looked at, far above rounding of the time after 1e5 steps, far below any error.
EDGE = 1e-9


def simulate_reconfigured(
    body: ReducedBody,
    loads: Sequence[FrameLoad] = (),
    stop_time: float = 1.0,
    dt: float = 1e-4,
    *,
    variant: str = "corrected",
    readings: Readings | None = None,
    damping: Any = 0.0,
    gravity: Vector | None = None,
    position: Vector = (0.0, 0.0, 0.0),
    attitude: Any = None,
    velocity: Vector = (0.0, 0.0, 0.0),
    spin: Vector = (0.0, 0.0, 0.0),
    q: Any = 0.0,
    qd: Any = 0.0,
    progress: Callable[[float, int], None] | None = None,
) -> FrameMotion:
    """Move a free flexible body by steps in a sequence of inertial frames.

    Parameters
    ----------
    body : ReducedBody
        With mean axes: `reduce_body(..., hold="mean-axis")`.
    loads : sequence of FrameLoad
        Forces and moments at its frames, with the levers of the undeformed body.
    stop_time : float
        In s, a multiple of `dt`.
    dt : float
        Step in s.
    variant : str
        "corrected": one frame in each step, order 4; "paper": as printed, order 1, with a wrong angular acceleration in
        spatial motion.
    readings : Readings
        What the text leaves open, of the variant "paper" only.
    damping : float or array_like, shape (n,)
        Part of critical damping of each mode, beside the damping of the body.
    gravity : 3 floats, optional
        Acceleration of gravity in m/s2, resolved in the world.
    position, velocity : 3 floats
        Of the centre of mass at the start, in m and m/s, resolved in the world.
    attitude : array_like, shape (3, 3), optional
        Matrix that turns world components into those of the body at the start; the unit matrix if not given.
    spin : 3 floats
        Angular velocity at the start in rad/s, resolved in the body.
    q, qd : float or array_like, shape (n,)
        Amplitudes of the flexible modes at the start in m, and their rates in m/s as seen in the moving frame.
    progress : callable, optional
        Told the part of the run that is done, and the steps.

    Returns
    -------
    FrameMotion
        Motion at the start and after each step.

    Raises
    ------
    DeclarationError
        If the body is not free, a frame is unknown, the step is beyond the limit of stability, or the stop time is no
        multiple of it.
    SimulationError
        If the motion diverges; `result` holds what was computed.
    KeyboardInterrupt
        With what was computed as its attribute `result`.

    Warns
    -----
    AcausalWarning
        If the body turns faster than half of its first frequency.

    Notes
    -----
    As dt -> 0 the corrected variant is an ordinary differential equation, and not that of a floating frame: levers are
    those of the undeformed body, and w x u counts only as far as the modes hold it. Without load the difference grows with
    the cube of the spin. Neither has geometric stiffening.
    """
    check_free(body)
    check_loads(body, loads)
    if variant not in VARIANTS:
        raise DeclarationError(f"variant is one of {', '.join(map(repr, VARIANTS))}, not {variant!r}")
    if readings is not None and variant != "paper":
        raise DeclarationError('readings are of variant="paper": the corrected one leaves nothing open')
    read = readings or Readings()
    modes = FreeModes(body, _damping(damping, body.n))
    count = steps_of(stop_time, dt)
    check_step(modes, stop_time, dt)
    A = np.eye(3) if attitude is None else _rotation(attitude)
    O, v, w = (_vector(x, name) for x, name in ((position, "position"), (velocity, "velocity"), (spin, "spin")))
    start = _start(modes, A, O, v, w, _amplitudes(q, body.n), _amplitudes(qd, body.n))
    # A step more than there are: the last one tells the accelerations at the stop time, its end is not looked at.
    maps, inputs = _inputs(modes, loads, gravity, dt, count, read.middle if variant == "paper" else "middle")
    times = dt * np.arange(count + 1)
    take = partial(corrected, dt=dt) if variant == "corrected" else partial(printed, dt=dt, readings=read)

    def motion(found: March) -> FrameMotion:
        done = len(found.outputs)
        return FrameMotion(modes, times[:done], found.states[:done], found.outputs, variant, found)

    try:
        found = march(
            lambda x, u: take(modes, Loads(*maps, u), State.of(x)),
            start,
            inputs,
            bounds=_bounds(modes),
            progress=progress,
        )
    except KeyboardInterrupt as interrupt:
        if hasattr(interrupt, "result"):
            interrupt.result = motion(interrupt.result)  # type: ignore[attr-defined]
        raise
    if found.diverged:
        raise SimulationError(_diverged(modes, motion(found), dt), motion(found))
    run = motion(found)
    if doubt := too_fast(modes, run.w):
        warnings.warn(doubt, AcausalWarning, stacklevel=2)
    return run


def _amplitudes(values: Any, n: int) -> Array:
    try:
        found = np.broadcast_to(np.asarray(values, dtype=float), (n,))
    except (TypeError, ValueError):
        found = np.full(1, np.nan)
    if not np.isfinite(found).all():
        raise DeclarationError(f"amplitudes and rates of {n} modes are one number or {n}, not {values!r}")
    return found


def _damping(values: Any, n: int) -> Array:
    found = _amplitudes(values, n)
    if (found < 0).any():
        raise DeclarationError(f"the damping of a mode is not negative, as it is in {values!r}")
    return found


def _rotation(values: Any) -> Array:
    A = np.array(values, dtype=float)
    if A.shape != (3, 3) or np.abs(A @ A.T - np.eye(3)).max() > 1e-9 or np.linalg.det(A) < 0:
        raise DeclarationError("the attitude at the start is a rotation matrix, shape (3, 3)")
    return A


def _vector(values: Any, what: str) -> Array:
    return sampled(values, np.zeros(1), f"the {what} at the start")[0]


def _start(modes: FreeModes, A: Array, O: Array, velocity: Array, w: Array, q: Array, qd: Array) -> Array:
    """State at the start: rates of the modes in an inertial frame are those in the moving one, and w x u."""
    from scipy.spatial.transform import Rotation

    carried = np.einsum("k,kab,b->a", w, modes.turning, np.concatenate([np.zeros(6), q]))
    turn = Rotation.from_matrix(A.T).as_rotvec()
    return np.concatenate([O, A.ravel(), turn, np.zeros(6), q, A @ velocity, w, qd + carried[6:]])


def _inputs(
    modes: FreeModes, loads: Sequence[FrameLoad], gravity: Any, dt: float, count: int, middle: str
) -> tuple[tuple[Array, Array], Array]:
    """Accelerations of the modes by unit loads, in the world and following, and what acts in each step."""
    # Limits from inside of each step: a load may jump between two steps. The last step is given the load of its start.
    edge, starts = EDGE * dt, dt * np.arange(count + 1)
    ends = starts[:-1] + dt
    times = np.concatenate([starts + edge, starts[:-1] + dt / 2, ends - edge])
    times[count] = starts[-1]
    frames = {frame.name: frame for frame in modes.body.interfaces}
    maps: dict[bool, list[Array]] = {False: [np.zeros((modes.size, 0))], True: [np.zeros((modes.size, 0))]}
    found: dict[bool, list[Array]] = {False: [np.zeros((len(times), 0))], True: [np.zeros((len(times), 0))]}
    for load in loads:
        by_force, by_moment = modes.load(frames[load.frame])
        for course, unit in ((load.force, by_force), (load.moment, by_moment)):
            if callable(course) or np.any(course):
                what = f"{'force' if unit is by_force else 'moment'} at `{load.frame}`"
                maps[load.follower].append(unit)
                found[load.follower].append(sampled(course, times, what))
    weight = sampled((0.0, 0.0, 0.0) if gravity is None else gravity, times, "gravity")
    values = np.hstack([weight, *found[False], *found[True]])
    first, between, last = np.split(values, [count + 1, 2 * count + 1])
    between, last = (np.vstack([part, first[-1:]]) for part in (between, last))
    if middle == "mean":
        between = (first + last) / 2
    return (np.hstack(maps[False]), np.hstack(maps[True])), np.hstack([first, between, last])


def _bounds(modes: FreeModes) -> Array:
    body, N = modes.body, modes.size
    bounds = np.full(15 + 2 * N, np.inf)
    if body.n:
        bounds[21 : 15 + N] = FAR * np.sqrt(np.trace(body.second_moment) / np.diag(body.M))
    return bounds


def _diverged(modes: FreeModes, motion: FrameMotion, dt: float) -> str:
    most, fastest = limit(modes)
    step = len(motion.time) + 1
    doubt = too_fast(modes, motion.w)
    mend = f"{doubt[0].upper()}{doubt[1:]}." if doubt else "Take shorter steps."
    return (
        f"the motion diverges in step {step}, at t = {step * dt:.6g} s, with dt * omega_max = {dt * fastest:.4g}, where the "
        f"limit of a body that does not turn is {most * fastest:.4g}. {mend}"
    )
