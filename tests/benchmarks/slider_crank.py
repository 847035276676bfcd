"""Benchmark: the slider-crank compiled from general components, next to equations derived by hand.

    OPENBLAS_NUM_THREADS=1 python -m tests.benchmarks.slider_crank

The variable keeps other processes on the same cores from slowing small matrices down.
Three tables in one run: accuracy against time; size and time over the number of elements; how closed loops stay closed
(`loop_closing`). Times are the best of three. Errors are the largest of 401 points, as a fraction of the range, against the
converged model derived by hand and against the geometrically exact rod of `tests.benchmarks.exudyn`.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from typing import Any

import numpy as np
from rich.console import Console
from rich.table import Table

import acausal as ac
from models import SliderCrank
from tests.benchmarks import loop_closing, slider_crank_sizes
from tests.benchmarks.anew import run_anew
from tests.benchmarks.exudyn.cable import has_exudyn
from tests.benchmarks.exudyn.compare import exudyn_reference, own_reference
from tests.benchmarks.exudyn.scenes import SLIDER_CRANK
from tests.benchmarks.slider_crank_by_hand import build
from tests.benchmarks.slider_crank_methods import CONVERGED, INTERVALS, STOP, simulate

TOLERANCES = (1e-4, 1e-5, 1e-6)
RODS: tuple[dict[str, int], ...] = ({}, {"rod_volumes": 4})
REPEATS = 3
Curves = tuple[np.ndarray, np.ndarray]


@dataclass(frozen=True)
class Cost:
    """One run: time and counts; errors of slider and mid deflection; dissipated energy as a fraction of the supplied one.

    Attributes
    ----------
    own : (float, float)
        Against the solution of the same model that is converged in time.
    exact : (float, float)
        Against the geometrically exact solution.
    """

    name: str
    seconds: float
    steps: int
    factorisations: int
    own: tuple[float, float]
    exact: tuple[float, float]
    dissipated: float


def errors(curves: Curves, exact: Curves) -> tuple[float, float]:
    """Largest differences of slider position and mid deflection as a fraction of the range."""
    slider, middle = (float(np.abs(a - b).max() / np.ptp(b)) for a, b in zip(curves, exact, strict=True))
    return slider, middle


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
        outputs = exudyn_reference(SLIDER_CRANK)
        return (outputs["slider_position"], outputs["rod_mid_deflection"]), "Exudyn"
    return curves_of(own_reference(SLIDER_CRANK)), f"compiled, {SLIDER_CRANK.fine.name}"


def compiled_costs(
    options: dict[str, int], tolerances: Iterable[float], own: Curves, exact: Curves, repeats: int = REPEATS
) -> list[Cost]:
    """Run the scene with its defaults; a run of its own gives the energies."""
    model, costs = ac.compile(SliderCrank(**options)), []
    how: dict[str, Any] = {"stop_time": STOP, "intervals": INTERVALS}
    for tolerance in tolerances:
        runs = [run_anew(model, tolerance=tolerance, **how) for _ in range(repeats)]
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


def accuracy_table(costs: Iterable[Cost]) -> Table:
    """Table of accuracy against time."""
    table = Table("3 + 8 elements, tolerance", "ms", "steps", "factorisations")
    for name in ("slider, own", "mid, own", "slider, exact", "mid, exact", "dissipated"):
        table.add_column(name)
    for c in costs:
        row = [c.name, f"{1e3 * c.seconds:.0f}", str(c.steps), str(c.factorisations)]
        table.add_row(*row, *(f"{e:.1e}" for e in (*c.own, *c.exact, c.dissipated)))
    return table


def main() -> None:
    """Print the tables."""
    console = Console(width=140)
    exact, source = geometrically_exact()
    costs: list[Cost] = []
    for options in RODS:
        costs += compiled_costs(options, TOLERANCES, by_hand(**options), exact)
    console.print(accuracy_table(costs))
    console.print(f"own: the same model derived by hand, converged in time; exact: {source}")
    console.print(slider_crank_sizes.table(slider_crank_sizes.sizes()))
    console.print(slider_crank_sizes.LEGEND)
    console.print(loop_closing.table(loop_closing.rows()))
    console.print(loop_closing.LEGEND)


if __name__ == "__main__":
    main()
