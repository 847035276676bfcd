"""Tables of the comparison: each program's best points, and times at equal error."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass

from rich.console import Console
from rich.table import Table

from tests.benchmarks.exudyn.compare import Point, front, quickest
from tests.benchmarks.exudyn.scenes import Scene

Tabulated = tuple[list[str], Iterable[list[str]]]
LEVELS = (3e-2, 1e-2, 3e-3, 1e-3, 3e-4, 1e-4, 3e-5)


@dataclass(frozen=True)
class Compared:
    """A scene, how far the two references are apart, and the points of both programs."""

    scene: Scene
    apart: dict[str, float]
    ours: list[Point]
    theirs: list[Point]


def best_rows(compared: Compared) -> Iterable[list[str]]:
    """Rows of the points that none of their own program beats in time and in every output's error."""
    for side in (compared.ours, compared.theirs):
        kept = {id(p) for output in compared.scene.outputs for p in front(side, output)}
        for p in sorted((p for p in side if id(p) in kept), key=lambda p: p.seconds):
            errors = [f"{p.errors[output]:.1e}" for output in compared.scene.outputs]
            counts = [str(n) for n in (p.steps, p.factorisations, p.evaluations)]
            times = [f"{1e3 * s:.1f}" for s in (p.seconds, p.again)]
            yield [p.curve, p.setting, *times, *errors, *counts, p.method]


def equal_rows(compared: Compared) -> Iterable[list[str]]:
    """Rows of the least times for an error, for each output, down to what the references agree on."""
    for output in compared.scene.outputs:
        for error in (level for level in LEVELS if level > compared.apart[output]):
            ours, theirs = (quickest(side, output, error) for side in (compared.ours, compared.theirs))
            if not theirs and not ours:
                continue
            seconds = ours and ours.seconds, ours and ours.again, theirs and theirs.seconds
            times = [f"{1e3 * s:.1f}" if s else "not reached" for s in seconds]
            ratios = [f"{theirs.seconds / s:.1f}" if s and theirs else "" for s in seconds[:2]]
            yield [output, f"{error:g}", *times, *ratios, f"{ours.curve}, {ours.setting}" if ours else ""]


def _equal(compared: Compared) -> Tabulated:
    goal = f"Exudyn / ours (goal {compared.scene.goal:g})"
    return ["output", "error", "ms, ours", "again", "ms, Exudyn", goal, "again", "ours"], list(equal_rows(compared))


def _apart(compared: Compared) -> str:
    return ", ".join(f"{name} {value:.1e}" for name, value in compared.apart.items())


def show(compared: Compared) -> None:
    """Print both tables."""
    scene = compared.scene
    errors = [f"error of {name}" for name in scene.outputs]
    points = ["", "tolerance or step", "ms", "again", *errors, "steps", "factorisations", "evaluations", "method"]
    title = f"{scene.name}: the two references differ by {_apart(compared)} of the range"
    print_tables(title, [(points, best_rows(compared)), _equal(compared)])


def print_tables(title: str, tables: Iterable[Tabulated]) -> None:
    """Print tables, each of its columns and rows, below a title."""
    console = Console(width=180)
    console.print(title + "\n", highlight=False, markup=False)
    for columns, rows in tables:
        table = Table(*columns)
        for row in rows:
            table.add_row(*row)
        console.print(table)


def section(compared: Compared) -> str:
    """Times at equal error as a section of the page."""
    text = f"The two references differ by {_apart(compared)} of the range."
    return f"{heading(compared.scene.name)}\n\n{text}\n\n{markdown(_equal(compared))}"


def heading(name: str) -> str:
    """The heading of a section."""
    return f"## {name[:1].upper()}{name[1:]}"


def markdown(table: Tabulated) -> str:
    """A table in Markdown."""
    columns, rows = table
    return "\n".join("| " + " | ".join(row) + " |" for row in (columns, ["---"] * len(columns), *rows))
