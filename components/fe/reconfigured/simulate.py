"""Flexible motion of a free body by single steps in inertial frames that follow its embedded rigid motion."""

from __future__ import annotations

import warnings
from collections.abc import Callable, Sequence
from typing import Any

import numpy as np

from acausal import AcausalWarning, DeclarationError
from components.fe.arrays import Array
from components.fe.body.free_body import check_free
from components.fe.reconfigured.adaptive_step import controlled
from components.fe.reconfigured.fixed_step import fixed
from components.fe.reconfigured.free_modes import FreeModes
from components.fe.reconfigured.load import FrameLoad, breaks_of, check_breaks, sampled
from components.fe.reconfigured.motion import FrameMotion
from components.fe.reconfigured.step_inputs import Inputs
from components.fe.reconfigured.step_limits import positive, steps_of, too_fast
from components.fe.reconfigured.steps import Readings
from components.fe.reduction.reduced_body import ReducedBody

Vector = Sequence[float] | Array
VARIANTS = ("corrected", "paper")
DT = 1e-4
# Tolerances: what is a thousand times rounding in each step, and what is still a motion.
FINEST, COARSEST = 1e-10, 0.1


def simulate_reconfigured(
    body: ReducedBody,
    loads: Sequence[FrameLoad] = (),
    stop_time: float = 1.0,
    dt: float | None = None,
    *,
    tolerance: float | None = None,
    intervals: int | None = None,
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
        Forces and moments at its frames, or forces at nodes, with the levers of the undeformed body.
    stop_time : float
        In s, a multiple of `dt`.
    dt : float
        Step in s, 1e-4 s where neither it nor a tolerance is given.
    tolerance : float, optional
        Error that controls the size of the steps of the variant "corrected", in place of `dt`, from 1e-10 to 0.1: what the
        errors of all steps come to together, as a part of the largest speed of the points of the body (root mean square
        over its mass, translation apart). Steps end where loads break, see `FrameLoad.breaks`.
    intervals : int, optional
        With a tolerance: number of equal intervals of time, at whose ends the motion is kept, instead of after each step.
    variant : str
        "corrected": one frame in each step, order 4; "paper": as printed, order 1, with a wrong angular acceleration in
        spatial motion.
    readings : Readings
        What the text leaves open, of the variant "paper" only.
    damping : float or array_like, shape (n,)
        Part of critical damping of each mode, beside the damping of the body.
    gravity : 3 floats or callable, optional
        Acceleration of gravity in m/s2, resolved in the world, or a function of the time in s that returns it.
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
        Motion at the start and after each step, or at the ends of intervals.

    Raises
    ------
    DeclarationError
        If the body is not free, a frame or node is unknown, the step is beyond the limit of stability, or the stop time is
        no multiple of it.
    SimulationError
        If the motion diverges, or has too many steps; `result` holds what was computed.
    KeyboardInterrupt
        With what was computed as its attribute `result`.

    Warns
    -----
    AcausalWarning
        If the body turns faster than half of its first frequency, or a load breaks inside of a step of one size.

    Notes
    -----
    As dt -> 0 the corrected variant is an ordinary differential equation, and not that of a floating frame: levers are
    those of the undeformed body, and w x u counts only as far as the modes hold it. Without load the difference grows with
    the cube of the spin. Neither has geometric stiffening.
    """
    check_free(body)
    if variant not in VARIANTS:
        raise DeclarationError(f"variant is one of {', '.join(map(repr, VARIANTS))}, not {variant!r}")
    read = _readings(variant, readings, tolerance)
    modes = FreeModes(body, _damping(damping, body.n))
    inputs = Inputs.of(modes, loads, gravity)
    A = np.eye(3) if attitude is None else _rotation(attitude)
    O, v, w = (_vector(x, name) for x, name in ((position, "position"), (velocity, "velocity"), (spin, "spin")))
    start = _start(modes, A, O, v, w, _amplitudes(q, body.n), _amplitudes(qd, body.n))
    if tolerance is None:
        dt = DT if dt is None else dt
        if intervals is not None:
            raise DeclarationError("intervals= is for steps of controlled size, tolerance=: others are kept each")
        count = steps_of(modes, stop_time, dt)
        check_breaks(loads, float(stop_time), float(dt))
        run = fixed(modes, inputs, start, float(dt), count, read, progress)
    else:
        if dt is not None:
            raise DeclarationError("tolerance= controls the size of the steps, in place of dt=: give one of them")
        breaks = breaks_of(loads, positive(stop_time, "the stop time", "s"))
        times = _times(breaks[-1], intervals)
        run = controlled(modes, inputs, start, breaks, times, _tolerance(tolerance), progress)
    if doubt := too_fast(modes, run.w):
        warnings.warn(doubt, AcausalWarning, stacklevel=2)
    return run


def _readings(variant: str, readings: Any, tolerance: Any) -> Readings | None:
    """Those of the variant "paper", None for the corrected one."""
    if variant == "corrected":
        if readings is not None:
            raise DeclarationError('readings are of variant="paper": the corrected one leaves nothing open')
        return None
    if tolerance is not None:
        raise DeclarationError(
            'tolerance= is of variant="corrected": as printed, steps are of one size, dt=, and of order 1'
        )
    if not isinstance(readings, Readings | None):
        raise DeclarationError(f'readings are Readings(rotation="restarted", ...), not {readings!r}')
    return readings or Readings()


def _times(stop_time: float, intervals: Any) -> Array:
    if intervals is None:
        return np.empty(0)
    if isinstance(intervals, bool) or not isinstance(intervals, int | np.integer) or intervals < 1:
        raise DeclarationError(f"intervals is a whole number from 1 on, not {intervals!r}")
    return np.linspace(0.0, stop_time, int(intervals) + 1)


def _tolerance(value: Any) -> float:
    found = positive(value, "the tolerance", "")
    if not FINEST <= found <= COARSEST:
        raise DeclarationError(f"the tolerance is a number from {FINEST:g} to {COARSEST:g}, not {value!r}")
    return found


def _amplitudes(values: Any, n: int, what: str = "amplitudes and rates") -> Array:
    try:
        found = np.broadcast_to(np.asarray(values, dtype=float), (n,))
    except (TypeError, ValueError):
        found = np.full(1, np.nan)
    if not np.isfinite(found).all():
        raise DeclarationError(f"{what} of {n} modes are one number or {n}, not {values!r}")
    return found


def _damping(values: Any, n: int) -> Array:
    found = _amplitudes(values, n, "damping ratios")
    if (found < 0).any():
        raise DeclarationError(f"the damping of a mode is not negative, as it is in {values!r}")
    return found


def _rotation(values: Any) -> Array:
    try:
        A = np.array(values, dtype=float)
    except (TypeError, ValueError):
        A = np.zeros(0)
    if (
        A.shape != (3, 3)
        or not np.isfinite(A).all()
        or np.abs(A @ A.T - np.eye(3)).max() > 1e-9
        or np.linalg.det(A) < 0
    ):
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
