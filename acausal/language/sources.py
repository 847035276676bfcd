"""Signals as functions of time, with the parameters of Modelica's Blocks.Sources."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any

from acausal.errors import DeclarationError
from acausal.language.functions import atan2, cos, piecewise, quantity, sin, time
from acausal.language.lookup import table
from acausal.language.table import Table


def sine(amplitude: Any = 1, f: Any = 1, phase: Any = 0, offset: Any = 0, start_time: Any = 0) -> Any:
    """Sine wave from start_time on: offset + amplitude sin(2 pi f (time - start_time) + phase).

    Parameters
    ----------
    amplitude, offset : float or Expr
        Amplitude, and the value before start_time, in the unit of the signal.
    f : float or Expr
        Frequency in Hz.
    phase : float or Expr
        Phase at start_time in rad.
    start_time : float or Expr
        Start of the wave in s.
    """
    wave = amplitude * sin(2 * math.pi * _in(f, "Hz") * (time - start_time) + phase)
    return offset + piecewise((0, time < start_time), wave)


def step(height: Any = 1, offset: Any = 0, start_time: Any = 0) -> Any:
    """Step from offset to offset + height at start_time in s."""
    return offset + piecewise((0, time < start_time), height)


def ramp(height: Any = 1, duration: Any = 2, offset: Any = 0, start_time: Any = 0) -> Any:
    """Ramp from offset to offset + height.

    Parameters
    ----------
    height, offset : float or Expr
        Rise, and the value before it, in the unit of the signal.
    duration, start_time : float or Expr
        Duration and start of the rise in s; a duration of 0 gives a step.
    """
    if _is_number(duration) and duration == 0:
        return step(height, offset, start_time)
    rise = height * ((time - start_time) / _in(duration, "s"))
    return offset + piecewise((0, time < start_time), (rise, time < start_time + duration), height)


def pulse(
    amplitude: Any = 1, width: Any = 50, period: Any = 1, n_period: int = -1, offset: Any = 0, start_time: Any = 0
) -> Any:
    """Rectangular pulses: offset + amplitude in the first `width` per cent of each period.

    Parameters
    ----------
    amplitude, offset : float or Expr
        Height of the pulses, and the value between them, in the unit of the signal.
    width : float or Expr
        Width of a pulse in per cent of the period, more than 0 and less than 100.
    period, start_time : float or Expr
        Period, and where the first pulse begins, in s.
    n_period : int
        Number of pulses; a negative one is without end.
    """
    return trapezoid(amplitude, 0, width * period / 100, 0, period, n_period, offset, start_time)


def trapezoid(
    amplitude: Any = 1,
    rising: Any = 0,
    width: Any = 0.5,
    falling: Any = 0,
    period: Any = 1,
    n_period: int = -1,
    offset: Any = 0,
    start_time: Any = 0,
) -> Any:
    """Trapezoidal pulses.

    Parameters
    ----------
    amplitude, offset : float or Expr
        Height of the pulses, and the value between them, in the unit of the signal.
    rising, width, falling : float or Expr
        Durations of the rise, the top and the fall in s; together less than the period.
    period, start_time : float or Expr
        Period, and where the first pulse begins, in s.
    n_period : int
        Number of pulses; a negative one is without end.
    """
    if isinstance(n_period, bool) or not isinstance(n_period, int):
        raise DeclarationError(
            f"n_period is a whole number of pulses, or negative for pulses without end, not {n_period!r}."
        )
    if n_period == 0:
        return step(0, offset)

    period = _in(period, "s")

    def angle(at: Any) -> Any:
        """Return an angle that is 0 at `at` in every period."""
        return 2 * math.pi * ((time - start_time - at) / period)

    def within(begin: Any, duration: Any) -> Any:
        """Return a condition that holds for `duration` from `begin` on in every period."""
        return cos(angle(begin + duration / 2)) >= cos(2 * math.pi * (_in(duration, "s") / 2 / period))

    def elapsed(begin: Any, duration: Any) -> Any:
        """Return the fraction of `duration` that has passed since `begin`, valid within it."""
        turn = angle(begin + duration / 2)
        return 0.5 + period / _in(duration, "s") * atan2(sin(turn), cos(turn)) / (2 * math.pi)

    cases: list[Any] = [(0, time < start_time)]
    if n_period > 0:
        cases.append((0, time >= start_time + n_period * period))
    if not (_is_number(rising) and rising == 0):
        cases.append((amplitude * elapsed(0, rising), within(0, rising)))
    if not (_is_number(falling) and falling == 0):
        cases.append((amplitude * (1 - elapsed(rising + width, falling)), within(rising + width, falling)))
    cases.append((amplitude, within(rising, width)))
    return offset + piecewise(*cases, 0)


def time_table(rows: Sequence[Sequence[float]], offset: Any = 0, start_time: Any = 0) -> Any:
    """Interpolate a table of time and value linearly.

    Parameters
    ----------
    rows : sequence of (time, value)
        At least one row, with ascending times in s after start_time; two rows of one time are a jump, from which the
        second one holds. The outermost segments are extrapolated.
    offset : float or Expr
        Added to the values, and the value before start_time, in the unit of the signal.
    start_time : float or Expr
        Start of the table in s: time 0 in its rows.

    Raises
    ------
    DeclarationError
        The times descend, or more than two rows have one time.
    """
    rows = [(float(t), float(y)) for t, y in rows]
    times = [t for t, _ in rows]
    if not rows or sorted(times) != times or any(a == c for a, c in zip(times, times[2:], strict=False)):
        raise DeclarationError(
            "a table of time has rows (time, value) of ascending times, of which at most two are equal: "
            "time_table([(0, 0), (1, 2), (1, 3), (2, 3)])."
        )
    values = table(time - start_time, Table(times, [y for _, y in rows], extrapolation="linear"))
    return offset + piecewise((0, time < start_time), values)


def _in(x: Any, unit: str) -> Any:
    """Return a number with its unit, other values unchanged."""
    return quantity(x, unit) if _is_number(x) else x


def _is_number(x: Any) -> bool:
    return isinstance(x, int | float)
