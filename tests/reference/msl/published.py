"""Compare a model with the published results of its twin in the Modelica Standard Library.

The results are those of the maintainers (version 4.1.0), computed with tolerances of 1e-4 to 1e-6. `published.json` holds, for
each model, 21 instants, the values of the compared variables there, their ranges in the whole run, and the instants near
events, at which only what is continuous is compared.
"""

from __future__ import annotations

import json
import re
from collections.abc import Mapping
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


def read(result: ac.Result, path: str) -> np.ndarray:
    """Read a variable by its path, in which indices count from 1."""
    name, *index = re.match(r"(.*?)(?:\[(\d+)\])?$", path).groups()
    return result[name] if index == [None] else result[name][:, int(index[0]) - 1]


def unit_of(result: ac.Result, ours: Any) -> str:
    """Unit of a variable, by which magnitudes are compared; functions of the result have none in common."""
    if callable(ours):
        return repr(ours)
    found: Any = result.tree
    for name, index in re.findall(r"(\w+)(?:\[(\d+)\](?=\.))?", re.sub(r"\[\d+\]$", "", ours)):
        found = getattr(found, name) if not index else getattr(found, name)[int(index)]
    return str(found.unit)


def compare(
    name: str,
    model: ac.Model,
    names: Mapping[str, Any] | None = None,
    left_out: tuple[str, ...] = (),
    tolerance: float = TOLERANCE,
    most_left_out: int | None = None,
    **settings: Any,
) -> ac.Result:
    """Assert that a model moves as published.

    Parameters
    ----------
    name : str
        Full name of the model in the Modelica Standard Library.
    model : Model
        Its twin.
    names : mapping of str to str or callable, optional
        Our path of a published variable, or a function of the result that gives its values; others have the same path.
    left_out : tuple of str
        Published variables without a counterpart, or compared otherwise.
    most_left_out : int, optional
        How many may be left out; a tenth of all where it is not given.
    tolerance : float
        Largest difference over the scale of a variable: its range in the run, or where that is less than 1e-6 of the
        largest magnitude among the compared variables of its unit, that magnitude.
    """
    data = published()[name]
    time = np.array(data["time"])
    variables = [v for v in data if v not in ("time", "_range", "_near_event")]
    compared = [v for v in variables if v not in left_out]
    assert len(variables) - len(compared) <= (0.1 * len(variables) if most_left_out is None else most_left_out)
    result = ac.simulate(
        model,
        stop_time=time[-1],
        intervals=settings.pop("intervals", 2000),
        tolerance=settings.pop("run", 1e-7),
        **settings,
    )
    away = np.setdiff1d(np.arange(len(time)), data["_near_event"])
    units = {v: unit_of(result, (names or {}).get(v, v)) for v in compared}
    for v in compared:
        ours = (names or {}).get(v, v)
        got = np.interp(time, result.time, ours(result) if callable(ours) else read(result, ours))
        most = max(1e-3, *(np.max(np.abs(data[w])) for w in compared if units[w] == units[v]))
        spread = data["_range"][v]
        scale = spread if spread > 1e-6 * most else most
        error = np.max(np.abs(got - data[v])[away]) / scale
        assert error <= tolerance, f"{v}: {error:.2e} of {scale:.3g}"
    return result
