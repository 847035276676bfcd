"""Blocks, nodes and elements of keyword decks, the input files of Abaqus and CalculiX."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np

from components.fe.formats.text import LARGEST, file_error, number, text_of

DEEPEST = 20  # levels of *INCLUDE; more means that files include each other
# Solid elements: first letters of the type in the deck, meshio's name, number of nodes, in the same order in both.
SOLIDS = (
    ("C3D4", "tetra", 4),
    ("C3D10", "tetra10", 10),
    ("C3D6", "wedge", 6),
    ("C3D15", "wedge15", 15),
    ("C3D8", "hexahedron", 8),
    ("C3D20", "hexahedron20", 20),
)
# Keywords that generate or move nodes, or rotate the axes of their equations.
GENERATING = ("NGEN", "NFILL", "NCOPY", "NMAP", "SYSTEM", "TRANSFORM")


@dataclass(frozen=True)
class Block:
    """A keyword line and the data lines below it.

    Parameters
    ----------
    keyword : str
        In capitals, without the asterisk.
    options : dict
        Values by their names in capitals; "" for options without a value.
    path, line : Path, int
        File and line of the keyword.
    data : list of (int, list of str)
        Line number and entries of each data line.
    """

    keyword: str
    options: dict[str, str]
    path: Path
    line: int
    data: list[tuple[int, list[str]]] = field(default_factory=list)


def blocks(path: str | Path, depth: int = 0) -> Iterator[Block]:
    """Yield the blocks of a deck, with included files in place of *INCLUDE.

    Raises
    ------
    DeclarationError
        If a file cannot be read or has no keyword.
    """
    if depth > DEEPEST:
        raise file_error(path, f"*INCLUDE is nested more than {DEEPEST} levels deep")
    begun = False
    for block in _of_one_file(Path(path)):
        begun = True
        if block.keyword == "INCLUDE":
            yield from blocks(_input_file(block), depth + 1)
        else:
            yield block
    if not begun:
        raise file_error(
            path, "this is not an input file of Abaqus or CalculiX: no keyword such as *NODE begins a line"
        )


def node_positions(deck: Sequence[Block]) -> dict[int, np.ndarray]:
    """Return the positions (3,) of the nodes of a deck by their numbers, in the deck's unit of length.

    Raises
    ------
    DeclarationError
        If there are no nodes, a line is invalid, or a keyword that generates, moves or rotates nodes occurs.
    """
    found: dict[int, np.ndarray] = {}
    for block in deck:
        if block.keyword in GENERATING:
            raise file_error(
                block.path,
                f"*{block.keyword} is not supported; write all nodes in global x, y, z under *NODE",
                block.line,
            )
        if block.keyword != "NODE":
            continue
        if block.options.get("SYSTEM", "R").upper() != "R":
            raise file_error(block.path, "nodes in cylindrical or spherical coordinates are not supported", block.line)
        for path, line, entries in _data(block):
            name, place = _node(path, line, entries)
            if name in found and not np.array_equal(found[name], place):
                raise file_error(path, f"node {name} is defined twice, at different positions", line)
            found[name] = place
    if not found:
        where = deck[0].path if deck else ""
        raise file_error(where, "there is no node under *NODE in this file")
    return found


def elements(deck: Sequence[Block]) -> Iterator[tuple[str, list[int]]]:
    """Yield type, in capitals, and node numbers of each element of a deck.

    A solid ends with its last node, even if a comma or more numbers follow in that line, as in CalculiX.

    Raises
    ------
    DeclarationError
        If a line is invalid or an element has too few nodes.
    """
    for block in deck:
        if block.keyword != "ELEMENT":
            continue
        kind, entries = block.options.get("TYPE", "").upper(), []
        _, needed = solid(kind)
        for path, line, more in _data(block):
            entries += _integers(path, line, more)
            if len(entries) > needed > 0 or (not needed and more[-1]):  # else the element continues on the next line
                yield kind, entries[1:][: needed or None]
                entries = []
        if entries:
            raise file_error(
                block.path, f"the last element has {len(entries) - 1} nodes, too few for a {kind}", block.line
            )


def solid(kind: str) -> tuple[str, int]:
    """Return meshio's name and the number of nodes of a solid element, or "" and 0 for other types.

    The number of nodes of C3D15V and C3D27 in Abaqus differs from element to element: they are not supported.
    """
    if "V" in kind:
        return "", 0
    family = next((kind[: len(start)] for start, _, _ in SOLIDS[::-1] if kind.startswith(start)), "")
    return next(((name, count) for start, name, count in SOLIDS if start == family), ("", 0))


def cells_of(found: Iterable[tuple[str, list[int]]], rows: Mapping[int, int]) -> dict[str, list[list[int]]]:
    """Return the solid elements of a deck by meshio's names, with rows of the nodes instead of their numbers."""
    cells: dict[str, list[list[int]]] = {}
    for kind, names in found:
        name, count = solid(kind)
        if name and len(names) == count and all(node in rows for node in names):
            cells.setdefault(name, []).append([rows[node] for node in names])
    return cells


def _of_one_file(path: Path) -> Iterator[Block]:
    block, started = None, ""
    for place, line in enumerate(text_of(path, "an input file of Abaqus or CalculiX").splitlines(), 1):
        line = line.strip()
        if not line or line.startswith("**"):
            continue
        if not line.startswith("*") and not started:
            if block is not None:
                block.data.append((place, [entry.strip() for entry in line.split(",")]))
            continue
        started += line
        if line.endswith(","):  # the keyword line continues on the next line
            continue
        if block is not None:
            yield block
        block, started = _block(path, place, started), ""
    if block is not None:
        yield block


def _block(path: Path, line: int, text: str) -> Block:
    name, *options = (part.strip() for part in text[1:].split(","))
    pairs = (option.partition("=") for option in options if option)
    values = {key.strip().upper(): value.strip().strip("\"'") for key, _, value in pairs}
    return Block(" ".join(name.upper().split()), values, path, line)


def _input_file(block: Block) -> Path:
    name = block.options.get("INPUT", "")
    if not name:
        raise file_error(block.path, f"*{block.keyword} lacks INPUT=file", block.line)
    return block.path.parent / name


def _data(block: Block) -> Iterator[tuple[Path, int, list[str]]]:
    """Yield the data lines of a block, including those of the file that INPUT names."""
    if "INPUT" in block.options:
        path = _input_file(block)
        for place, line in enumerate(text_of(path, f"data of *{block.keyword}").splitlines(), 1):
            if line.strip() and not line.startswith("*"):
                yield path, place, [entry.strip() for entry in line.split(",")]
    for place, entries in block.data:
        yield block.path, place, entries


def _node(path: Path, line: int, entries: list[str]) -> tuple[int, np.ndarray]:
    try:
        name = int(entries[0])
        place = np.array([number(entry) for entry in (*entries[1:4], "", "", "")[:3]])
    except ValueError:
        raise file_error(path, f"a node needs number, x, y, z, not `{', '.join(entries)[:60]}`", line) from None
    if not 0 < name <= LARGEST:
        raise file_error(path, f"a node number must be from 1 to {LARGEST}, not {entries[0][:60]}", line)
    return name, place


def _integers(path: Path, line: int, entries: list[str]) -> list[int]:
    try:
        numbers = [int(entry) for entry in entries if entry]
        if any(abs(number) > LARGEST for number in numbers):
            raise ValueError
        return numbers
    except ValueError:
        shown = ", ".join(entries)[:60]
        raise file_error(path, f"an element needs number, node, node, ..., not `{shown}`", line) from None
