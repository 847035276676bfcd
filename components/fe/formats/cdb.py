"""Nodes and solid elements of an Ansys archive written by CDWRITE: NBLOCK and EBLOCK."""

from __future__ import annotations

import re
from collections.abc import Iterator
from pathlib import Path

import numpy as np

from components.fe.formats.text import file_error, number, text_of

# Number of nodes of the solids by their element routine in ET. Others, such as surfaces and contacts, are ignored.
SOLIDS = {
    **dict.fromkeys((5, 45, 64, 65, 69, 70, 185), 8),
    **dict.fromkeys((87, 92, 98, 187, 227), 10),
    **dict.fromkeys((90, 95, 186, 226), 20),
    285: 4,
}
KINDS = {4: "tetra", 8: "hexahedron", 10: "tetra10", 20: "hexahedron20"}
# Degenerate bricks: element type, indices of its nodes in the brick, and pairs of coincident nodes.
COLLAPSED = {
    8: (("tetra", (0, 1, 2, 4), ((2, 3), (4, 5), (5, 6), (6, 7))), ("wedge", (0, 1, 2, 4, 5, 6), ((2, 3), (6, 7)))),
    20: (
        ("tetra10", (0, 1, 2, 4, 8, 9, 11, 16, 17, 18), ((2, 3), (4, 5), (5, 6), (6, 7))),
        ("wedge15", (0, 1, 2, 4, 5, 6, 8, 9, 11, 12, 13, 15, 16, 17, 18), ((2, 3), (6, 7))),
    ),
}
CORNERS = {10: 4, 20: 8}  # corners of the quadratic solids
HEAD = 11  # integers before the nodes of an element, in a block of solids
TYPE, COUNT, NUMBER = 1, 8, 10  # their indices
FIELD = re.compile(r"(\d*)([ieIE])(\d+)(?:\.\d+(?:[eE]\d+)?)?")
END = re.compile(r"\s*N\s*,\s*R5\.\d\s*,\s*LOC\s*,\s*-1", re.IGNORECASE)
Row = tuple[int, list[str], list[str]]


def read_cdb(path: str | Path) -> tuple[np.ndarray, np.ndarray, dict[str, np.ndarray]]:
    """Return positions and numbers of the nodes, and solid elements as rows of these, by meshio's names.

    Raises
    ------
    DeclarationError
        If blocks of nodes or elements are missing or truncated, or a line is invalid.
    """
    rest = enumerate(text_of(path, "an archive of Ansys").splitlines(), 1)
    routines: dict[int, int] = {}
    places: dict[int, list[float]] = {}
    found: dict[str, list[list[int]]] = {}
    for line, text in rest:
        words = [word.strip().upper() for word in text.split(",")]
        if words[0] == "ET" and len(words) > 2 and words[1].isdecimal() and words[2].isdecimal():
            routines[int(words[1])] = int(words[2])
        elif words[0] == "NBLOCK":
            for at, whole, reals in _rows(path, rest, line, "NBLOCK"):
                places[_integers(path, at, whole)[0]] = _place(path, at, reals)
        elif words[0] == "EBLOCK" and "SOLID" in words:
            for kind, nodes in _elements(path, _rows(path, rest, line, "EBLOCK"), routines):
                found.setdefault(kind, []).append(nodes)
    if not places or not found:
        raise file_error(
            path, f"there is no {'NBLOCK' if not places else 'EBLOCK of solids'} in it; CDWRITE,DB writes both"
        )
    rows = {name: row for row, name in enumerate(places)}
    lost = next((name for cells in found.values() for nodes in cells for name in nodes if name not in rows), None)
    if lost is not None:
        raise file_error(path, f"an element refers to node {lost}, which is not in the file")
    cells = {kind: np.array([[rows[name] for name in nodes] for nodes in members]) for kind, members in found.items()}
    return np.array(list(places.values())), np.array(list(places)), cells


def _rows(path: str | Path, rest: Iterator[tuple[int, str]], begun: int, block: str) -> Iterator[Row]:
    """Yield line number, integers and real numbers of each line of a block.

    The line below the header gives the field widths; the block ends with a line of -1.
    """
    at, form = next(rest, (begun, ""))
    fields = [(kind.lower(), int(width)) for n, kind, width in FIELD.findall(form) for _ in range(int(n or 1))]
    if not fields:
        raise file_error(path, f"{block} must begin with its format, such as (3i9,6e21.13e3), not `{form[:60]}`", at)
    ends = np.cumsum([width for _, width in fields]).tolist()
    slices = [(kind, slice(end - width, end)) for (kind, width), end in zip(fields, ends, strict=True)]
    for line, text in rest:
        if text.strip() == "-1" or END.match(text):
            return
        parts = [(kind, text[part].strip()) for kind, part in slices if text[part].strip()]
        if parts:
            yield line, [word for kind, word in parts if kind == "i"], [word for kind, word in parts if kind != "i"]
    raise file_error(path, f"the file is truncated: it ends inside {block}, which begins in line {begun}")


def _elements(path: str | Path, rows: Iterator[Row], routines: dict[int, int]) -> Iterator[tuple[str, list[int]]]:
    """Yield type and nodes of each solid; degenerate bricks become tetrahedra or wedges."""
    for line, whole, _ in rows:
        head = _integers(path, line, whole)
        nodes, count = head[HEAD:], head[COUNT] if len(head) > COUNT else 0
        while len(nodes) < count:
            line, whole, _ = next(rows, (line, [], []))
            if not whole:
                raise file_error(path, f"element {head[NUMBER]} has {len(nodes)} nodes instead of {count}", line)
            nodes += _integers(path, line, whole)
        if len(head) <= HEAD or head[TYPE] not in routines:
            raise file_error(path, "the element has no nodes, or a type that no ET defines", line)
        needed = SOLIDS.get(routines[head[TYPE]], 0)
        if not needed:
            continue
        if not any(nodes[(corners := CORNERS.get(needed, needed)) :]):
            needed = corners  # all mid-edge nodes omitted
            nodes = nodes[:needed]
        if len(nodes) != needed or 0 in nodes:
            have = len(nodes) - nodes.count(0)
            raise file_error(path, f"element {head[NUMBER]} has {have} nodes, but its type needs {needed}", line)
        kind, own = KINDS[needed], range(needed)
        for other, members, pairs in COLLAPSED.get(needed, ()):
            if all(nodes[a] == nodes[b] for a, b in pairs):
                kind, own = other, members
                break
        yield kind, [nodes[k] for k in own]


def _integers(path: str | Path, line: int, words: list[str]) -> list[int]:
    try:
        return [int(word) for word in words]
    except ValueError:
        raise file_error(path, f"integers are expected here, not `{' '.join(words)[:60]}`", line) from None


def _place(path: str | Path, line: int, words: list[str]) -> list[float]:
    """Return a position; trailing zeros are omitted in the file."""
    try:
        return [number(word) for word in (*words[:3], "", "", "")[:3]]
    except ValueError:
        raise file_error(path, f"x, y, z of a node must be numbers, not `{' '.join(words[:3])[:60]}`", line) from None
