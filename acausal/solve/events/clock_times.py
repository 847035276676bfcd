"""When conditions of time and parameters alone change: every instant in a run, however short what lies between.

Intervals are halved until bounds of the condition show that it cannot change in them, or bounds of its derivative that it
changes once at most (branch and bound with interval arithmetic; R. E. Moore, Interval Analysis, 1966).
"""

from __future__ import annotations

from collections.abc import Callable

import casadi as ca
import numpy as np

from acausal.compiler import CompiledModel
from acausal.compiler.intervals import bounds
from acausal.errors import caution
from acausal.policy import POLICY

CLOCK = POLICY.clock


def clock_times(compiled: CompiledModel, p: np.ndarray, start: float, stop: float) -> list[float]:
    """Return the instants at which conditions that are not linear in time change; in order, without doubles.

    Parameters
    ----------
    compiled : CompiledModel
        The model.
    p : array
        Parameter values.
    start, stop : float
        Ends of the run in s.
    """
    found: list[np.ndarray] = []
    for function, slope, inclusive, origin in compiled.guards.curved:
        instants, missed = _changes(function, slope, inclusive, p, start, stop)
        found.append(instants)
        if missed:
            caution(
                f"{origin}: the condition changes too often to find every instant; one that changes and changes back "
                f"within {missed:.3g} s may be missed. Simulate a shorter time, or compare a variable."
            )
    if not found:
        return []
    found.append(_without_value(compiled, p, start, stop))
    return np.unique(np.concatenate(found)).tolist()


def _without_value(compiled: CompiledModel, p: np.ndarray, start: float, stop: float) -> np.ndarray:
    """Instants from which on conditions have no value, or have one again."""

    def lost(times: np.ndarray) -> np.ndarray:
        return np.array([np.isnan(compiled.guards.holds_at(p, t, 0.0)[0]).any() for t in times])

    times = np.linspace(start, stop, CLOCK.looks + 1)
    return _halve(lost, times[:-1], times[1:])


def _changes(
    function: ca.Function, slope: ca.Function, inclusive: bool, p: np.ndarray, start: float, stop: float
) -> tuple[np.ndarray, float]:
    """Instants at which a function of time passes 0, and the length of intervals that were not examined."""

    def holds(t: np.ndarray) -> np.ndarray:
        value = bounds(function, p, t, t)[0][0]
        return value <= 0 if inclusive else value < 0

    shortest = CLOCK.shortest * max(abs(start), abs(stop), stop - start)
    edges = np.linspace(start, stop, CLOCK.first + 1)
    low, high, found, missed = edges[:-1], edges[1:], [np.empty(0)], 0.0
    while len(low):
        (least, most), jumps = bounds(function, p, low, high)
        mixed = (least <= 0) & (most >= 0) & ((most > 0) if inclusive else (least < 0))
        low, high, jumps, size = low[mixed], high[mixed], jumps[mixed], np.maximum(-least, most)[mixed]
        (slowest, fastest), _ = bounds(slope, p, low, high)
        middle, reach = (low + high) / 2, np.maximum(-slowest, fastest) * (high - low) / 2
        far = np.abs(bounds(function, p, middle, middle)[0][0]) > reach + CLOCK.rounding * size
        once = ((slowest > 0) | (fastest < 0)) & ~jumps
        last = once | (high - low <= shortest)
        if len(low) > CLOCK.most:
            missed, last = float(np.max(high - low)), np.ones(len(low), dtype=bool)
        found.append(_halve(holds, low[last], high[last]))
        go_on = ~last & (jumps | ~far)
        low, middle, high = low[go_on], middle[go_on], high[go_on]
        low, high = np.concatenate([low, middle]), np.concatenate([middle, high])
    return np.concatenate(found), missed


def _halve(holds: Callable[[np.ndarray], np.ndarray], low: np.ndarray, high: np.ndarray) -> np.ndarray:
    """Where a condition changes in each interval at whose ends it differs."""
    before = holds(low)
    differs = before != holds(high)
    low, high, before = low[differs], high[differs], before[differs]
    for _ in range(CLOCK.halvings if len(low) else 0):
        middle = (low + high) / 2
        same = holds(middle) == before
        low, high = np.where(same, middle, low), np.where(same, high, middle)
    return high
