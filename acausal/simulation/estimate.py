"""Error estimates of a run by comparison with finer runs."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from acausal.policy import POLICY
from acausal.result import Result

ESTIMATE = POLICY.estimate


@dataclass(frozen=True)
class Estimate:
    """Estimated errors of a run as fractions of the range of each output.

    Parameters
    ----------
    outputs : dict of str to float
        Total error of each output.
    total, tolerance, elements : float
        Largest error of all outputs: in total, due to the tolerance, due to the number of elements.
    worst : str
        The output with the largest error.
    """

    outputs: dict[str, float]
    total: float
    tolerance: float
    elements: float
    worst: str


def table(result: Result) -> tuple[list[str], np.ndarray]:
    """Return names and values of the outputs, shape (times, outputs)."""
    series = result.series()
    return [s.name for s in series], np.column_stack([s.values for s in series])


def scale(values: np.ndarray) -> np.ndarray:
    """Return the scale of an error: the range of the values; their magnitude if they are constant; 1 if they are 0.

    Parameters
    ----------
    values : array, shape (times,) or (times, outputs)
        The exact values.
    """
    size = np.max(np.abs(values), axis=0)
    moved = np.ptp(values, axis=0)
    rest = np.where(size > ESTIMATE.rounding, size, 1.0)
    return np.where(moved > ESTIMATE.rounding * np.maximum(size, 1.0), moved, rest)


def estimate(run: Result, finer: Result, tenths: float, doubled: Result | None, halved: Result | None) -> Estimate:
    """Estimate the errors of a run.

    Richardson extrapolation accounts for the error of the finer run: with a fixed power of the tolerance, and with the
    observed order in the number of elements if there are three runs.

    Parameters
    ----------
    run : Result
        The run.
    finer : Result
        The run with a tighter tolerance.
    tenths : float
        Ratio of its tolerance to that of the run.
    doubled, halved : Result or None
        Runs like `finer` with twice, and with half as many elements.
    """
    names, values = table(run)
    exact = table(doubled or finer)[1]
    unit = scale(exact)
    by_tolerance = (values - table(finer)[1]) / unit / (1 - tenths**ESTIMATE.by_tolerance)
    by_elements = np.zeros_like(values)
    if doubled is not None:
        step = (table(finer)[1] - exact) / unit
        order = ESTIMATE.order
        if halved is not None:
            before = (table(halved)[1] - table(finer)[1]) / unit
            order = float(np.log2(max(_size(before), np.finfo(float).tiny) / max(_size(step), np.finfo(float).tiny)))
        by_elements = step / (1 - 2.0 ** -np.clip(order, 1.0, ESTIMATE.highest))
    found = np.max(np.abs(by_tolerance + by_elements), axis=0)
    found = np.where(np.isfinite(found), found, np.inf)
    worst = int(np.argmax(found))
    return Estimate(
        dict(zip(names, found.tolist(), strict=True)),
        float(found[worst]),
        _size(by_tolerance),
        _size(by_elements),
        names[worst],
    )


def _size(values: np.ndarray) -> float:
    size = float(np.max(np.abs(values)))
    return size if np.isfinite(size) else np.inf
