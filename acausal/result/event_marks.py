"""Marks of the events of a run for plots: their instants, and what changed there."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from typing import Any

import numpy as np

# Changes listed for an event, and marks in a page, which are closer than a pixel then.
LISTED, MOST = 3, 2000
BREAK = "a law of time changes"


def event_marks(
    time: np.ndarray, events: Sequence[float], breaks: Sequence[float], variables: Iterable[tuple[str, str, np.ndarray]]
) -> list[dict[str, Any]]:
    """Return marks in the order of time, as `events` in page/DOCUMENT.md.

    What changed is known of a variable that changes at events only, where a single event lies between two times of the result.

    Parameters
    ----------
    time : array, shape (times,)
        Times of the result in s.
    events, breaks : sequence of float
        Times in s of events, and of changes of laws of time that are no events.
    variables : iterable of (str, str, array)
        Names, units and values of scalars over time.
    """
    marks = {float(t): BREAK for t in breaks} | {float(t): "" for t in events if t not in set(breaks)}
    instants = np.array(sorted(t for t in marks if len(time) and time[0] <= t <= time[-1]))
    if not len(instants):
        return []
    places = np.clip(
        np.searchsorted(time, instants) - 1, 0, max(len(time) - 2, 0)
    )  # the interval that ends at or after it
    changes = _changes(len(time) - 1, places, variables)
    coarse = np.floor((instants - time[0]) / ((time[-1] - time[0]) or 1.0) * MOST)
    shown = np.flatnonzero(np.diff(coarse, prepend=-1))
    alone = np.bincount(places, minlength=1)[places] == 1
    return [
        {"t": float(instants[k]), "what": (changes.get(int(places[k]), "") if alone[k] else "") or marks[instants[k]]}
        for k in shown
    ]


def _changes(intervals: int, places: np.ndarray, variables: Iterable[tuple[str, str, np.ndarray]]) -> dict[int, str]:
    """Return for intervals what changes in them, of variables that change in those with an event only."""
    quiet = np.ones(max(intervals, 0), dtype=bool)
    quiet[places[places < intervals]] = False
    found: dict[int, list[str]] = {}
    if not quiet.any():  # all that moves changes in them
        return {}
    for name, unit, values in variables:
        changed = np.diff(values) != 0
        if changed.any() and not changed[quiet].any():
            for k in np.flatnonzero(changed):
                text = f"{name}: {values[k]:.4g} \u2192 {values[k + 1]:.4g}"
                found.setdefault(int(k), []).append(text if unit in ("", "1") else f"{text} {unit}")
    return {
        k: ", ".join([*texts[:LISTED], *([f"and {len(texts) - LISTED} more"] if len(texts) > LISTED else [])])
        for k, texts in found.items()
    }
