"""Compare a model with the published results of its twin in the Modelica Standard Library.

The results are those of the maintainers (version 4.1.0), computed with tolerances of 1e-4 to 1e-6. `published.json` holds, for
each model, 21 instants, the values of the compared variables there, their ranges in the whole run, and the instants near
events, at which only what is continuous is compared.
"""

from __future__ import annotations

import json
from collections.abc import Callable, Mapping
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np

import acausal as ac

TOLERANCE = 1e-3  # of the range, for models that move


@cache
def published() -> dict[str, Any]:
    """All published results by the full name of their model."""
    return json.loads((Path(__file__).parent / "published.json").read_text())


def compare(
    name: str,
    model: ac.Model,
    names: Mapping[str, Any] | Callable[[str], Any],
    left_out: tuple[str, ...] = (),
    tolerance: float = TOLERANCE,
    **settings: Any,
) -> ac.Result:
    """Assert that a model moves as published.

    Parameters
    ----------
    name : str
        Full name of the model in the Modelica Standard Library.
    model : Model
        Its twin.
    names : mapping or callable
        What in our result stands for each published variable: a path, or a function of the result.
    left_out : tuple of str
        Published variables without a counterpart, at most a tenth of all.
    tolerance : float
        Largest difference over the scale of a variable: its range in the run, or where that is less than 1e-6 of the
        largest magnitude among the compared variables of its kind, that magnitude.
    """
    data = published()[name]
    time = np.array(data["time"])
    variables = [v for v in data if v not in ("time", "_range", "_near_event")]
    compared = [v for v in variables if v not in left_out]
    assert len(compared) >= 0.9 * len(variables)
    result = ac.simulate(
        model,
        stop_time=time[-1],
        intervals=settings.pop("intervals", 2000),
        tolerance=settings.pop("run", 1e-7),
        **settings,
    )
    away = np.setdiff1d(np.arange(len(time)), data["_near_event"])
    largest = {v: float(np.max(np.abs(data[v]))) for v in compared}
    for v in compared:
        ours = names(v) if callable(names) else names[v]
        values = ours(result) if callable(ours) else result[ours]
        got = np.interp(time, result.time, values)
        alike = max(largest[w] for w in compared if w.rpartition(".")[2] == v.rpartition(".")[2])
        most = max(alike, 1e-3)
        spread = data["_range"][v]
        scale = spread if spread > 1e-6 * most else most
        error = np.max(np.abs(got - data[v])[away]) / scale
        assert error <= tolerance, f"{v}: {error:.2e} of {scale:.3g}"
    return result
