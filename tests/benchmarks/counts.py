"""Steps, factorisations and residual evaluations of scenes, events, loops, published machines: recorded and compared.

    python -m tests.benchmarks.counts [NAME]... [--record]

Runs all machines, or those whose names begin with NAME, and prints the counts that differ from those in counts.json; `--record`
writes the counts there. Times are not compared: counts are the same on every machine.
"""

from __future__ import annotations

import argparse
import json
import warnings
from collections.abc import Callable, Iterator
from functools import partial
from pathlib import Path
from typing import Any

import acausal as ac
import models
from tests.benchmarks import loops
from tests.benchmarks.events import measure as events
from tests.benchmarks.exudyn import scenes as exudyn

FILE = Path(__file__).with_suffix(".json")
COUNTS = ("steps", "factorisations", "residual_evaluations")
METHODS, TOLERANCES = ("auto", "rosenbrock", "idas"), (1e-4, 1e-6)
SHORT = {"free-vibration": 0.5, "slider-crank": 0.2, "fe-plate": 0.2}  # stop times in s: a part shows the same
Run = Callable[[], ac.Result]


def runs() -> Iterator[tuple[str, Run]]:
    """Yield the name of each run, and the run."""
    for name, scene in models.SCENES.items():
        how = {"stop_time": SHORT[name]} if name in SHORT else {}
        yield from _each(name, lambda s=scene: ac.compile(s()), TOLERANCES, **how)
    for one in events.SCENES:
        yield from _each(f"events/{one.name}", lambda one=one: ac.compile(one.make()), TOLERANCES, **one.span(False))
    for name, machine in loops.SCENES.items():
        yield from _each(f"loops/{name}", lambda m=machine: ac.compile(m(N=25)), (1e-4,), stop_time=1.0, intervals=50)
    for scene in exudyn.SCENES:
        for curve in scene.curves:
            made = partial(lambda s, c: ac.compile(s.model(**c.options), c.parameters), scene, curve)
            name, how = f"exudyn/{scene.name}/{curve.name}", {"intervals": exudyn.INTERVALS}
            yield from _each(name, made, curve.tolerances[:3], (curve.method,), **how)


def _each(
    name: str, make: Callable[[], Any], tolerances: tuple[float, ...], methods: tuple[Any, ...] = METHODS, **how: Any
) -> Iterator[tuple[str, Run]]:
    """Yield the runs of a machine, which is compiled when the first of them is called."""
    made: list[Any] = []

    def run(method: Any, tolerance: float) -> ac.Result:
        made[:] = made or [make()]
        return ac.simulate(made[0], method=method, tolerance=tolerance, **how)

    for tolerance in tolerances:
        for method in methods:
            yield f"{name} {method} {tolerance:g}", partial(run, method, tolerance)


def counted(run: Run) -> list[int] | str:
    """Return the counts of a run, or the first line of what ended it."""
    try:
        stats = run().stats
    except ac.AcausalError as error:
        return str(error).partition("\n")[0]
    return [stats[name] for name in COUNTS]


def main() -> None:
    """Run, compare, and record if asked."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("names", nargs="*", metavar="NAME")
    parser.add_argument("--record", action="store_true")
    given = parser.parse_args()
    known = json.loads(FILE.read_text()) if FILE.exists() else {}
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        for name, run in runs():
            if given.names and not name.startswith(tuple(given.names)):
                continue
            found = counted(run)
            if found != known.get(name):
                print(f"{name}: {known.get(name)} -> {found}", flush=True)
            known[name] = found
    if given.record:
        lines = ",\n".join(f"{json.dumps(name)}: {json.dumps(found)}" for name, found in known.items())
        FILE.write_text(f"{{\n{lines}\n}}\n")


if __name__ == "__main__":
    main()
