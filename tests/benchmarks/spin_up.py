"""Benchmark: the compiled spin-up against the same equations derived by hand, in one run.

    python -m tests.benchmarks.spin_up

Both integrate 20 s at omega = 10 rad/s with 401 points, initialisation included, best of some runs; once with IDAS and
equal absolute weights, and once on the core. The hand-derived side knows its order limit; the compiled one finds it, and
its time is that of the whole call of `simulate` on a model that has run before: `time` with parameters that differ from those
of the last run by a rounding error, which is to start anew, `again` with the same parameters.
"""

from __future__ import annotations

import math
import time
from typing import Any

import numpy as np
from rich.console import Console
from rich.table import Table

import acausal as ac
from acausal.compiler.core_equations import core_equations
from models import SpinUp
from tests.benchmarks import spin_up_by_hand as hand

VOLUMES = (5, 10, 20, 40, 80)
TOLERANCES = (1e-4, 1e-6)
REPEATS = 15


def best(compiled: ac.CompiledModel, tolerance: float, method: Any) -> tuple[ac.Result, float, float]:
    """A run, and the seconds of the fastest of some: with other parameters than the run before it, and with the same."""
    seconds: dict[bool, list[float]] = {True: [], False: []}
    before = None
    for omega in [10.0, 10.0, *[np.nextafter(10.0, 11.0), np.nextafter(10.0, 11.0), 10.0, 10.0] * (REPEATS // 2)]:
        started = time.perf_counter()
        result = ac.simulate(
            compiled, stop_time=20.0, tolerance=tolerance, method=method, parameters={"omega": float(omega)}
        )
        if before is not None:
            seconds[omega == before].append(time.perf_counter() - started)
        before = omega
    return result, min(seconds[False]), min(seconds[True])


def main() -> None:
    """Print the tables and the growth exponents."""
    by_idas = Table(
        "tolerance", "volumes", "unknowns", "steps", "factorisations", "residuals", "nonzeros", "time", "again"
    )
    on_core = Table(
        *("tolerance", "volumes", "steps", "factorisations", "residuals", "time", "again"),
        *("time / IDAS by hand", "again / IDAS by hand"),
    )
    compile_seconds: dict[int, float] = {}
    solve: dict[tuple[float, int], float] = {}
    ac.compile(SpinUp(volumes=2))  # derives the element integrals
    for volumes in VOLUMES:
        compiled = ac.compile(SpinUp(volumes=volumes, omega=10.0))
        compile_seconds[volumes] = sum(compiled.seconds.values())
        by_hand = hand.build(volumes, 10.0)
        for tolerance in TOLERANCES:
            first = [f"{tolerance:g}", str(volumes)]
            ours, new, again = best(compiled, tolerance, "idas")
            mark = hand.simulate(by_hand, tolerance, repeats=REPEATS)
            nonzeros = core_equations(compiled, False).row.size
            pairs = [
                (ours.stats["algebraic"], by_hand.n_algebraic),
                *_counts(ours, mark),
                (nonzeros, mark.jacobian_nonzeros),
            ]
            ratios = [seconds / mark.solve_seconds for seconds in (new, again)]
            by_idas.add_row(*first, *(f"{a} / {b}" for a, b in pairs), *(f"{r:.2f}" for r in ratios))

            core, new, again = best(compiled, tolerance, "auto")
            core_mark = hand.simulate_on_core(by_hand, tolerance, repeats=REPEATS)
            solve[tolerance, volumes] = new
            ratios = [seconds / other.solve_seconds for other in (core_mark, mark) for seconds in (new, again)]
            on_core.add_row(*first, *(f"{a} / {b}" for a, b in _counts(core, core_mark)), *(f"{r:.2f}" for r in ratios))
    console = Console(width=125)
    console.print("IDAS, compiled / by hand", by_idas)
    console.print("The core, compiled / by hand", on_core)
    for tolerance in TOLERANCES:
        console.print(
            f"growth of time on the core at {tolerance:g}: {_exponent(solve[tolerance, 10], solve[tolerance, 80]):.2f}"
        )
    console.print(f"growth of compile time: {_exponent(compile_seconds[10], compile_seconds[80]):.2f}")
    console.print("compile seconds: " + ", ".join(f"{n} volumes {s:.2f}" for n, s in compile_seconds.items()))


def _counts(ours: ac.Result, mark: hand.HandRun) -> list[tuple[int, int]]:
    names = ("steps", "factorisations", "residual_evaluations")
    return [(ours.stats[name], getattr(mark, name)) for name in names]


def _exponent(at_10: float, at_80: float) -> float:
    return math.log(at_80 / at_10) / math.log(8)


if __name__ == "__main__":
    main()
