"""Evaluation of several quantities in one call."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import casadi as ca
import numpy as np

from acausal.result.lookup import Quantity
from acausal.result.snapshot import Snapshot


def read(
    quantities: list[Quantity], evaluate: Callable[[Any], np.ndarray], snapshot: Snapshot | None, times: int
) -> dict[Quantity, np.ndarray]:
    """Return the arrays of quantities, shape (times, *shape) each, read-only.

    Parameters
    ----------
    quantities : list of Quantity
        Expressions of the model, or columns of a snapshot.
    evaluate : callable
        Evaluator of the result, for the expressions.
    snapshot : Snapshot, optional
        The snapshot to which the columns belong.
    times : int
        Number of times.
    """
    arrays: dict[Quantity, np.ndarray] = {}
    for places in (False, True):
        some = [q for q in quantities if isinstance(q.column, np.ndarray) is places]
        ends = np.cumsum([q.size for q in some], dtype=int)
        if not some or not ends[-1]:
            values = np.empty((times, 0))
        elif snapshot is not None and places:
            values = snapshot.evaluate(np.concatenate([q.column for q in some]))
        else:
            values = np.asarray(evaluate(ca.vertcat(*(q.column for q in some))))
        for q, block in zip(some, np.split(values, ends[:-1], axis=1), strict=False):
            arrays[q] = block.reshape(times, *q.shape, order="F")
            arrays[q].flags.writeable = False
    return arrays
