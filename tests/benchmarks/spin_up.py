"""Benchmark: the compiled spin-up against the same equations derived by hand, in one run.

    python -m tests.benchmarks.spin_up

Both integrate 20 s at omega = 10 rad/s with IDAS, equal absolute weights, 401 points, initialisation included, best of
three. The hand-derived side knows its order limit; the compiled one finds it.
"""

from __future__ import annotations

import math

from rich.console import Console
from rich.table import Table

import acausal as ac
from models import SpinUp
from tests.benchmarks import spin_up_by_hand as hand

VOLUMES = (5, 10, 20, 40, 80)
TOLERANCES = (1e-4, 1e-6)
REPEATS = 3


def main() -> None:
    """Print the table and the growth exponents."""
    table = Table("tolerance", "volumes", "unknowns", "steps", "factorisations", "residuals", "nonzeros", "time ratio")
    compile_seconds: dict[int, float] = {}
    solve: dict[tuple[float, int], float] = {}
    ac.compile(SpinUp(volumes=2))  # derives the element integrals
    for volumes in VOLUMES:
        compiled = ac.compile(SpinUp(volumes=volumes, omega=10.0))
        by_hand = hand.build(volumes, 10.0)
        for tolerance in TOLERANCES:
            runs = [ac.simulate(compiled, stop_time=20.0, tolerance=tolerance, method="idas") for _ in range(REPEATS)]
            ours = min(runs, key=lambda run: run.stats["solve_seconds"])
            mark = hand.simulate(by_hand, tolerance, repeats=REPEATS)
            compile_seconds.setdefault(volumes, ours.stats["compile_seconds"])
            solve[tolerance, volumes] = ours.stats["solve_seconds"]
            blocks = list(compiled.integrators.values())[-1].function.get_function("jacF")
            nonzeros = sum(blocks.nnz_out(k) for k in range(blocks.n_out()))
            pairs = [
                (ours.stats["algebraic"], by_hand.n_algebraic),
                (ours.stats["steps"], mark.steps),
                (ours.stats["factorisations"], mark.factorisations),
                (ours.stats["residual_evaluations"], mark.residual_evaluations),
                (nonzeros, mark.jacobian_nonzeros),
            ]
            ratio = ours.stats["solve_seconds"] / mark.solve_seconds
            table.add_row(f"{tolerance:g}", str(volumes), *(f"{a} / {b}" for a, b in pairs), f"{ratio:.2f}")
    console = Console(width=125)
    console.print(table, "compiled / by hand; time: initialisation, choice of the order and integration")
    for tolerance in TOLERANCES:
        console.print(
            f"growth of solve time at {tolerance:g}: {_exponent(solve[tolerance, 10], solve[tolerance, 80]):.2f}"
        )
    console.print(f"growth of compile time: {_exponent(compile_seconds[10], compile_seconds[80]):.2f}")
    console.print("compile seconds: " + ", ".join(f"{n} volumes {s:.2f}" for n, s in compile_seconds.items()))


def _exponent(at_10: float, at_80: float) -> float:
    return math.log(at_80 / at_10) / math.log(8)


if __name__ == "__main__":
    main()
