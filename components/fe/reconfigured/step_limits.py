"""Where single steps in inertial frames hold: steps that are short enough, slow turns."""

from __future__ import annotations

from typing import Any

import numpy as np

from acausal import DeclarationError
from components.fe.arrays import Array
from components.fe.body.validity_range import SPIN
from components.fe.reconfigured.free_modes import FreeModes

# Of a step: how far the number of steps may be from a whole one by rounding of stop time and step.
WHOLE = 1e-6
# Of the limit of stability: a step that is proposed.
BELOW = 0.98
# Of the size of a body: where the deflections of a run that diverges end it, long before they overflow.
FAR = 1e3
# Most numbers that a motion may hold: 8 GB.
MOST = 1e9


def limit(body: FreeModes) -> tuple[float, float]:
    """Largest stable step in s, and the largest eigenvalue of the modes in 1/s, 0 without modes.

    Steps of order 4 multiply a solution exp(z t / dt) by R(z) = 1 + z + z^2/2 + z^3/6 + z^4/24: without damping
    |R| <= 1 up to dt omega_max = 2 sqrt(2). Turns of the body are not counted.
    """
    n = body.body.n
    if not n:
        return np.inf, 0.0
    system = np.block([[np.zeros((n, n)), np.eye(n)], [-body.elastic, -body.drag]])
    rates = np.linalg.eigvals(system)
    fastest = float(np.abs(rates).max())
    low, high = 0.0, 4 / fastest  # on the circle of this radius |R| > 1 wherever Re z <= 0
    while high - low > 1e-6 * high:
        dt = (low + high) / 2
        low, high = (dt, high) if _stable(dt * rates) else (low, dt)
    return low, fastest


def _stable(z: Any) -> bool:
    # Rounding of the eigenvalues counts as damping or as its opposite, by about 1e-12 of z.
    z = np.where(np.abs(z.real) < 1e-9 * np.abs(z), 1j * z.imag, z)
    return bool((np.abs(1 + z * (1 + z / 2 * (1 + z / 3 * (1 + z / 4)))) <= 1 + 1e-9).all())


def steps_of(body: FreeModes, stop_time: Any, dt: Any) -> int:
    """Number of steps.

    Raises
    ------
    DeclarationError
        If the stop time is no multiple of the step, or the step is beyond the limit of stability, with one that works.
    """
    stop_time, dt = positive(stop_time, "the stop time", "s"), positive(dt, "the step", "s")
    most, fastest = limit(body)
    whole = max(int(np.ceil(stop_time / min(dt, BELOW * most) - WHOLE)), 1)
    near = f"dt={stop_time / whole!r}"
    if dt > most:
        raise DeclarationError(
            f"steps of {dt:g} s are unstable: dt * omega_max = {dt * fastest:.4g}, the limit is {most * fastest:.4g}. Take "
            f"{near} or less, or fewer modes: body.first({max(body.body.n - 1, 0)})"
        )
    count = round(stop_time / dt)
    if count < 1 or abs(stop_time / dt - count) > WHOLE:
        raise DeclarationError(f"the stop time {stop_time:g} s is no multiple of the step {dt:g} s: take {near}")
    numbers = count * (15 + 2 * body.size)
    if numbers > MOST:
        raise DeclarationError(
            f"{count:.3g} steps of {dt:g} s give {numbers:.3g} numbers, more than the {MOST:g} that a result may hold: take "
            "longer steps, or a shorter run"
        )
    return count


def positive(value: Any, what: str, unit: str) -> float:
    """Return a positive, finite number.

    Raises
    ------
    DeclarationError
        If it is none.
    """
    number = isinstance(value, int | float | np.integer | np.floating) and not isinstance(value, bool)
    if not (number and 0 < value < np.inf):
        raise DeclarationError(f"{what} is a positive, finite number{f' of {unit}' * bool(unit)}, not {value!r}")
    return float(value)


def bounds(body: FreeModes) -> Array:
    """Largest absolute values of a state beyond which a run has diverged, shape (15 + 2 N,)."""
    found = np.full(15 + 2 * body.size, np.inf)
    if body.body.n:
        size = np.sqrt(np.trace(body.body.second_moment) / np.diag(body.body.M))
        found[21 : 15 + body.size] = FAR * size
    return found


def diverged(body: FreeModes, w: Array, step: int, time: float, dt: float) -> str:
    """Say that a run diverged.

    Parameters
    ----------
    body : FreeModes
        The body.
    w : array, shape (times, 3)
        Its angular velocity in rad/s, up to there.
    step : int
        The step that diverged, counted from 1.
    time, dt : float
        Its end and its size in s.
    """
    most, fastest = limit(body)
    turned = float(np.sqrt((w**2).sum(axis=1).max(initial=0.0)))
    if not body.body.n:
        return (
            f"the motion diverges in step {step}, at t = {time:.6g} s: the body turns by {turned:.4g} rad/s, "
            f"{dt * turned:.4g} rad in a step of {dt:.4g} s. Take shorter steps."
        )
    doubt = too_fast(body, w)
    mend = f"{doubt[0].upper()}{doubt[1:]}." if doubt else "Take shorter steps."
    return (
        f"the motion diverges in step {step}, at t = {time:.6g} s, with dt * omega_max = {dt * fastest:.4g}, where the "
        f"limit of a body that does not turn is {most * fastest:.4g}. {mend}"
    )


def too_fast(body: FreeModes, w: Array) -> str:
    """Say that a body turns too fast for a linear model, "" if it does not.

    Parameters
    ----------
    body : FreeModes
        The body.
    w : array, shape (times, 3)
        Its angular velocity in rad/s.
    """
    rates = 2 * np.pi * body.body.frequencies
    most = float(np.sqrt((w**2).sum(axis=1).max(initial=0.0)))
    if not len(rates) or most**2 <= SPIN * rates[0] ** 2:
        return ""
    return (
        f"the body turns by up to {most:.4g} rad/s, faster than half of its first frequency, {rates[0]:.4g} rad/s: there a "
        "linear body is not stiffened by centrifugal forces, and steps in inertial frames differ in kind from a floating frame"
    )
