"""Runs of the scenes with events: what they count, how long they take, and how far they are from another method."""

from __future__ import annotations

import time as clock
from collections.abc import Callable, Iterator
from dataclasses import dataclass, field
from functools import partial
from typing import Any

import numpy as np

import acausal as ac
from tests.benchmarks.events.engine import EngineV6
from tests.benchmarks.events.scenes import Ball, Drive, SampledPendulum, StickSlip

METHODS, TOLERANCES, TIGHT = ("idas", "rosenbrock", "auto"), (1e-4, 1e-6), 1e-9
OTHER = {"idas": "rosenbrock", "rosenbrock": "idas"}  # method of the reference
CALLS = 2  # aimed at for each event
REPEATS, ENOUGH = 3, 2.0  # runs, of which the first also makes integrators; two if they take ENOUGH seconds


@dataclass(frozen=True)
class Scene:
    """A model with events.

    Parameters
    ----------
    name : str
        For the table.
    make : callable
        Returns the model.
    short : float
        End of the short run in s; the model's stop_time is that of the full run.
    intervals : int
        Of the full run; a short run has outputs as dense.
    steps : int
        Steps aimed at for each event.
    unit : str
        What an event is.
    """

    name: str
    make: Callable[[], Any]
    short: float
    intervals: int
    steps: int = 30
    unit: str = "event"

    def span(self, full: bool) -> dict[str, Any]:
        """Stop time and intervals of a run."""
        end = self.make().stop_time
        stop = end if full else self.short
        return {"stop_time": stop, "intervals": round(self.intervals * stop / end)}


SCENES = (
    Scene("V6, plain joints", EngineV6, 0.12, 1010),
    Scene("V6, planar joints", partial(EngineV6, planar=True), 0.12, 1010),
    Scene("sampled pendulum", SampledPendulum, 0.3, 400, 10, "sample"),
    Scene("sampled pendulum, outputs between", SampledPendulum, 0.1, 6660, 10, "sample"),
    Scene("stick-slip", StickSlip, 10.0, 400),
    Scene("drive", Drive, 4.0, 2000),
    Scene("ball", Ball, 7.8, 400),
)


@dataclass(frozen=True)
class Row:
    """One run: its statistics, processor time and largest error of an output as a fraction of the range, or what failed.

    `doubt` is how much the references differ.
    """

    scene: Scene
    method: str
    tolerance: float
    failure: str = ""
    doubt: float | str = ""
    stats: dict[str, Any] = field(default_factory=dict)
    outputs: int = 0
    seconds: float = 0.0
    error: float | str = ""

    @property
    def events(self) -> int:
        """Instants at which the run was interrupted: searched or planned events, and break times."""
        return self.stats["events"] + len(self.stats["break_times"])

    def per_event(self, count: str) -> float:
        """A count of the run for each event."""
        return self.stats[count] / max(self.events, 1)


def measure(scene: Scene, full: bool = False) -> Iterator[Row]:
    """Run a scene by each method with each tolerance."""
    compiled, how = ac.compile(scene.make()), scene.span(full)
    tight = {method: attempt(compiled, repeats=1, method=method, tolerance=TIGHT, **how) for method in OTHER.values()}
    ends = list(tight.values())
    doubt = ends[0] if isinstance(ends[0], str) else difference(ends[0][0], ends[1])
    for tolerance in TOLERANCES:
        for method in METHODS:
            found = attempt(compiled, method=method, tolerance=tolerance, **how)
            if isinstance(found, str):
                yield Row(scene, method, tolerance, found, doubt)
                continue
            result, seconds = found
            error = difference(result, tight[OTHER.get(result.stats["method"], "rosenbrock")])
            yield Row(scene, method, tolerance, "", doubt, dict(result.stats), len(result.time), seconds, error)


def attempt(compiled: ac.CompiledModel, repeats: int = REPEATS, **how: Any) -> tuple[ac.Result, float] | str:
    """Return a result and the least processor time of several runs, or why there is none."""
    taken: list[float] = []
    while True:
        start = clock.process_time()
        try:
            result = ac.simulate(compiled, **how)
        except ac.AcausalError as failure:
            return str(failure)
        taken.append(clock.process_time() - start)
        if len(taken) >= repeats or (len(taken) > 1 and sum(taken) > ENOUGH):
            return result, min(taken)


def difference(result: ac.Result, other: tuple[ac.Result, float] | str) -> float | str:
    """Largest difference of an output as a fraction of its range, or why there is nothing to compare with."""
    if isinstance(other, str):
        return f"no reference: {other}"
    exact = other[0]
    return max(float(np.abs(result[n] - exact[n]).max() / np.ptp(exact[n])) for n in result.outputs)
