"""Tables of a study of effects, for a terminal and in Markdown."""

from __future__ import annotations

import textwrap
from collections.abc import Iterable, Iterator

from acausal.study.effects_result import ALL, Effects
from acausal.study.effects_rows import Interaction, Row, as_fast

WIDTH = 120
# Interactions below this part of the accuracy are not worth a line.
WORTH = 0.1
COSTS = ("time", "operations", "equations", "steps")
# Columns of words; all others hold numbers.
WORDS = ("effect", "in", "switched together", "for", "switched")
ELSEWHERE = "(the changes of every output: --csv FILE, --markdown FILE)"
Table = list[list[str]]


def text(found: Effects) -> str:
    """Return tables and a recommendation for a terminal, at most 120 columns wide.

    Parameters
    ----------
    found : Effects
        What to show.
    """
    changes = _columns(_changes(found))
    parts = [
        _wrap(_heading(found)),
        changes if _is_narrow(changes) else _columns(_changes(found, brief=True)) + "\n" + ELSEWHERE,
        *[_wrap(line) for line in _remarks(found)],
        *([_columns(_together(found))] if _worth(found) else []),
        _wrap(_interaction_words(found)),
        _wrap(f"Cheapest sets whose change stays within {found.accuracy:g}:"),
        _columns(_sets(found)),
        "\n".join(_wrap(line) for line in _words(found)),
    ]
    return "\n\n".join(part for part in parts if part)


def markdown(found: Effects) -> str:
    """Return the same in Markdown, with root mean squares.

    Parameters
    ----------
    found : Effects
        What to show.
    """
    parts = [
        f"# Effects of {found.scene}",
        _heading(found),
        "Each change: the largest, then the root mean square.",
        _pipes(_changes(found, rms=True)),
        *_remarks(found),
        *([_pipes(_together(found))] if _worth(found) else []),
        _interaction_words(found),
        f"Cheapest sets whose change stays within {found.accuracy:g}:",
        _pipes(_sets(found)),
        *_words(found),
    ]
    return "\n\n".join(part for part in parts if part) + "\n"


def _heading(found: Effects) -> str:
    r = found.reference
    which = "the scene as it stands" if found.refused else "the fullest scene"
    which += ", which is the scene as it stands" * (not found.refused and not found.standing.choices)
    words = (
        f"{found.scene}: what each effect changes and costs, next to {which} ({r.equations} equations, {r.operations} "
        f"operations, {r.steps} steps, {r.seconds:.3g} s at tolerance {found.tolerance:g}). Changes are the largest, "
        "in parts of the range of the output."
    )
    if found.refused:
        words += f" The fullest scene is not the reference: {found.refused}"
    return words


def _changes(found: Effects, rms: bool = False, brief: bool = False) -> Table:
    """A line for each switched effect; `brief` shows one change of it, the largest."""
    shown = ("largest", "in") if brief else found.outputs

    def line(label: str, row: Row) -> list[str]:
        if row.error:
            return [label, *[""] * len(shown), "failed", *[""] * (len(COSTS) - 1)]
        return [label, *cells(row), *_costs(row)]

    def cells(row: Row) -> list[str]:
        if brief:
            return [_number(row.change()), _where(row)]
        return [_number(row.largest[n]) + (f" {_number(row.rms[n])}" if rms else "") for n in found.outputs]

    table = [["effect", *shown, *COSTS], *[line(row.name, row) for row in found.rows]]
    if found.standing.choices:
        table.append(line("the scene as it stands", found.standing))
    if not found.floor.error:
        table.append(line(f"(tolerance {found.tolerance / 10:g})", found.floor))
    return table


def _costs(row: Row) -> list[str]:
    return [f"{row.time:.2f} x", f"{row.work:.2f} x", f"{-row.equations_less:+d}", str(row.steps)]


def _remarks(found: Effects) -> Iterable[str]:
    for row in found.rows:
        if row.error:
            yield f"{row.name} failed: {row.error}"
    if found.idle:
        names = ", ".join(dict.fromkeys(path for choices in found.idle for path in choices))
        yield f"Not called for by this scene, so that switching changes no equation: {names}."


def _worth(found: Effects) -> list[tuple[Interaction, str]]:
    """Interactions above the errors of the integration and a part of the accuracy, and the output where it is most so."""
    errors = found.floor.largest
    least = {name: max(WORTH * found.accuracy, 3 * errors.get(name, 0.0)) for name in found.outputs}
    worth = []
    for i in found.interactions:
        where = max(i.size, key=lambda name: i.size[name] / least[name], default="")
        if i.error or i.size[where] > least[where]:
            worth.append((i, where))
    return sorted(worth, key=lambda pair: -pair[0].size.get(pair[1], 0.0))


def _together(found: Effects) -> Table:
    table = [["switched together", "interaction", "in"]]
    for i, where in _worth(found):
        names = ", ".join(f"{p}={v}" for p, v in {**i.first, **i.second}.items())
        table.append([names, _number(i.size[where]) if where else "failed", where or i.error])
    return table


def _interaction_words(found: Effects) -> str:
    if not found.interactions:
        return ""
    if _worth(found):
        words = "An interaction is what both change together beyond the sum of what each changes alone."
    else:
        words = f"None of {len(found.interactions)} pairs interacts: what both change is the sum of what each changes."
    if found.untried:
        words += f" {found.untried} further pairs, whose effects change less, were not tried."
    return words


def _sets(found: Effects) -> Table:
    table = [["for", "switched", "time", "operations", "equations", "steps", "change"]]
    for name, row in found.cheapest.items():
        change = row.change(None if name == ALL else [name])
        table.append([name, row.name or "nothing", *_costs(row), _number(change)])
    return table


def _words(found: Effects) -> Iterator[str]:
    """The recommendation in words."""
    reference, best = found.reference, found.cheapest[ALL]
    if best.choices:
        yield f"For all outputs: {_set(best, reference)}."
    else:
        yield (
            f"For all outputs together nothing can be left out: what saves time changes one of them by more than "
            f"{found.accuracy:g}."
        )
    groups: dict[str, list[str]] = {}
    for name, row in found.cheapest.items():
        if name != ALL and row.choices != best.choices:
            groups.setdefault(_set(row, reference), []).append(name)
    for words, names in groups.items():
        yield f"For {' or '.join(names)} alone: {words}."
    standing = found.standing
    if not found.refused and not standing.error and standing.change() > found.accuracy:
        yield (
            f"The scene as it stands is not among them: it is {_number(standing.change())} from the fullest "
            f"({_where(standing)})."
        )
    for name, error in found.floor.largest.items():
        if error > found.accuracy:
            yield (
                f"The integration itself is off by {_number(error)} in {name}, so that smaller changes of it mean nothing: "
                f"take a smaller tolerance than {found.tolerance:g}, or leave that output out."
            )
    switched = found.switched()
    if switched:
        settings = " ".join(f"--set {path}={value}" for path, value in switched.items())
        yield f"From the scene as it stands to the set for all outputs: {settings}"


def _set(row: Row, reference: Row) -> str:
    if not row.choices:
        return "all effects of the reference"
    if as_fast(row, reference):
        return f"{row.name}; {row.work:.2f} of the operations, as fast as far as can be told"
    times = f"{reference.seconds / row.seconds:.2g} times faster"
    return f"{row.name}; {times} ({row.seconds:.3g} s instead of {reference.seconds:.3g} s)"


def _where(row: Row) -> str:
    return max(row.largest, key=lambda name: row.largest[name])


def _number(value: float) -> str:
    return "0" if value == 0 else f"{value:.1e}".replace("e-0", "e-").replace("e+0", "e+")


def _columns(table: Table) -> str:
    """Align columns; long headers and long words are broken."""
    broken = [[_break(cell, k, row is table[0]) for k, cell in enumerate(row)] for row in table]
    words = [k for k, name in enumerate(table[0]) if name in WORDS]
    widths = [max(len(part) for row in broken for part in row[k]) for k in range(len(table[0]))]
    lines = []
    for row in broken:
        for at in range(max(map(len, row))):
            parts = [cell[at] if at < len(cell) else "" for cell in row]
            line = "  ".join(
                p.ljust(w) if k in words else p.rjust(w) for k, (p, w) in enumerate(zip(parts, widths, strict=True))
            )
            lines.append(line.rstrip())
    return "\n".join(lines)


def _break(cell: str, column: int, header: bool) -> list[str]:
    if header and column and len(cell) > 10:
        return textwrap.wrap(cell.replace("_", "_ "), 10, break_long_words=False)
    return textwrap.wrap(cell, 42, break_on_hyphens=False) or [""]


def _is_narrow(text: str) -> bool:
    return all(len(line) <= WIDTH for line in text.splitlines())


def _pipes(table: Table) -> str:
    head, *rows = table
    return "\n".join("| " + " | ".join(row) + " |" for row in [head, ["---"] * len(head), *rows])


def _wrap(words: str) -> str:
    return "\n".join(textwrap.wrap(words, WIDTH, break_on_hyphens=False, break_long_words=False))
