"""Docstrings in the style of numpydoc, as Markdown."""

from __future__ import annotations

import re
import textwrap
from collections.abc import Iterator

SECTION = re.compile(r"^(\w[\w ]*)\n-{3,}\n", re.M)
ENTRY = re.compile(r"^(\S[^\n]*)\n((?:[ ]{4}[^\n]*\n?|\n(?=[ ]{4}))*)", re.M)


def sections(text: str) -> Iterator[tuple[str, str]]:
    """Yield the title and the text of each section; the text before the first one has the title ""."""
    titles, *rest = SECTION.split(text)
    yield "", titles.strip()
    for title, body in zip(rest[::2], rest[1::2], strict=True):
        yield title, body.strip("\n")


def entries(body: str) -> tuple[str, list[tuple[str, str, str]]]:
    """Return the text before the entries of a section, and name, type and description of each."""
    before, _, listed = (
        body.partition("\n\n") if not re.search(r"^\S[^\n]* : |^\S[^\n]*\n {4}", body) else ("", "", body)
    )
    found = []
    for line, description in ENTRY.findall(listed + "\n"):
        name, _, kind = line.partition(" : ")
        found.append((name, kind, " ".join(textwrap.dedent(description).split())))
    return before, found


def table(heads: tuple[str, ...], rows: list[tuple[str, ...]]) -> str:
    """Return a table in Markdown; cells hold Markdown of one line."""
    lines = [heads, ("---",) * len(heads), *rows]
    return "\n".join("| " + " | ".join(cell.replace("|", "\\|") for cell in row) + " |" for row in lines)
