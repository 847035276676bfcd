"""Size and time of the compiled slider-crank over the number of elements, next to the index-1 DAE derived by hand.

Both sides are integrated by the same method (Rosenbrock), with the same tolerance, the same size of coordinates and
rates in the error test, the same first step and the same outputs.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass

import casadi as ca
import numpy as np
from rich.table import Table

import acausal as ac
from acausal.compiler import CompiledModel
from acausal.compiler.core_equations import core_equations
from models import SliderCrank
from tests.benchmarks.anew import run_anew
from tests.benchmarks.slider_crank_by_hand import HandModel, build
from tests.benchmarks.slider_crank_methods import INTERVALS, STOP, SWITCH, Method, fastest, simulate

CRANKS, RODS = ("rigid", "elastic"), (2, 4, 8, 16, 32)
TOLERANCE, REPEATS = 1e-5, 5
LEGEND = (
    f"Rosenbrock method, tolerance {TOLERANCE:g}; compiled / by hand, best of {REPEATS}. "
    "Residuals: evaluations of the right-hand side. "
    "us a residual: integration time over residuals. Integration: the calls of the integrator alone; solve: with "
    "what is done in Python before and after them, which the hand's time leaves out."
)


@dataclass(frozen=True)
class Side:
    """One way to the same mechanism."""

    states: int
    unknowns: int
    operations: int
    nonzeros: int
    steps: int
    factorisations: int
    residuals: int
    integration: float
    solve: float


def counts(integrator: ca.Function) -> tuple[int, int]:
    """Operations of a residual, nonzeros of its Jacobian."""
    residual, jacobian = integrator.get_function("daeF"), integrator.get_function("jacF")
    moved = sum(residual.nnz_in(k) for k in range(residual.n_in())) + residual.nnz_out(0) + residual.nnz_out(1)
    return residual.n_instructions() - moved, sum(jacobian.nnz_out(k) for k in range(jacobian.n_out()))


def compiled_side(model: CompiledModel, repeats: int) -> tuple[Side, ac.Result]:
    """Run the compiled scene."""
    how = {"stop_time": STOP, "intervals": INTERVALS, "tolerance": TOLERANCE, "method": "rosenbrock"}
    runs = [run_anew(model, **how) for _ in range(repeats)]
    best = min(runs, key=lambda r: r.stats["integration_seconds"]).stats
    solve = min(r.stats["solve_seconds"] for r in runs)
    equations = core_equations(model, False)
    side = Side(
        model.nx,
        model.nz,
        len(equations.values.first),
        len(equations.row),
        best["steps"],
        best["factorisations"],
        best["residual_evaluations"],
        best["integration_seconds"],
        solve,
    )
    return side, runs[0]


def hand_side(model: HandModel, repeats: int) -> tuple[Side, np.ndarray]:
    """Run the equations derived by hand, begun with steps like those that the engine chooses."""
    first = 10.0 ** -np.ceil(np.log10(fastest(model) * SWITCH)) * SWITCH
    run = simulate(model, Method("rosenbrock", TOLERANCE, options=(("step0", first),)), repeats)
    x, z = model.dae["x"].numel(), model.dae["z"].numel()
    done = run.steps, run.factorisations, run.residual_evaluations
    return Side(
        x,
        z,
        *counts(ca.integrator("hand", "rosenbrock", model.dae, 0.0, [1.0])),
        *done,
        run.solve_seconds,
        run.solve_seconds,
    ), run.outputs


@dataclass(frozen=True)
class Size:
    """Both sides of one size, and how far they differ: slider position as a fraction of its range."""

    crank: str
    rod_elements: int
    ours: Side
    mark: Side
    difference: float


def sizes(cranks: Iterable[str] = CRANKS, rods: Iterable[int] = RODS, repeats: int = REPEATS) -> list[Size]:
    """Run both sides of all sizes; one that fails is told and left out."""
    found, rods = [], tuple(rods)
    for crank in cranks:
        for n in rods:
            try:
                ours, result = compiled_side(ac.compile(SliderCrank(crank=crank, rod_elements=n)), repeats)
            except ac.AcausalError as error:
                print(f"crank {crank}, rod of {n} elements: {str(error).partition(chr(10))[0]}")
                continue
            mark, outputs = hand_side(build(crank, rod_elements=n), repeats)
            difference = np.abs(result["slider_position"] - outputs[1]).max() / np.ptp(outputs[1])
            found.append(Size(crank, n, ours, mark, float(difference)))
    return found


def table(found: Iterable[Size]) -> Table:
    """Compiled / by hand."""
    columns = ("states", "unknowns", "operations", "nonzeros", "steps", "residuals")
    out = Table("crank", "rod", *columns, padding=(0, 0))
    for name in ("us a residual", "integration ms", "ratio", "solve ms", "ratio"):
        out.add_column(name)
    for s in found:
        pairs = [f"{getattr(s.ours, c)} / {getattr(s.mark, c)}" for c in columns]
        each = [f"{1e6 * side.integration / side.residuals:.0f}" for side in (s.ours, s.mark)]
        out.add_row(
            s.crank,
            str(s.rod_elements),
            *pairs,
            " / ".join(each),
            f"{1e3 * s.ours.integration:.0f} / {1e3 * s.mark.integration:.0f}",
            f"{s.ours.integration / s.mark.integration:.2f}",
            f"{1e3 * s.ours.solve:.0f}",
            f"{s.ours.solve / s.mark.solve:.2f}",
        )
    return out
