"""Benchmark: how time and memory grow with the number of closed loops.

    python -m tests.benchmarks.loops [N ...]

N four-bars in a row, each coupled with the next, one freedom in all; and N of them that share only the ground, N freedoms.
Each runs 1 s at 1e-4 with 50 intervals in a process of its own; seconds are processor time, of compiling, of the first run,
which builds the integrator, and of the second one; memory is the peak. In brackets: over the next smaller N, where 2 is linear
for twice as many loops.
"""

from __future__ import annotations

import multiprocessing
import resource
import sys
import time
from typing import NamedTuple

from rich.console import Console
from rich.table import Table

import acausal as ac
from acausal import chain, fixed, parts
from components import BodyRod, Fixed, Revolute
from models import NFourBar

SIZES = (25, 50, 100, 200)


class Apart(NFourBar):
    """N parallelograms that share no upright."""

    @parts
    def ground(self):
        """Ground points, two for each."""
        return [Fixed(r=(i, 0, 0)) for i in range(2 * self.N)]

    @parts
    def foot(self):
        """Joints between ground and uprights; every other one holds the start."""
        return [Revolute(phi=fixed(0), w=fixed(-1)) if i % 2 == 0 else Revolute() for i in range(2 * self.N)]

    @parts
    def upright(self):
        """Uprights."""
        return [BodyRod(r=(0, 1, 0), m=1) for _ in range(2 * self.N)]

    def connections(self):
        for i in range(2 * self.N):
            yield chain(self.ground[i], self.foot[i], self.upright[i])
        for i in range(self.N):
            left, right = self.pin[2 * i : 2 * i + 2]
            yield chain(self.upright[2 * i], left, self.coupler[i], right, self.upright[2 * i + 1].frame_b)


SCENES = {"in a row": NFourBar, "apart": Apart}


class Cost(NamedTuple):
    """What compiling and running took."""

    unknowns: int
    compile: float
    first: float
    again: float
    megabytes: float
    steps: int


def measure(scene: str, n: int) -> Cost:
    """Compile and run twice in this process."""
    started = time.process_time()
    compiled = ac.compile(SCENES[scene](N=n))
    ready = time.process_time()
    steps = ac.simulate(compiled, stop_time=1.0, tolerance=1e-4, intervals=50).stats["steps"]
    once = time.process_time()
    ac.simulate(compiled, stop_time=1.0, tolerance=1e-4, intervals=50)
    twice = time.process_time()
    peak = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024
    return Cost(compiled.nx + compiled.nz, ready - started, once - ready, twice - once, peak, steps)


def main(sizes: tuple[int, ...] = SIZES) -> None:
    """Print the table."""
    table = Table("four-bars", "N", "unknowns", "compile s", "first run s", "next run s", "peak MB", "steps")
    for scene in SCENES:
        before: Cost | None = None
        for n in sizes:
            with multiprocessing.get_context("spawn").Pool(1) as pool:
                cost = pool.apply(measure, (scene, n))
            row = []
            for k, text in ((1, ".2f"), (2, ".2f"), (3, ".2f"), (4, ".0f")):
                ratio = f" ({cost[k] / before[k]:.1f})" if before else ""
                row.append(f"{cost[k]:{text}}{ratio}")
            table.add_row(scene, str(n), str(cost.unknowns), *row, str(cost.steps))
            before = cost
    Console(width=125).print(table)


if __name__ == "__main__":
    main(tuple(map(int, sys.argv[1:])) or SIZES)
