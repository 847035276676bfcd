"""Benchmark: the slider-crank compiled from general components, next to Exudyn and to equations derived by hand.

    OPENBLAS_NUM_THREADS=1 python -m tests.benchmarks.slider_crank

The variable keeps other processes on the same cores from slowing small matrices down.
Three tables in one run: accuracy against time; size and time over the number of elements; how closed loops stay closed
(`loop_closing`). Times are the best of three. Errors are the largest of 401 points, in parts of the range.
Exudyn is optional: pip install ".[benchmark]".
"""

from __future__ import annotations

import importlib.util
from collections.abc import Callable, Iterable
from dataclasses import dataclass
from typing import Any

import numpy as np
from rich.console import Console
from rich.table import Table

import acausal as ac
from models import SliderCrank
from tests.benchmarks import loop_closing, slider_crank_exudyn, slider_crank_sizes
from tests.benchmarks.slider_crank_by_hand import build
from tests.benchmarks.slider_crank_methods import CONVERGED, INTERVALS, STOP, simulate

TOLERANCES, STEPS = (1e-4, 1e-5, 1e-6), (2e-3, 2e-4)
RODS: tuple[dict[str, int], ...] = ({}, {"rod_volumes": 4})
REPEATS = 3
# Agrees with the converged run of Exudyn within 4e-5 (slider) and 3e-3 (mid deflection).
FINE = {"crank_elements": 6, "rod_elements": 32, "rod_volumes": 8}
Curves = tuple[np.ndarray, np.ndarray]


@dataclass(frozen=True)
class Cost:
    """One run: time and counts; errors of slider and mid deflection; dissipated energy in parts of the supplied one.

    Attributes
    ----------
    own : (float, float), optional
        Against the solution of the same model that is converged in time.
    exact : (float, float)
        Against the geometrically exact solution.
    """

    name: str
    seconds: float
    steps: int
    factorisations: int
    own: tuple[float, float] | None
    exact: tuple[float, float]
    dissipated: float | None


def has_exudyn() -> bool:
    """Whether the other program is there."""
    return importlib.util.find_spec("exudyn") is not None


def errors(curves: Curves, exact: Curves) -> tuple[float, float]:
    """Largest differences of slider position and mid deflection in parts of the range."""
    slider, middle = (float(np.abs(a - b).max() / np.ptp(b)) for a, b in zip(curves, exact, strict=True))
    return slider, middle


def fastest(run: Callable[[], Any], seconds: Callable[[Any], float], repeats: int) -> Any:
    """Return the run that took the least time."""
    return min((run() for _ in range(repeats)), key=seconds)


def curves_of(result: ac.Result) -> Curves:
    """Slider position and mid deflection."""
    return result["slider_position"], result["rod_mid_deflection"]


def by_hand(**options: int) -> Curves:
    """Solution of the equations derived by hand, converged in time."""
    outputs = simulate(build(**options), CONVERGED).outputs
    return outputs[1], outputs[3]


def geometrically_exact() -> tuple[Curves, str]:
    """Converged solution of the exact rod, and where it comes from."""
    if has_exudyn():
        run = slider_crank_exudyn.reference(slider_crank_exudyn.REFERENCE)
        fine = slider_crank_exudyn.CONVERGED
        what = f"Exudyn, {fine['crank_elements']} + {fine['rod_elements']} elements, step {fine['step']:g} s"
        return (run.slider, run.middle), what
    result = ac.simulate(SliderCrank(**FINE), stop_time=STOP, tolerance=1e-6, intervals=INTERVALS, method="rosenbrock")
    return curves_of(result), f"compiled, {FINE}, tolerance 1e-6"


def compiled_costs(
    options: dict[str, int], tolerances: Iterable[float], own: Curves, exact: Curves, repeats: int = REPEATS
) -> list[Cost]:
    """Run the scene with its defaults; a run of its own gives the energies."""
    model, costs = ac.compile(SliderCrank(**options)), []
    how: dict[str, Any] = {"stop_time": STOP, "intervals": INTERVALS}
    for tolerance in tolerances:
        runs = [ac.simulate(model, tolerance=tolerance, **how) for _ in range(repeats)]
        stats = min((r.stats for r in runs), key=lambda s: s["solve_seconds"])
        energy = ac.simulate(model, tolerance=tolerance, energy=True, **how).stats
        curves = curves_of(runs[0])
        costs.append(
            Cost(
                f"compiled, {options.get('rod_volumes', 1)} x {8 // options.get('rod_volumes', 1)}, {tolerance:g}",
                stats["solve_seconds"],
                stats["steps"],
                stats["factorisations"],
                errors(curves, own),
                errors(curves, exact),
                energy["energy_method"] / energy["energy_supplied"],
            )
        )
    return costs


def exudyn_costs(steps: Iterable[float], exact: Curves, repeats: int = REPEATS) -> list[Cost]:
    """Run the other program."""
    costs = []
    for step in steps:
        run = fastest(
            lambda step=step: slider_crank_exudyn.simulate(slider_crank_exudyn.build(3, 8), step),
            lambda run: run.solve_seconds,
            repeats,
        )
        error = errors((run.slider, run.middle), exact)
        costs.append(
            Cost(f"Exudyn, step {step:g} s", run.solve_seconds, run.steps, run.factorisations, None, error, None)
        )
    return costs


def accuracy_table(costs: Iterable[Cost]) -> Table:
    """Table of accuracy against time."""
    table = Table("3 + 8 elements, tolerance", "ms", "steps", "factorisations")
    for name in ("slider, own", "mid, own", "slider, exact", "mid, exact", "dissipated"):
        table.add_column(name)
    for c in costs:
        own = [f"{e:.1e}" for e in c.own] if c.own else ["", ""]
        row = [c.name, f"{1e3 * c.seconds:.0f}", str(c.steps), str(c.factorisations), *own]
        table.add_row(*row, *(f"{e:.1e}" for e in c.exact), "" if c.dissipated is None else f"{c.dissipated:.1e}")
    return table


def main() -> None:
    """Print the tables."""
    console = Console(width=140)
    exact, source = geometrically_exact()
    costs: list[Cost] = []
    for options in RODS:
        costs += compiled_costs(options, TOLERANCES, by_hand(**options), exact)
    if has_exudyn():
        costs += exudyn_costs(STEPS, exact)
    console.print(accuracy_table(costs))
    console.print(f"own: the same model derived by hand, converged in time; exact: {source}")
    if not has_exudyn():
        console.print('Exudyn is not installed, so it is missing: pip install ".[benchmark]"')
    console.print(slider_crank_sizes.table(slider_crank_sizes.sizes()))
    console.print(slider_crank_sizes.LEGEND)
    console.print(loop_closing.table(loop_closing.rows()))
    console.print(loop_closing.LEGEND)


if __name__ == "__main__":
    main()
