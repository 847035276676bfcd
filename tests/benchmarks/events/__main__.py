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
    f"as a fraction of its range, against the other method at {TIGHT:g} (the reference). CPU: least processor time of a run in "
    "ms, without compiling."
)
COLUMNS = ("method", "tol", "events", "outputs", "calls", "steps", "LU", "evaluations")


def chosen(names: list[str]) -> list[Scene]:
    """Scenes whose names contain one of these."""
    found = [s for s in SCENES if not names or any(n.lower() in s.name.lower() for n in names)]
    if not found:
        sys.exit(f"no scene is named so; scenes: {', '.join(s.name for s in SCENES)}")
    return found


def cells(row: Row) -> list[str]:
    """What the table says of a run that did not fail."""
    s = row.stats
    counts = [row.outputs, s["calls"], s["steps"], s["factorisations"], s["residual_evaluations"]]
    aims = [("calls", CALLS), ("steps", row.scene.steps)]
    ratios = [f"{row.per_event(n):.3g} {'>' if row.per_event(n) > aim else '≤'} {aim}" for n, aim in aims]
    events = f"{s['events']} + {len(s['break_times'])}"
    first = [row.method, f"{row.tolerance:.0e}", events]
    return [*first, *map(str, counts), *ratios, f"{1e3 * row.seconds:.0f}", number(row.error)]


def number(value: float | str) -> str:
    """A difference, or why there is none."""
    return value if isinstance(value, str) else f"{value:.1e}"


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
        table, rows = Table(*COLUMNS, *per, title=title, title_justify="left"), list(measure(scene, given.full))
        for row in rows:
            if not row.failure:
                table.add_row(*cells(row))
        console.print(
            table, *(f"{r.method}, {r.tolerance:.0e} failed: {r.failure}" for r in rows if r.failure), sep="\n"
        )
        console.print(f"The references differ by {number(rows[0].doubt)}.")
    console.print(LEGEND)


if __name__ == "__main__":
    main()
