"""Benchmark: processor time and memory of compiling, against the size of the model.

    python -m tests.benchmarks.compile
    python -m tests.benchmarks.compile --large

The spin-up with a beam of more and more volumes, and a chain of rigid rods with revolute joints. Every model is compiled in
a process of its own, after a small one, which loads what is loaded once. The peak is that of the whole process.
"""

from __future__ import annotations

import json
import resource
import subprocess
import sys
import time
from typing import Any
from unittest.mock import patch

from rich.console import Console
from rich.table import Table

import acausal as ac
from components import BodyRod, Revolute, World
from models import SpinUp

STAGES = ("flatten", "analyse", "reduce", "generate")
SIZES = {"volumes": (10, 80), "bodies": (10, 100)}
LARGE = {"volumes": (10, 80, 1000), "bodies": (10, 100, 500)}
SMALL = 2


class RodChain(ac.Model):
    """A chain of rods that hangs from the world."""

    bodies: int = ac.structural("number of rods", default=SMALL, minimum=1)
    world = World()

    @ac.parts
    def joint(self):
        """Joints, one before each rod."""
        return [Revolute() for _ in range(self.bodies)]

    @ac.parts
    def rod(self):
        """Rods of 1 m and 1 kg."""
        return [BodyRod(r=(1, 0, 0), m=1) for _ in range(self.bodies)]

    def connections(self):
        links = zip(self.joint, self.rod, strict=True)
        yield ac.chain(self.world, *[part for link in links for part in link])


def model(kind: str, size: int) -> ac.Model:
    """Return the model of a kind and a size."""
    return SpinUp(volumes=size) if kind == "volumes" else RodChain(bodies=size)


def measure(kind: str, size: int) -> dict[str, Any]:
    """Compile a model in this process; return its equations, seconds of processor time by stage, and the peak in MB."""
    with patch("time.perf_counter", time.process_time):
        ac.compile(model(kind, SMALL))
        compiled = ac.compile(model(kind, size))
    peak = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / (2**20 if sys.platform == "darwin" else 2**10)
    return {"equations": compiled.nx + compiled.nz, "peak": peak, **compiled.seconds}


def apart(kind: str, size: int) -> dict[str, Any]:
    """Measure in a process of its own."""
    command = [sys.executable, "-m", "tests.benchmarks.compile", kind, str(size)]
    return json.loads(subprocess.run(command, check=True, capture_output=True, text=True).stdout)


def main() -> None:
    """Print the table."""
    table = Table("model", "equations", *STAGES, "all, s", "peak, MB", "size", "all")
    for kind, sizes in (LARGE if "--large" in sys.argv else SIZES).items():
        before = None
        for size in sizes:
            found = apart(kind, size)
            total = sum(found[stage] for stage in STAGES)
            ratios = ("", "") if before is None else (f"x {size / before[0]:.3g}", f"x {total / before[1]:.3g}")
            seconds = (f"{found[stage]:.2f}" for stage in STAGES)
            row = (f"{size} {kind}", str(found["equations"]), *seconds, f"{total:.2f}", f"{found['peak']:.0f}")
            table.add_row(*row, *ratios)
            before = size, total
    Console(width=125).print(table, "seconds of processor time; the last columns: ratios to the next smaller model")


if __name__ == "__main__":
    if len(sys.argv) == 3:
        print(json.dumps(measure(sys.argv[1], int(sys.argv[2]))))
    else:
        main()
