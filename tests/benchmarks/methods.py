"""Every scene with the core's method, with IDAS and with what "auto" takes: errors and processor times in one run.

OPENBLAS_NUM_THREADS=1 python -m tests.benchmarks.methods [SCENE]... [--tolerances 1e-3,1e-5,1e-7] [--around 5] [--markdown]

With `--around`, errors and times are medians over so many tolerances, from three quarters to four thirds of each: where a run
takes a hundred steps, one more or less changes its error several times.
"""

from __future__ import annotations

import argparse
import time
import warnings
from collections.abc import Iterator
from dataclasses import dataclass, replace

import numpy as np
from rich import box
from rich.console import Console
from rich.table import Table

import acausal as ac
import models
from acausal.compiler import CompiledModel
from tests.benchmarks.anew import run_anew

METHODS = ("rosenbrock", "idas", "auto")
# A reference of each method: their distance tells how far they are known. Of free vibration, a part is enough.
REFERENCES = (("auto", 1e-10), ("idas", 1e-9))
PARTS = {"free-vibration": 0.05}
REPEATS = 3
LEGEND = (
    "Error: largest over all outputs, as a fraction of the range of each, against the first of two references; known to: "
    "distance of the two. ms: processor time of `simulate`, best of three, in a run that has compiled before."
)


@dataclass(frozen=True)
class Run:
    """One run: error, seconds, and what it took."""

    scene: str
    tolerance: float
    method: str
    error: float
    seconds: float
    used: str
    steps: int
    factorisations: int
    evaluations: int


def outputs(result: ac.Result) -> np.ndarray:
    """All outputs, a column each."""
    return np.column_stack([np.asarray(result[name]).reshape(len(result.time), -1) for name in result.outputs])


def reference(compiled: CompiledModel, stop_time: float) -> tuple[np.ndarray, float]:
    """Return the outputs of the first reference that is reached, and its distance from the second; nan without one."""
    found = []
    for method, tolerance in REFERENCES:
        try:
            found.append(outputs(ac.simulate(compiled, stop_time=stop_time, method=method, tolerance=tolerance)))
        except ac.SimulationError:
            continue
    return found[0], distance(found[1], found[0]) if len(found) > 1 else np.nan


def distance(values: np.ndarray, exact: np.ndarray) -> float:
    """Largest distance of any output, as a fraction of its range."""
    return float(np.max(np.max(np.abs(values - exact), axis=0) / np.maximum(np.ptp(exact, axis=0), 1e-12)))


def measured(
    compiled: CompiledModel, scene: str, stop_time: float, tolerance: float, method: str, exact: np.ndarray
) -> Run:
    """Run several times, the first time unmeasured."""
    seconds = []
    try:
        for _ in range(REPEATS + 1):
            begun = time.process_time()
            result = run_anew(compiled, stop_time=stop_time, method=method, tolerance=tolerance)
            seconds.append(time.process_time() - begun)
            if sum(seconds) > 5:
                break
    except ac.SimulationError:
        return Run(scene, tolerance, method, np.nan, np.nan, "failed", 0, 0, 0)
    stats = result.stats
    used = stats.method + (", damped" if stats.damped else "")
    counts = stats.steps, stats.factorisations, stats.residual_evaluations
    return Run(scene, tolerance, method, distance(outputs(result), exact), min(seconds[1:] or seconds), used, *counts)


def typical(found: list[Run], tolerance: float) -> Run:
    """The run of some with the median error, with the median of their times; one that failed, if any did."""
    failed = [run for run in found if np.isnan(run.error)]
    middle = sorted(found, key=lambda run: run.error)[len(found) // 2]
    seconds = float(np.median([run.seconds for run in found]))
    return replace(failed[0] if failed else middle, tolerance=tolerance, seconds=seconds)


def runs(scene: str, tolerances: list[float], around: int) -> Iterator[list[Run]]:
    """The three runs of each tolerance."""
    factors = 0.75 ** np.linspace(-1, 1, around) if around > 1 else np.ones(1)
    cls = models.SCENES[scene]
    stop_time, compiled = float(getattr(cls, "stop_time")) * PARTS.get(scene, 1.0), ac.compile(cls())  # noqa: B009
    exact, known = reference(compiled, stop_time)
    Console().print(f"{scene}: known to {known:.1e}")
    for tolerance in tolerances:
        near = [float(tolerance * factor) for factor in factors]
        found = [[measured(compiled, scene, stop_time, t, method, exact) for t in near] for method in METHODS]
        yield [typical(some, tolerance) for some in found]


def verdict(rosenbrock: Run, idas: Run, auto: Run) -> str:
    """What "auto" misses: at most twice the error of IDAS, at most a third more time than the better one."""
    fits = [run.seconds for run in (rosenbrock, idas) if run.error <= 2 * idas.error]
    worse = [] if auto.error <= 2 * idas.error else [f"error {auto.error / idas.error:.2g} times"]
    ratio = auto.seconds / min(fits, default=np.nan)
    return ", ".join([*worse, *([f"time {ratio:.2g} times"] if ratio > 4 / 3 else [])])


def main() -> None:
    """Print the table."""
    warnings.simplefilter("ignore")
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("scenes", nargs="*", default=list(models.SCENES))
    parser.add_argument("--tolerances", default="1e-3,1e-5,1e-7")
    parser.add_argument("--around", type=int, default=1, help="medians over so many tolerances beside each")
    parser.add_argument("--markdown", action="store_true", help="table in Markdown")
    given = parser.parse_args()
    head = (
        "scene",
        "tolerance",
        *(f"{what} {m}" for m in METHODS for what in ("error", "ms", "steps")),
        "taken",
        "misses",
    )
    table = Table(*head, box=box.MARKDOWN if given.markdown else box.HEAVY_HEAD)
    cells = missed = 0
    for scene in given.scenes:
        for row in runs(scene, [float(t) for t in given.tolerances.split(",")], given.around):
            missing = verdict(*row)
            cells, missed = cells + 1, missed + bool(missing)
            values = [text for r in row for text in (f"{r.error:.1e}", f"{1e3 * r.seconds:.0f}", f"{r.steps:,}")]
            table.add_row(scene, f"{row[0].tolerance:g}", *values, row[-1].used, missing)
    Console(width=220).print(table, LEGEND)
    print(f"{cells - missed} of {cells} cells keep what auto promises")


if __name__ == "__main__":
    main()
