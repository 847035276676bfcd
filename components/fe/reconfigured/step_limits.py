"""Limits of steps in inertial frames: stability, size of a run, divergence, angular velocity."""

from __future__ import annotations

from typing import Any

import numpy as np

from acausal import DeclarationError
from components.fe.arrays import Array
from components.fe.body.validity_range import SPIN
from components.fe.reconfigured.free_modes import FreeModes

# Deviation of the number of steps from an integer: round-off of stop time and step.
WHOLE = 1e-6
# Proposed step relative to the stability limit: a small margin.
BELOW = 0.98
# Deflection that ends a diverging run, relative to the radius of gyration: far above any valid one, long before
# overflow.
FAR = 1e3
# Largest number of values in a motion: 8 GB.
MOST = 1e9


def limit(body: FreeModes) -> tuple[float, float]:
    """Return the largest stable step in s, and the largest modal eigenvalue in 1/s (0 without modes).

    Classical Runge-Kutta steps have the stability function R(z) = 1 + z + z^2/2 + z^3/6 + z^4/24: without damping,
    |R| <= 1 up to dt omega_max = 2 sqrt(2). The rotation of the body is neglected.
    """
    n = body.body.n
    if not n:
        return np.inf, 0.0
    system = np.block([[np.zeros((n, n)), np.eye(n)], [-body.elastic, -body.drag]])
    rates = np.linalg.eigvals(system)
    fastest = float(np.abs(rates).max())
    low, high = 0.0, 4 / fastest  # |R| > 1 on this circle for Re z <= 0
    while high - low > 1e-6 * high:
        dt = (low + high) / 2
        low, high = (dt, high) if _stable(dt * rates) else (low, dt)
    return low, fastest


def _stable(z: Any) -> bool:
    # Round-off of the eigenvalues acts as positive or negative damping, about 1e-12 of z.
    z = np.where(np.abs(z.real) < 1e-9 * np.abs(z), 1j * z.imag, z)
    return bool((np.abs(1 + z * (1 + z / 2 * (1 + z / 3 * (1 + z / 4)))) <= 1 + 1e-9).all())


def steps_of(body: FreeModes, stop_time: Any, dt: Any) -> int:
    """Return the number of steps.

    Raises
    ------
    DeclarationError
        If the stop time is not a multiple of the step, or the step exceeds the stability limit, with a step that works.
    """
    stop_time, dt = positive(stop_time, "the stop time", "s"), positive(dt, "the step", "s")
    most, fastest = limit(body)
    whole = max(int(np.ceil(stop_time / min(dt, BELOW * most) - WHOLE)), 1)
    near = f"dt={stop_time / whole!r}"
    if dt > most:
        raise DeclarationError(
            f"steps of {dt:g} s are unstable: dt * omega_max = {dt * fastest:.4g}, the limit is {most * fastest:.4g}. Use "
            f"{near} or less, or fewer modes: body.first({max(body.body.n - 1, 0)})"
        )
    count = round(stop_time / dt)
    if count < 1 or abs(stop_time / dt - count) > WHOLE:
        raise DeclarationError(f"the stop time {stop_time:g} s is not a multiple of the step {dt:g} s; use {near}")
    numbers = count * (15 + 2 * body.size)
    if numbers > MOST:
        raise DeclarationError(
            f"{count:.3g} steps of {dt:g} s give {numbers:.3g} numbers, more than the limit of {MOST:g}; use longer steps or "
            "a shorter run"
        )
    return count


def positive(value: Any, what: str, unit: str) -> float:
    """Return a positive, finite number.

    Raises
    ------
    DeclarationError
        If it is not.
    """
    number = isinstance(value, int | float | np.integer | np.floating) and not isinstance(value, bool)
    if not (number and 0 < value < np.inf):
        raise DeclarationError(f"{what} must be a positive, finite number{f' of {unit}' * bool(unit)}, not {value!r}")
    return float(value)


def bounds(body: FreeModes) -> Array:
    """Return the absolute values of the state beyond which a run has diverged, shape (15 + 2 N,)."""
    found = np.full(15 + 2 * body.size, np.inf)
    if body.body.n:
        size = np.sqrt(np.trace(body.body.second_moment) / np.diag(body.body.M))
        found[21 : 15 + body.size] = FAR * size
    return found


def diverged(body: FreeModes, w: Array, step: int, time: float, dt: float) -> str:
    """Return the message of a diverged run.

    Parameters
    ----------
    body : FreeModes
        The body.
    w : array, shape (times, 3)
        Angular velocity in rad/s until then.
    step : int
        Diverged step, counted from 1.
    time, dt : float
        End and size of the step in s.
    """
    most, fastest = limit(body)
    turned = float(np.sqrt((w**2).sum(axis=1).max(initial=0.0)))
    if not body.body.n:
        return (
            f"the motion diverges in step {step}, at t = {time:.6g} s: the body rotates at {turned:.4g} rad/s, "
            f"{dt * turned:.4g} rad in a step of {dt:.4g} s. Use shorter steps."
        )
    doubt = too_fast(body, w)
    remedy = f"{doubt[0].upper()}{doubt[1:]}." if doubt else "Use shorter steps."
    return (
        f"the motion diverges in step {step}, at t = {time:.6g} s, with dt * omega_max = {dt * fastest:.4g}, where the "
        f"limit of a body at rest is {most * fastest:.4g}. {remedy}"
    )


def too_fast(body: FreeModes, w: Array) -> str:
    """Return the warning that a body rotates too fast for a linear model, or "".

    Parameters
    ----------
    body : FreeModes
        The body.
    w : array, shape (times, 3)
        Angular velocity in rad/s.
    """
    rates = 2 * np.pi * body.body.frequencies
    most = float(np.sqrt((w**2).sum(axis=1).max(initial=0.0)))
    if not len(rates) or most**2 <= SPIN * rates[0] ** 2:
        return ""
    return (
        f"the body rotates at up to {most:.4g} rad/s, faster than half of its first frequency, {rates[0]:.4g} rad/s: a linear "
        "body lacks centrifugal stiffening there, and steps in inertial frames deviate strongly from a floating frame"
    )
