"""Tables of a study of effects: changes and costs of its rows, interactions, and the cheapest sets."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from typing import Any

from acausal.result.tables import Table
from acausal.study.effects.effect_rows import ALL, EffectRow, Interaction

WORDS = ("effect", "in", "switched together", "for", "switched")
COSTS = ("time", "operations", "equations", "steps")
FIGURES = ("seconds", "time", "work", "operations", "equations", "equations_less", "steps", "error")
Labelled = Sequence[tuple[str, EffectRow]]


def changes(rows: Labelled, outputs: Sequence[str], rms: bool = False) -> Table:
    """Return the largest change of each output.

    Parameters
    ----------
    rows : sequence of (str, EffectRow)
        The rows, each with its label.
    outputs : sequence of str
        Outputs whose changes are shown.
    rms : bool
        Show root mean squares as well.
    """
    return _variants(
        rows,
        outputs,
        lambda row: [number(row.largest[n]) + (f" {number(row.rms[n])}" if rms else "") for n in outputs],
    )


def brief_changes(rows: Labelled) -> Table:
    """Return the largest change of each row, and its output.

    Parameters
    ----------
    rows : sequence of (str, EffectRow)
        The rows, each with its label.
    """
    return _variants(rows, ("largest", "in"), lambda row: [number(row.change()), row.worst])


def together(interactions: Iterable[tuple[Interaction, str]]) -> Table:
    """Return the table of interactions of pairs.

    Parameters
    ----------
    interactions : iterable of (Interaction, str)
        Each with the output to show, "" if the pair failed.
    """
    body = []
    for i, output in interactions:
        names = ", ".join(f"{path}={value}" for path, value in {**i.first, **i.second}.items())
        body.append([names, number(i.size[output]) if output else "failed", output or i.error])
    return Table(["switched together", "interaction", "in"], body, WORDS)


def sets(cheapest: Mapping[str, EffectRow]) -> Table:
    """Return the table of the cheapest sets.

    Parameters
    ----------
    cheapest : mapping of str to EffectRow
        Rows by target: an output, or all outputs.
    """
    body = [
        [name, row.name or "nothing", *_costs(row), number(row.change(None if name == ALL else [name]))]
        for name, row in cheapest.items()
    ]
    return Table(["for", "switched", *COSTS, "change"], body, WORDS)


def columns(rows: Labelled, outputs: Sequence[str]) -> dict[str, list[Any]]:
    """Return all figures by the names of the columns of the CSV file.

    Parameters
    ----------
    rows : sequence of (str, EffectRow)
        The rows, each with its kind.
    outputs : sequence of str
        Outputs whose changes are listed.
    """
    table: dict[str, list[Any]] = {"kind": [kind for kind, _ in rows], "choices": [row.name for _, row in rows]}
    for name in outputs:
        table[f"{name} largest"] = [row.largest.get(name, "") for _, row in rows]
        table[f"{name} rms"] = [row.rms.get(name, "") for _, row in rows]
    return table | {name: [getattr(row, name) for _, row in rows] for name in FIGURES}


def number(value: float) -> str:
    """Return a change with two digits, as a fraction of the range."""
    return "0" if value == 0 else f"{value:.1e}".replace("e-0", "e-").replace("e+0", "e+")


def _variants(rows: Labelled, shown: Sequence[str], changes_of: Callable[[EffectRow], list[str]]) -> Table:
    failed = [*[""] * len(shown), "failed", *[""] * (len(COSTS) - 1)]
    body = [[label, *(failed if row.error else [*changes_of(row), *_costs(row)])] for label, row in rows]
    return Table(["effect", *shown, *COSTS], body, WORDS)


def _costs(row: EffectRow) -> list[str]:
    return [f"{row.time:.2f} x", f"{row.work:.2f} x", f"{-row.equations_less:+d}", str(row.steps)]
