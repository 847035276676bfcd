"""The table of a study: for the terminal, as CSV and as Markdown."""

from __future__ import annotations

import csv
from collections.abc import Sequence
from pathlib import Path
from typing import Any

from acausal.result.files import whole
from acausal.study.reference import Reference
from acausal.study.rows import Row

# Columns that are read, not compared.
WORDS = ("", "formulation", "size", "method", "constraints", "limited by")
Columns = dict[str, list[Any]]


def columns(rows: Sequence[Row], switches: Sequence[str] = ()) -> Columns:
    """Return everything that is known of each row, by the names of the columns of the CSV.

    Parameters
    ----------
    rows : sequence of Row
        The rows.
    switches : sequence of str
        Paths that were varied.
    """
    outputs = dict.fromkeys(name for row in rows for name in row.errors)
    table: Columns = {
        "formulation": [r.point.formulation for r in rows],
        "size": [r.point.size for r in rows],
        **{path: [r.point.settings[path] for r in rows] for path in switches},
        "tolerance": [r.point.tolerance for r in rows],
        "max_order": [r.measurement.max_order or r.point.max_order for r in rows],
        "method": [r.measurement.method or r.point.method for r in rows],
        "constraints": [r.measurement.constraints or r.point.constraints for r in rows],
        "error": [r.error for r in rows],
        "rms": [r.rms for r in rows],
    }
    for k, what in enumerate(("error", "rms")):
        for name in outputs:
            table[f"{what} {name}"] = [r.errors[name][k] if name in r.errors else float("nan") for r in rows]
    counts = ("compile_seconds", "solve_seconds", "steps", "factorisations", "residual_evaluations", "equations")
    table |= {name: [getattr(r.measurement, name) for r in rows] for name in (*counts, "operations")}
    return table | {
        "limited_by": [r.limit for r in rows],
        "best": [int(r.front) for r in rows],
        "remark": [r.remark for r in rows],
    }


def write_table(path: str | Path, rows: Sequence[Row], switches: Sequence[str]) -> None:
    """Write the columns as CSV, every number with all digits.

    Parameters
    ----------
    path : str or Path
        Name of the file.
    rows : sequence of Row
        The rows.
    switches : sequence of str
        Paths that were varied.
    """
    table = columns(rows, switches)
    with whole(path) as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(table)
        writer.writerows(zip(*table.values(), strict=True))


def cells(rows: Sequence[Row], reference: Reference, switches: Sequence[str]) -> tuple[list[str], list[list[str]]]:
    """Return head and rows of the table for people: what is the same in every row is left out.

    Parameters
    ----------
    rows : sequence of Row
        The rows.
    reference : Reference
        Tells which errors are too small to be known.
    switches : sequence of str
        Paths that were varied.
    """
    table = columns(rows, switches)
    options = ("max_order", "method", "constraints")
    asked = {name: {getattr(row.point, name) for row in rows} for name in options}
    varied = [name for name in options if len(asked[name]) > 1 or len({used for used in table[name] if used}) > 1]
    head = ["", "formulation", "size", *switches, "tolerance", *(name.replace("_", " ") for name in varied)]
    head += ["solve ms", "compile s", "steps", "fact.", "residuals", "unknowns", "error", "rms", "limited by"]
    body = []
    for k, row in enumerate(rows):
        m, point = row.measurement, row.point
        what = ["*" if row.front else "", point.formulation, point.size, *(str(table[path][k]) for path in switches)]
        what += [f"{point.tolerance:.0e}", *(str(table[name][k] or "") for name in varied)]
        costs = [f"{m.solve_seconds * 1e3:.3g}", f"{m.compile_seconds:.2g}"]
        costs += [str(n) for n in (m.steps, m.factorisations, m.residual_evaluations, m.equations)]
        body.append([*what, *(costs if m.steps or not m.error else ["-"] * 6), *_errors(row, reference)])
    return head, body


def _errors(row: Row, reference: Reference) -> list[str]:
    if row.remark:
        return ["-", "-", row.remark]
    below = row.error < reference.floor
    return [f"< {reference.floor:.1e}" if below else f"{row.error:.1e}", f"{row.rms:.1e}", row.limit]


def text(head: Sequence[str], body: Sequence[Sequence[str]]) -> str:
    """Return a table for a terminal.

    Parameters
    ----------
    head, body : sequence of str, sequence of rows of str
        From `cells`.
    """
    widths = [max(len(row[k]) for row in (head, *body)) for k in range(len(head))]
    lines = []
    for row in (head, *body):
        aligned = zip(head, row, widths, strict=True)
        lines.append("  ".join(c.ljust(w) if name in WORDS else c.rjust(w) for name, c, w in aligned).rstrip())
    return "\n".join(lines)


def markdown(head: Sequence[str], body: Sequence[Sequence[str]]) -> str:
    """Return a table in Markdown, the best rows in bold.

    Parameters
    ----------
    head, body : sequence of str, sequence of rows of str
        From `cells`.
    """
    lines = [_line(head[1:]), _line(["---"] * (len(head) - 1))]
    for best, *row in body:
        lines.append(_line([f"**{cell}**" if best and cell else cell for cell in row]))
    return "\n".join(lines)


def _line(row: Sequence[str]) -> str:
    return f"| {' | '.join(cell.replace('|', chr(92) + '|') for cell in row)} |"
