"""Benchmark: what events cost, in calls of the integrator, steps and processor time.

    OPENBLAS_NUM_THREADS=1 python -m tests.benchmarks.events [--full] [SCENE]...

Scenes are named by a part of their names; all of them if none is named. Short runs take three minutes in all, `--full` runs
the whole time of each scene.
"""

from __future__ import annotations

import argparse
import sys

from rich.console import Console
from rich.table import Table

from tests.benchmarks.events.measure import CALLS, SCENES, TIGHT, Row, Scene, measure

LEGEND = (
    "Events: searched or planned ones + break times; per event: of both, with what is aimed at. Error: largest of an output, "
    f"as a fraction of its range, against the other method at {TIGHT:g}. CPU: least processor time of a run, in ms."
)
COLUMNS = ("method", "tol", "events", "outputs", "calls", "steps", "LU", "evaluations")


def chosen(names: list[str]) -> list[Scene]:
    """Scenes whose names contain one of these."""
    found = [s for s in SCENES if not names or any(n.lower() in s.name.lower() for n in names)]
    if not found:
        sys.exit(f"no scene is named so; scenes: {', '.join(s.name for s in SCENES)}")
    return found


def cells(row: Row) -> list[str]:
    """What the table says of a run."""
    first = [row.method, f"{row.tolerance:.0e}"]
    if row.failure:
        return [*first, f"failed: {row.failure}"]
    s = row.stats
    counts = [row.outputs, s["calls"], s["steps"], s["factorisations"], s["residual_evaluations"]]
    aims = [("calls", CALLS), ("steps", row.scene.steps)]
    ratios = [f"{row.per_event(n):.3g} {'>' if row.per_event(n) > aim else '≤'} {aim}" for n, aim in aims]
    error = row.error if isinstance(row.error, str) else f"{row.error:.1e}"
    events = f"{s['events']} + {len(s['break_times'])}"
    return [*first, events, *map(str, counts), *ratios, f"{1e3 * row.seconds:.0f}", error]


def main() -> None:
    """Print a table for each scene."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").splitlines()[0])
    parser.add_argument("scene", nargs="*", help="part of the name of a scene")
    parser.add_argument("--full", action="store_true", help="run the whole time of each scene")
    given = parser.parse_args()
    console = Console(width=130)
    for scene in chosen(given.scene):
        span = scene.span(given.full)
        title = f"{scene.name}, {span['stop_time']:g} s"
        per = [f"calls / {scene.unit}", f"steps / {scene.unit}", "CPU", "error"]
        table, failures = Table(*COLUMNS, *per, title=title, title_justify="left"), []
        for row in measure(scene, given.full):
            if row.failure:
                failures.append(f"{row.method}, {row.tolerance:.0e}: {row.failure}")
            else:
                table.add_row(*cells(row))
        console.print(table, *failures)
    console.print(LEGEND)


if __name__ == "__main__":
    main()
