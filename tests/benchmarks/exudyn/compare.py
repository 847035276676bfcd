"""Run both programs on one scene: references, errors, times."""

from __future__ import annotations

import tempfile
import time
from collections.abc import Callable, Iterable
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

import acausal as ac
from tests.benchmarks.anew import run_anew
from tests.benchmarks.exudyn.cable import Outputs, Run, simulate
from tests.benchmarks.exudyn.scenes import INTERVALS, Curve, Scene

EXUDYN = "Exudyn"
SHARED = 1e-3  # intervals between a time of a run and one of the reference that are the same


@dataclass(frozen=True)
class Point:
    """One run.

    Attributes
    ----------
    curve, setting : str
        What was run, and its tolerance or step.
    seconds, again : float
        CPU time of the solve, best of the repeats; and of ours where the run before had the same parameters, whose start it
        takes.
    errors : dict of str to float
        Largest error of each output against the reference, over the reference's range.
    steps, factorisations, evaluations : int
        Evaluations: of the residual; for Exudyn: Newton iterations.
    method : str
        What integrated.
    """

    curve: str
    setting: str
    seconds: float
    again: float
    errors: dict[str, float]
    steps: int
    factorisations: int
    evaluations: int
    method: str


@dataclass(frozen=True)
class Reference:
    """Converged outputs by Exudyn, and how far our own converged ones are from them."""

    outputs: Outputs
    apart: dict[str, float]


def errors_of(outputs: Outputs, times: np.ndarray, reference: Outputs, names: Iterable[str]) -> dict[str, float]:
    """Largest error of each output at the times that both have, over the reference's range.

    The reference has INTERVALS + 1 rows. Points have three columns: their error is a distance, their range that of the
    coordinate which varies most.
    """
    places = times / times[-1] * INTERVALS
    rows = np.rint(places).astype(int)
    both = np.abs(places - rows) < SHARED
    found = {}
    for name in names:
        exact = reference[name].reshape(INTERVALS + 1, -1)
        apart = outputs[name].reshape(len(times), -1)[both] - exact[rows[both]]
        found[name] = float(np.linalg.norm(apart, axis=1).max() / np.ptp(exact, axis=0).max())
    return found


def exudyn_reference(scene: Scene, folder: Path | None = None) -> Outputs:
    """Converged outputs by Exudyn, kept in a file of the temporary directory and made where it is missing."""
    path = (folder or Path(tempfile.gettempdir())) / f"exudyn {scene.name.replace('/', ' per ')}.npz"
    if not path.exists():
        build, how = scene.exact
        found: dict[str, Any] = simulate(build(how), how, INTERVALS).outputs
        np.savez(path, **found)
    with np.load(path) as kept:
        return {name: kept[name] for name in kept.files}


def own_reference(scene: Scene) -> ac.Result:
    """Our own converged solution."""
    curve = scene.fine
    model = scene.model(**curve.options)
    how = {"tolerance": curve.tolerances[0], "intervals": INTERVALS, "method": curve.method}
    return ac.simulate(model, stop_time=model.stop_time, parameters=curve.parameters, **how)


def reference(scene: Scene) -> Reference:
    """Make or read the reference and compare it with our own."""
    outputs, own = exudyn_reference(scene), own_reference(scene)
    return Reference(outputs, errors_of(scene.of(own), own.time, outputs, scene.outputs))


def ours(scene: Scene, curve: Curve, exact: Outputs, repeats: int) -> list[Point]:
    """Run one of our models, compiled once, at its tolerances; one that fails ends the curve."""
    model = scene.model(**curve.options)
    compiled, points = ac.compile(model, curve.parameters), []
    for tolerance in curve.tolerances:
        how = {
            "stop_time": model.stop_time,
            "tolerance": tolerance,
            "intervals": INTERVALS,
            "method": curve.method,
        }
        try:
            runs = [
                [_timed(lambda run=run, how=how: run(compiled, **how)) for run in (run_anew, ac.simulate)]
                for _ in range(repeats)
            ]
        except ac.AcausalError as error:
            print(f"{scene.name}, {curve.name}, {tolerance:g}: {str(error).partition(chr(10))[0]}")
            break
        result = runs[-1][0][0]
        stats = result.stats
        errors = errors_of(scene.of(result), result.time, exact, scene.outputs)
        counts = stats["steps"], stats["factorisations"], stats["residual_evaluations"]
        anew, again = (min(seconds for _, seconds in one) for one in zip(*runs, strict=True))
        points.append(Point(curve.name, f"{tolerance:g}", anew, again, errors, *counts, stats["method"]))
    return points


def _timed(run: Callable[[], ac.Result]) -> tuple[ac.Result, float]:
    """Run, and tell the CPU seconds; the first run of a setting builds its integrators as well."""
    begun = time.process_time()
    result = run()
    return result, time.process_time() - begun


def theirs(scene: Scene, exact: Outputs, repeats: int) -> list[Point]:
    """Run Exudyn at its settings; one at which its Newton iteration fails is left out."""
    from exudyn.exudynCPP import SolverError

    points = []
    for how in scene.settings:
        try:
            runs = [simulate(scene.build(how), how, INTERVALS) for _ in range(repeats)]
        except SolverError:
            print(f"{scene.name}, {EXUDYN}, {how.label}: no convergence")
            continue
        best: Run = min(runs, key=lambda run: run.seconds)
        errors = errors_of(best.outputs, best.times, exact, scene.outputs)
        counts = best.steps, best.factorisations, best.iterations
        points.append(Point(EXUDYN, how.label, best.seconds, best.seconds, errors, *counts, "generalised-alpha"))
    return points


def front(points: Iterable[Point], output: str) -> list[Point]:
    """The points that no other beats in both time and error, from the quickest on."""
    best, found = np.inf, []
    for point in sorted(points, key=lambda p: p.seconds):
        if point.errors[output] < best:
            best = point.errors[output]
            found.append(point)
    return found


def quickest(points: Iterable[Point], output: str, error: float) -> Point | None:
    """The quickest point within an error."""
    return min((p for p in points if p.errors[output] <= error), key=lambda p: p.seconds, default=None)
