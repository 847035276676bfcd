"""Motion of a free flexible body by single steps in inertial frames that follow its embedded rigid motion."""

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
# Range of tolerances: a thousand times the round-off of a step, up to the coarsest useful motion.
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
    """Simulate a free flexible body by steps in a sequence of inertial frames.

    Parameters
    ----------
    body : ReducedBody
        Body with mean axes: `reduce_body(..., hold="mean-axis")`.
    loads : sequence of FrameLoad
        Forces and moments at frames, or forces at nodes, with the levers of the undeformed body.
    stop_time : float
        Stop time in s, a multiple of `dt`.
    dt : float
        Step in s; 1e-4 s by default.
    tolerance : float, optional
        Enables step size control for the variant "corrected", instead of `dt`. From 1e-10 to 0.1: limit of the sum of
        all errors, relative to the largest speed of the points of the body (root mean square over its mass, translation
        separately). Steps end at the breaks of loads, see `FrameLoad.breaks`.
    intervals : int, optional
        With a tolerance: number of equal output intervals, instead of output after each step.
    variant : str
        "corrected": one frame in each step, order 4; "paper": as published, order 1, with a wrong angular acceleration
        in spatial motion.
    readings : Readings
        Choices that the paper leaves open, for the variant "paper".
    damping : float or array_like, shape (n,)
        Damping ratio of each mode, added to the damping of the body.
    gravity : 3 floats or callable, optional
        Acceleration of gravity in m/s2, resolved in the world, or a function of the time in s that returns it.
    position, velocity : 3 floats
        Position and velocity of the centre of mass at the start in m and m/s, resolved in the world.
    attitude : array_like, shape (3, 3), optional
        Rotation matrix from world to body components at the start; by default the unit matrix.
    spin : 3 floats
        Angular velocity at the start in rad/s, resolved in the body.
    q, qd : float or array_like, shape (n,)
        Modal coordinates at the start in m, and their rates relative to the moving frame in m/s.
    progress : callable, optional
        Called with the completed fraction of the run and the number of steps.

    Returns
    -------
    FrameMotion
        Motion at the start and after each step, or at the ends of the intervals.

    Raises
    ------
    DeclarationError
        If the body is not free, a frame or node is unknown, the step exceeds the stability limit, or the stop time is
        not a multiple of it.
    SimulationError
        If the motion diverges or has too many steps; `result` holds the motion until then.
    KeyboardInterrupt
        With the motion until then as attribute `result`.

    Warns
    -----
    AcausalWarning
        If the body rotates faster than half of its first frequency, or a break of a load is inside a fixed step.

    Notes
    -----
    For dt -> 0, the corrected variant is an ordinary differential equation that differs from that of a floating frame:
    levers are those of the undeformed body, and w x u is projected on the modes. Without load, the difference grows
    with the cube of the angular velocity. Neither has geometric stiffening.
    """
    check_free(body)
    if variant not in VARIANTS:
        raise DeclarationError(f"variant must be one of {', '.join(map(repr, VARIANTS))}, not {variant!r}")
    read = _readings(variant, readings, tolerance)
    modes = FreeModes(body, _damping(damping, body.n))
    inputs = Inputs.of(modes, loads, gravity)
    A = np.eye(3) if attitude is None else _rotation(attitude)
    O, v, w = (_vector(x, name) for x, name in ((position, "position"), (velocity, "velocity"), (spin, "spin")))
    start = _start(modes, A, O, v, w, _amplitudes(q, body.n), _amplitudes(qd, body.n))
    if tolerance is None:
        dt = DT if dt is None else dt
        if intervals is not None:
            raise DeclarationError("intervals= needs adaptive steps, tolerance=; fixed steps are all kept")
        count = steps_of(modes, stop_time, dt)
        check_breaks(loads, float(stop_time), float(dt))
        run = fixed(modes, inputs, start, float(dt), count, read, progress)
    else:
        if dt is not None:
            raise DeclarationError("tolerance= and dt= exclude each other; pass one of them")
        breaks = breaks_of(loads, positive(stop_time, "the stop time", "s"))
        times = _times(breaks[-1], intervals)
        run = controlled(modes, inputs, start, breaks, times, _tolerance(tolerance), progress)
    if doubt := too_fast(modes, run.w):
        warnings.warn(doubt, AcausalWarning, stacklevel=2)
    return run


def _readings(variant: str, readings: Any, tolerance: Any) -> Readings | None:
    """Return the readings of the variant "paper", or None for the corrected variant."""
    if variant == "corrected":
        if readings is not None:
            raise DeclarationError('readings= applies to variant="paper" only')
        return None
    if tolerance is not None:
        raise DeclarationError('tolerance= applies to variant="corrected" only; variant="paper" has fixed steps, dt=')
    if not isinstance(readings, Readings | None):
        raise DeclarationError(f'readings must be Readings(rotation="restarted", ...), not {readings!r}')
    return readings or Readings()


def _times(stop_time: float, intervals: Any) -> Array:
    if intervals is None:
        return np.empty(0)
    if isinstance(intervals, bool) or not isinstance(intervals, int | np.integer) or intervals < 1:
        raise DeclarationError(f"intervals must be a positive integer, not {intervals!r}")
    return np.linspace(0.0, stop_time, int(intervals) + 1)


def _tolerance(value: Any) -> float:
    found = positive(value, "the tolerance", "")
    if not FINEST <= found <= COARSEST:
        raise DeclarationError(f"the tolerance must be from {FINEST:g} to {COARSEST:g}, not {value!r}")
    return found


def _amplitudes(values: Any, n: int, what: str = "amplitudes and rates") -> Array:
    try:
        found = np.broadcast_to(np.asarray(values, dtype=float), (n,))
    except (TypeError, ValueError):
        found = np.full(1, np.nan)
    if not np.isfinite(found).all():
        raise DeclarationError(f"{what} of {n} modes must be one number or {n} numbers, not {values!r}")
    return found


def _damping(values: Any, n: int) -> Array:
    found = _amplitudes(values, n, "damping ratios")
    if (found < 0).any():
        raise DeclarationError(f"damping ratios must not be negative, as in {values!r}")
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
        raise DeclarationError("the attitude at the start must be a rotation matrix, shape (3, 3)")
    return A


def _vector(values: Any, what: str) -> Array:
    return sampled(values, np.zeros(1), f"the {what} at the start")[0]


def _start(modes: FreeModes, A: Array, O: Array, velocity: Array, w: Array, q: Array, qd: Array) -> Array:
    """Return the state at the start: modal rates in the inertial frame are those in the moving frame plus w x u."""
    from scipy.spatial.transform import Rotation

    carried = np.einsum("k,kab,b->a", w, modes.turning, np.concatenate([np.zeros(6), q]))
    turn = Rotation.from_matrix(A.T).as_rotvec()
    return np.concatenate([O, A.ravel(), turn, np.zeros(6), q, A @ velocity, w, qd + carried[6:]])
