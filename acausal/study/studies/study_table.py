"""The tables of a study: all figures by column, and the table for readers."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from acausal.result.tables import Table
from acausal.study.studies.reference import Reference
from acausal.study.studies.study_rows import StudyRow

WORDS = ("", "formulation", "size", "method", "constraints", "limited by")


def columns(rows: Sequence[StudyRow], switches: Sequence[str] = ()) -> dict[str, list[Any]]:
    """Return all figures of the rows by the names of the columns of the CSV file.

    Parameters
    ----------
    rows : sequence of StudyRow
        The rows.
    switches : sequence of str
        Varied paths.
    """
    outputs = dict.fromkeys(name for row in rows for name in row.errors)
    table: dict[str, list[Any]] = {
        "formulation": [r.case.formulation for r in rows],
        "size": [r.case.size for r in rows],
        **{path: [r.case.settings[path] for r in rows] for path in switches},
        "tolerance": [float("nan") if r.case.dt else r.case.tolerance for r in rows],
        **({"dt": [r.case.dt or float("nan") for r in rows]} if any(r.case.dt for r in rows) else {}),
        "max_order": [r.measurement.max_order or r.case.max_order for r in rows],
        "method": [r.measurement.method or r.case.method for r in rows],
        "constraints": [r.measurement.constraints or r.case.constraints for r in rows],
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


def cells(rows: Sequence[StudyRow], reference: Reference, switches: Sequence[str]) -> Table:
    """Return the table for readers, without options that are the same in every row.

    Parameters
    ----------
    rows : sequence of StudyRow
        The rows.
    reference : Reference
        The reference, whose uncertainty bounds the errors from below.
    switches : sequence of str
        Varied paths.
    """
    table = columns(rows, switches)
    options = ("max_order", "method", "constraints")
    requested = {name: {getattr(row.case, name) for row in rows} for name in options}
    varied = [name for name in options if len(requested[name]) > 1 or len({used for used in table[name] if used}) > 1]
    control = "tolerance, dt" if "dt" in table else "tolerance"
    head = ["", "formulation", "size", *switches, control, *(name.replace("_", " ") for name in varied)]
    head += ["solve ms", "compile s", "steps", "fact.", "residuals", "unknowns", "error", "rms", "limited by"]
    body = []
    for k, row in enumerate(rows):
        m, case = row.measurement, row.case
        what = ["*" if row.front else "", case.formulation, case.size, *(str(table[path][k]) for path in switches)]
        what += [case.fineness.removeprefix("dt "), *(str(table[name][k] or "") for name in varied)]
        costs = [f"{m.solve_seconds * 1e3:.3g}", f"{m.compile_seconds:.2g}"]
        costs += [str(n) for n in (m.steps, m.factorisations, m.residual_evaluations, m.equations)]
        body.append([*what, *(costs if m.steps or not m.error else ["-"] * 6), *_errors(row, reference)])
    return Table(head, body, WORDS)


def _errors(row: StudyRow, reference: Reference) -> list[str]:
    if row.remark:
        return ["-", "-", row.remark]
    below = row.error < reference.floor
    return [f"< {reference.floor:.1e}" if below else f"{row.error:.1e}", f"{row.rms:.1e}", row.limit]
