"""Deviations of values from a reference, as a fraction of its range."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from acausal.simulation.estimate import scale


def deviations(
    values: Mapping[str, np.ndarray],
    reference: Mapping[str, np.ndarray],
    ranges: Mapping[str, np.ndarray] | None = None,
) -> dict[str, tuple[float, float]]:
    """Return the largest and the root mean square deviation of each output of the reference, as a fraction of its range.

    A constant output is compared with its magnitude; an output that is 0, with 1.

    Parameters
    ----------
    values, reference : mapping of str to array, shape (times,)
        At the same times.
    ranges : mapping of str to array, optional
        Values whose ranges are the scales; those of the reference if not given.
    """
    found = {}
    for name, exact in reference.items():
        difference = (np.asarray(values[name]) - exact) / scale((ranges or reference)[name])
        found[name] = (float(np.max(np.abs(difference))), float(np.sqrt(np.mean(difference**2))))
    return found


def worst(
    values: Mapping[str, np.ndarray],
    reference: Mapping[str, np.ndarray],
    ranges: Mapping[str, np.ndarray] | None = None,
) -> float:
    """Return the largest deviation over all outputs.

    Parameters
    ----------
    values, reference, ranges : mapping of str to array, shape (times,)
        As in `deviations`.
    """
    return max((most for most, _ in deviations(values, reference, ranges).values()), default=0.0)
