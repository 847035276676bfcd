"""Exported scenes, run by fmpy, next to `simulate`: errors and processor times in one run, and what the export takes.

python -m tests.benchmarks.fmu [SCENE]... [--tolerance 1e-4] [--markdown]
"""

from __future__ import annotations

import argparse
import tempfile
import time
import warnings
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from fmpy import simulate_fmu
from rich import box
from rich.console import Console
from rich.table import Table

import acausal as ac
import models
from acausal.compiler import CompiledModel
from acausal.export import export_fmu
from acausal.policy import POLICY
from tests.benchmarks.anew import run_anew
from tests.benchmarks.methods import outputs, reference

# Of these, a part: free vibration is long, the parallelogram comes to lie flat, where two ways lead on.
STOPS = {"free-vibration": 0.05, "n-four-bar": 0.7}
# Without damping CVode keeps to its order of 5, which undamped vibrations make unstable: for Model Exchange they have some.
DAMPED = {
    "free-vibration": {"beam.beta": 1e-3},
    "pendulum": {"beam.beta": 1e-3},
    "slider-crank": {"crank_bar.beta": 1e-3, "rod_bar.beta": 1e-3},
}
LONGEST = 30.0  # seconds of a run by fmpy
HEAD = (
    "scene",
    "kB",
    "s to export",
    *(f"{w} {h}" for h in ("simulate", "Co-Simulation", "Model Exchange") for w in ("error", "ms")),
)
LEGEND = (
    "Error: largest over all outputs, as a fraction of the range of each, against a converged run. ms: processor time, the "
    "second run; `simulate` with its steps and method, that of fmpy with unpacking and reading the file. 401 outputs. "
    "Model Exchange: CVode of fmpy; *: beams with beta=1e-3, errors against a run with that."
)


@dataclass(frozen=True)
class Cost:
    """Error and seconds of a run; what it says of itself."""

    error: float
    seconds: float
    note: str = ""

    @property
    def cells(self) -> tuple[str, str]:
        """Error and milliseconds."""
        if np.isnan(self.seconds):
            return self.note, ""
        return f"{self.error:.1e}", f"{1e3 * self.seconds:,.0f}{self.note}"


def second(run: Callable[[], Any]) -> tuple[Any, float]:
    """What the second of two runs gives, and its processor time."""
    run()
    begun = time.process_time()
    found = run()
    return found, time.process_time() - begun


def distance(values: np.ndarray, exact: np.ndarray) -> float:
    """Largest distance of any output, as a fraction of its range."""
    return float(np.max(np.max(np.abs(values - exact), axis=0) / np.maximum(np.ptp(exact, axis=0), 1e-12)))


def simulated(compiled: CompiledModel, stop: float, tolerance: float, exact: np.ndarray) -> Cost:
    """The run of acausal itself."""
    result, seconds = second(lambda: run_anew(compiled, stop_time=stop, tolerance=tolerance))
    stats = result.stats
    return Cost(
        distance(outputs(result), exact),
        seconds,
        f" ({stats.steps:,} {stats.method}{', damped' if stats.damped else ''})",
    )


def imported(path: Path, kind: str, stop: float, tolerance: float, exact: np.ndarray) -> Cost:
    """A run by fmpy."""

    def run() -> Any:
        return simulate_fmu(
            str(path),
            fmi_type=kind,
            stop_time=stop,
            output_interval=stop / POLICY.defaults.intervals,
            relative_tolerance=tolerance,
            record_events=False,
            timeout=LONGEST,
        )

    try:
        found, seconds = second(run)
    except Exception as failure:  # fmpy raises no narrower class
        return Cost(np.nan, np.nan, f"failed: {str(failure)[:40]}")
    values = np.column_stack([found[name] for name in found.dtype.names if name != "time"])
    if len(values) < len(exact):
        return Cost(np.nan, np.nan, f"more than {LONGEST:g} s")
    return Cost(distance(values, exact), seconds)


def row(scene: str, tolerance: float, folder: Path) -> list[str]:
    """All of a scene."""
    cls = models.SCENES[scene]
    compiled, stop = ac.compile(cls()), STOPS.get(scene) or float(getattr(cls, "stop_time"))  # noqa: B009
    path = folder / f"{scene}.fmu"
    begun = time.process_time()
    export_fmu(compiled, path)
    took, size = time.process_time() - begun, path.stat().st_size
    exact, _ = reference(compiled, stop)
    runs = [
        simulated(compiled, stop, tolerance, exact),
        imported(path, "CoSimulation", stop, tolerance, exact),
    ]
    if scene in DAMPED:
        compiled = ac.compile(cls(), parameters=DAMPED[scene])
        export_fmu(compiled, path)
        exact, _ = reference(compiled, stop)
    runs.append(imported(path, "ModelExchange", stop, tolerance, exact))
    cells = [cell for run in runs for cell in run.cells]
    return [scene, f"{size / 1e3:,.0f}", f"{took:.2f}", *cells[:-1], cells[-1] + "*" * (scene in DAMPED)]


def main() -> None:
    """Print the table."""
    warnings.simplefilter("ignore")
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("scenes", nargs="*", default=list(models.SCENES))
    parser.add_argument("--tolerance", type=float, default=1e-4)
    parser.add_argument("--markdown", action="store_true", help="table in Markdown")
    given = parser.parse_args()
    table = Table(*HEAD, box=box.MARKDOWN if given.markdown else box.HEAVY_HEAD)
    with tempfile.TemporaryDirectory() as folder:
        for scene in given.scenes:
            table.add_row(*row(scene, given.tolerance, Path(folder)))
    Console(width=220).print(table, LEGEND)


if __name__ == "__main__":
    main()
