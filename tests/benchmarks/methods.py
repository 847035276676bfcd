"""Every scene with every method: errors, processor times and steps.

    OPENBLAS_NUM_THREADS=1 python -m tests.benchmarks.methods [SCENE]... [--tolerances 1e-3,1e-5,1e-7] [--around 5] [--write]

`--write` writes the table as docs/background/methods-tables.md instead of printing it.

With `--around`, errors and times are medians over so many tolerances, from three quarters to four thirds of each: where a run
takes a hundred steps, one more or less changes its error several times.
"""

from __future__ import annotations

import argparse
import re
import time
import warnings
from collections.abc import Iterator
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np

import acausal as ac
import models
from acausal.compiler import CompiledModel
from tests.benchmarks.anew import run_anew

PAGE = Path("docs/background/methods-tables.md")
METHODS = ("rosenbrock", "idas", "auto")
# A reference of each method: their distance tells how far they are known. Of free vibration, a part is enough.
REFERENCES = (("auto", 1e-10), ("idas", 1e-9))
PARTS = {"free-vibration": 0.05}
REPEATS = 3
HEAD = ("scene", "tolerance", *(f'"{method}"' for method in METHODS), "behind")
INTRODUCTION = """# Every scene with every method: table

Written by `python -m tests.benchmarks.methods --tolerances {tolerances} --write`.

Entries are error, processor time in ms (steps). The error is the largest of any output relative to its range, compared with a run
at 1e-10; the time is that of `simulate` with a compiled model, best of three. The free vibration runs for 0.05 s. "Damped": fast
vibrations are damped. The last column marks cells where "auto" has more than twice the error of IDAS at the same tolerance, or
takes more than 4/3 of the time of the better of the other two (the faster one with at most twice the error of IDAS).
"""


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


def runs(scene: str, tolerances: list[float], around: int, known: dict[str, float]) -> Iterator[list[Run]]:
    """The three runs of each tolerance; `known` gets the uncertainty of the reference."""
    factors = 0.75 ** np.linspace(-1, 1, around) if around > 1 else np.ones(1)
    cls = models.SCENES[scene]
    stop_time, compiled = float(getattr(cls, "stop_time")) * PARTS.get(scene, 1.0), ac.compile(cls())  # noqa: B009
    exact, known[scene] = reference(compiled, stop_time)
    for tolerance in tolerances:
        near = [float(tolerance * factor) for factor in factors]
        found = [[measured(compiled, scene, stop_time, t, method, exact) for t in near] for method in METHODS]
        yield [typical(some, tolerance) for some in found]


def verdict(rosenbrock: Run, idas: Run, auto: Run) -> str:
    """What "auto" misses: at most twice the error of IDAS, at most a third more time than the better one."""
    fits = [run.seconds for run in (rosenbrock, idas) if run.error <= 2 * idas.error]
    # An error of 0 is that of the reference itself, with which nothing compares.
    worse = [f"error {auto.error / idas.error:.2g} times"] if auto.error > 2 * idas.error > 0 else []
    ratio = auto.seconds / min(fits, default=np.nan)
    return ", ".join([*worse, *([f"time {ratio:.2g} times"] if ratio > 4 / 3 else [])])


def short(number: float, form: str) -> str:
    """A number without the zeros of its exponent."""
    return re.sub(r"e([+-])0?", lambda e: "e-" if e[1] == "-" else "e", f"{number:{form}}")


def cells(row: list[Run]) -> list[str]:
    """Cells of the runs of a scene at a tolerance."""
    entries = [
        "-" if np.isnan(run.error) else f"{short(run.error, '.1e')}, {1e3 * run.seconds:.0f} ({run.steps:,})"
        for run in row
    ]
    damped = " damped" if row[-1].used.endswith("damped") else ""
    return [row[0].scene, short(row[0].tolerance, ".0e"), *entries[:-1], entries[-1] + damped, verdict(*row)]


def page(tolerances: str, rows: list[list[str]], known: dict[str, float]) -> str:
    """The table as a page of the documentation, each scene named once."""
    repeated = [["", *row[1:]] if k and row[0] == rows[k - 1][0] else row for k, row in enumerate(rows)]
    lines = [f"| {' | '.join(row)} |" for row in (HEAD, ["---"] * len(HEAD), *repeated)]
    uncertain = ", ".join(f"{scene} {short(value, '.1e')}" for scene, value in known.items() if not np.isnan(value))
    last = f"Uncertainty of the references (difference from IDAS at 1e-9): {uncertain}."
    return "\n".join([INTRODUCTION.format(tolerances=tolerances), *lines, "", last]) + "\n"


def main() -> None:
    """Print the table, or write it."""
    warnings.simplefilter("ignore")
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("scenes", nargs="*", default=list(models.SCENES))
    parser.add_argument("--tolerances", default="1e-3,1e-5,1e-7")
    parser.add_argument("--around", type=int, default=1, help="medians over so many tolerances beside each")
    parser.add_argument("--write", action="store_true", help=f"write {PAGE}")
    given = parser.parse_args()
    known: dict[str, float] = {}
    rows = []
    for scene in given.scenes:
        for row in runs(scene, [float(t) for t in given.tolerances.split(",")], given.around, known):
            rows.append(cells(row))
            print(*rows[-1], sep=" | ", flush=True)
    print(f"{sum(not row[-1] for row in rows)} of {len(rows)} cells keep what auto promises")
    if given.write:
        PAGE.write_text(page(given.tolerances, rows, known))


if __name__ == "__main__":
    main()
