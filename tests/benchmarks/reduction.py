"""Benchmark: twenty modes of large bodies, from a mesh to a reduced body.

    python -m tests.benchmarks.reduction

A compact block of 22,707 nodes and a plate of 42,105, both of tetrahedra with 10 nodes, free and held at a face: seconds
of one processor and the greatest memory, each in a process of its own.
"""

from __future__ import annotations

import json
import os
import resource
import subprocess
import sys
import time

import numpy as np

BODIES = {"block": ((0.14, 0.14, 0.13), (14, 14, 13)), "plate": ((1.0, 0.05, 0.01), (200, 10, 2))}
HOLDS = ("mean-axis", "face")


def measure(name: str, hold: str) -> dict[str, float]:
    """Nodes, processor time of assembly and reduction in s, and memory of this process in GB."""
    from components.fe import box, reduce_body

    size, counts = BODIES[name]
    started = time.process_time()
    M, K, nodes = box(size, counts, "tet10", E=7e10, nu=0.33, rho=2700.0)
    assembled = time.process_time()
    face = np.flatnonzero(nodes[:, 0] == 0)
    body = reduce_body(M, K, nodes, frames={"face": face, "tip": [len(nodes) - 1]}, hold=hold, modes=20)
    done = time.process_time()
    memory = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024**2
    return {
        "nodes": len(nodes),
        "assembly": assembled - started,
        "reduction": done - assembled,
        "memory": memory,
        "first": float(body.frequencies[0]),
    }


def apart(name: str, hold: str) -> dict[str, float]:
    """`measure` in a process of its own, with one thread of linear algebra."""
    alone = {**os.environ, "OPENBLAS_NUM_THREADS": "1", "OMP_NUM_THREADS": "1"}
    command = [sys.executable, "-m", "tests.benchmarks.reduction", name, hold]
    done = subprocess.run(command, env=alone, capture_output=True, text=True, check=True)
    return json.loads(done.stdout)


def main() -> None:
    """Print a table."""
    if len(sys.argv) > 1:
        print(json.dumps(measure(*sys.argv[1:])))
        return
    print(f"{'body':8}{'held':12}{'nodes':>8}{'assembly':>10}{'reduction':>11}{'memory':>9}{'first':>11}")
    for name in BODIES:
        for hold in HOLDS:
            row = apart(name, hold)
            print(
                f"{name:8}{hold:12}{row['nodes']:8d}{row['assembly']:9.1f}s{row['reduction']:10.1f}s"
                f"{row['memory']:7.2f}GB{row['first']:9.2f}Hz"
            )


if __name__ == "__main__":
    main()
