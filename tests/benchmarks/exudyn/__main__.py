"""Benchmark: accuracy against time, compared with Exudyn; tables and a picture.

    OPENBLAS_NUM_THREADS=1 python -m tests.benchmarks.exudyn [--write] [--plot FILE.png] [SCENE]...

`--write` writes the tables of times at equal error as docs/background/exudyn-tables.md.

One run on one machine: spin-up, pendulum, slider-crank and right-angle frame at several tolerances, steps and formulations;
and the static bend of 45 degrees. Errors are the
largest over 401 points against Exudyn with many elements and short steps, as a fraction of the range; how far our own
converged solution is from it is printed too. Times are CPU times, best of several: of SolveDynamic, and of simulate() with
a compiled model, which counts initialisation and choice of the order; "again" where the run before had the same parameters,
whose start is taken. Assembling and compiling are left out; neither writes files. Exudyn is optional: pip install ".[benchmark]".
"""

from __future__ import annotations

import argparse
from pathlib import Path

from tests.benchmarks.exudyn import bend
from tests.benchmarks.exudyn.cable import has_exudyn
from tests.benchmarks.exudyn.compare import ours, reference, theirs
from tests.benchmarks.exudyn.picture import draw
from tests.benchmarks.exudyn.scenes import SCENES
from tests.benchmarks.exudyn.tables import Compared, heading, markdown, print_tables, section, show

REPEATS = 6
PAGE = Path("docs/background/exudyn-tables.md")
INTRODUCTION = """# Comparison with Exudyn: tables

Written by `python -m tests.benchmarks.exudyn --write`; [exudyn.md](exudyn.md) explains columns and results."""
BEND = "Distance of the tip from that of the exact rod in m."


def main(names: list[str], path: str | None, write: bool) -> None:
    """Compare the scenes, and the bend, whose name holds one of the names; all, if there are none."""
    if not has_exudyn():
        raise SystemExit('Exudyn is not installed, so there is nothing to compare with: pip install ".[benchmark]"')
    compared, sections = [], [INTRODUCTION]
    for scene in (s for s in SCENES if not names or any(name in s.name for name in names)):
        exact = reference(scene)
        points = [p for curve in scene.curves for p in ours(scene, curve, exact.outputs, REPEATS)]
        compared.append(Compared(scene, exact.apart, points, theirs(scene, exact.outputs, REPEATS)))
        show(compared[-1])
        sections.append(section(compared[-1]))
    if not names or any(name in bend.NAME for name in names):
        table = bend.COLUMNS, list(bend.bend_rows())
        print_tables(f"{bend.NAME}: {BEND}", [table])
        sections.append(f"{heading(bend.NAME)}\n\n{BEND}\n\n{markdown(table)}")
    if write:
        PAGE.write_text("\n\n".join(sections) + "\n")
    if path and compared:
        draw(compared, path)


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("scenes", nargs="*", metavar="SCENE", help="part of a scene's name")
    parser.add_argument("--plot", metavar="FILE.png", help="write the picture")
    parser.add_argument("--write", action="store_true", help=f"write {PAGE}")
    given = parser.parse_args()
    main(given.scenes, given.plot, given.write)
