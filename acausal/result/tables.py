"""Tables: layout for a terminal and in Markdown, writing and reading of CSV."""

from __future__ import annotations

import csv
import textwrap
from collections.abc import Collection, Iterable, Mapping, Sequence
from dataclasses import dataclass
from itertools import zip_longest
from pathlib import Path

import numpy as np

from acausal.errors import DeclarationError
from acausal.result.files import read_text, shown_name, whole

# Width in characters at which a narrow table breaks names of columns, and cells.
NAME, CELL = 10, 42
WIDTH = 100  # of lines


@dataclass(frozen=True)
class Table:
    """A table of text.

    Parameters
    ----------
    head : sequence of str
        Names of the columns; a column without a name marks rows, which Markdown shows in bold instead.
    rows : sequence of sequence of str
        The cells.
    words : collection of str
        Names of the left-aligned columns.
    """

    head: Sequence[str]
    rows: Sequence[Sequence[str]]
    words: Collection[str] = ()

    def text(self, narrow: bool = False) -> str:
        """Return the table for a terminal.

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
        """Return the table in Markdown."""
        shown = [k for k, name in enumerate(self.head) if name]
        lines = [[self.head[k] for k in shown], ["---"] * len(shown)]
        for row in self.rows:
            bold = any(cell and not name for name, cell in zip(self.head, row, strict=True))
            lines.append([f"**{row[k]}**" if bold and row[k] else row[k] for k in shown])
        return "\n".join(f"| {' | '.join(cell.replace('|', chr(92) + '|') for cell in line)} |" for line in lines)


def wrapped(lines: Iterable[str], width: int = WIDTH, indent: int = 0) -> str:
    """Return lines as text, long ones broken between words and continued at an indent.

    Parameters
    ----------
    lines : iterable of str
        The lines.
    width, indent : int
        In characters.
    """
    how = {"subsequent_indent": " " * indent, "break_long_words": False, "break_on_hyphens": False}
    return "\n".join(textwrap.fill(line, width, **how) for line in lines)


def write_csv(path: str | Path, columns: Mapping[str, Iterable[object]]) -> None:
    """Write a table, a column for each name; numbers have all digits.

    Parameters
    ----------
    path : str or Path
        Name of the file.
    columns : mapping of str to array or sequence
        The columns in order, of equal length.
    """
    plain = [column.tolist() if isinstance(column, np.ndarray) else column for column in columns.values()]
    with whole(path) as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(columns)
        writer.writerows(zip(*plain, strict=True))


@dataclass(frozen=True)
class Columns:
    """A table read from a file, not yet converted to numbers.

    Parameters
    ----------
    what, path : str
        What the table is, and the name of its file, for messages.
    head : tuple of str
        Names of the columns.
    rows : tuple of (int, list of str)
        Line number in the file, and cells.
    """

    what: str
    path: str
    head: tuple[str, ...]
    rows: tuple[tuple[int, list[str]], ...]

    def __str__(self) -> str:
        return f"{self.what} {shown_name(self.path)}"

    def numbers(self, name: str) -> np.ndarray:
        """Return a column; raise DeclarationError with the line of an entry that is not a finite number."""
        place, found = self.head.index(name), np.empty(len(self.rows))
        for k, (line, row) in enumerate(self.rows):
            try:
                found[k] = float(row[place])
            except ValueError:
                found[k] = np.nan
            if not np.isfinite(found[k]):
                cell = f"`{shown_name(row[place].strip())}`" if row[place].strip() else "an empty entry"
                raise DeclarationError(
                    f"{self} has entries that are not finite numbers: {cell} in line {line}, column `{name}`."
                )
        return found


def read_csv(path: str | Path, what: str) -> Columns:
    """Read a table in the format of `write_csv`.

    Parameters
    ----------
    path : str or Path
        Name of the file.
    what : str
        What the table is, for messages.

    Raises
    ------
    DeclarationError
        If it cannot be read or is not a table.
    """
    reader = csv.reader(read_text(path, what).splitlines(keepends=True))
    title = f"{what} {shown_name(path)}"
    try:
        rows = tuple((reader.line_num, row) for row in reader if row)
    except csv.Error as error:
        raise DeclarationError(f"{title} is not a table: line {reader.line_num}: {error}.") from None
    if not rows:
        raise DeclarationError(f"cannot read {title}: it is empty.")
    head, rows = tuple(name.strip() for name in rows[0][1]), rows[1:]
    twice = next((name for name in head if head.count(name) > 1), None)
    if twice is not None:
        raise DeclarationError(f"{title} has the column `{twice}` more than once.")
    for line, row in rows:
        if len(row) != len(head):
            raise DeclarationError(
                f"line {line} of {title} has {len(row)} {'entry' if len(row) == 1 else 'entries'}, its head {len(head)} "
                f"({column_names(head)}). Separate entries by commas and write decimals with points."
            )
    return Columns(what, str(path), head, rows)


def column_names(head: Sequence[str]) -> str:
    """Return the names of columns for a message, the first twenty of many."""
    most = 20
    shown = [shown_name(name) for name in head[:most]]
    return ", ".join([*shown, f"... ({len(head)} in all)"] if len(head) > most else shown)


def _broken(name: str) -> list[str]:
    """Break a long name at spaces and underscores."""
    if len(name) <= NAME:
        return [name]
    return [line.replace("_ ", "_") for line in textwrap.wrap(name.replace("_", "_ "), NAME, break_long_words=False)]
