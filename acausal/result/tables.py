"""How tables are laid out: for a terminal, in Markdown and as CSV."""

from __future__ import annotations

import csv
import textwrap
from collections.abc import Collection, Iterable, Mapping, Sequence
from dataclasses import dataclass
from itertools import zip_longest
from pathlib import Path

import numpy as np

from acausal.result.files import whole

# Where a narrow table breaks, in characters: names of columns, and what is in them.
NAME, CELL = 10, 42


@dataclass(frozen=True)
class Table:
    """A table to be read.

    Parameters
    ----------
    head : sequence of str
        Names of the columns; the one without a name marks rows, which Markdown shows in bold instead.
    rows : sequence of sequence of str
        The cells.
    words : collection of str
        Names of the columns with text, which are left-aligned.
    """

    head: Sequence[str]
    rows: Sequence[Sequence[str]]
    words: Collection[str] = ()

    def text(self, narrow: bool = False) -> str:
        """Return it for a terminal.

        Parameters
        ----------
        narrow : bool
            Break long cells, and long names of all columns but the first.
        """
        head = [_broken(name) if narrow and k else [name] for k, name in enumerate(self.head)]
        body = [[(narrow and textwrap.wrap(c, CELL, break_on_hyphens=False)) or [c] for c in row] for row in self.rows]
        widths = [max(len(line) for cell in column for line in cell) for column in zip(head, *body, strict=True)]
        align = [str.ljust if name in self.words else str.rjust for name in self.head]
        lines = []
        for row in (head, *body):
            for parts in zip_longest(*row, fillvalue=""):
                aligned = [put(part, width) for put, part, width in zip(align, parts, widths, strict=True)]
                lines.append("  ".join(aligned).rstrip())
        return "\n".join(lines)

    def markdown(self) -> str:
        """Return it in Markdown."""
        shown = [k for k, name in enumerate(self.head) if name]
        lines = [[self.head[k] for k in shown], ["---"] * len(shown)]
        for row in self.rows:
            bold = any(cell and not name for name, cell in zip(self.head, row, strict=True))
            lines.append([f"**{row[k]}**" if bold and row[k] else row[k] for k in shown])
        return "\n".join(f"| {' | '.join(cell.replace('|', chr(92) + '|') for cell in line)} |" for line in lines)


def write_csv(path: str | Path, columns: Mapping[str, Iterable[object]]) -> None:
    """Write a table, a column for each name; every number reads back as it was.

    Parameters
    ----------
    path : str or Path
        Name of the file.
    columns : mapping of str to array or sequence
        The columns in order, one as long as the other.
    """
    plain = [column.tolist() if isinstance(column, np.ndarray) else column for column in columns.values()]
    with whole(path) as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(columns)
        writer.writerows(zip(*plain, strict=True))


def _broken(name: str) -> list[str]:
    """Break a long name between words or parts of words."""
    if len(name) <= NAME:
        return [name]
    return [line.replace("_ ", "_") for line in textwrap.wrap(name.replace("_", "_ "), NAME, break_long_words=False)]
