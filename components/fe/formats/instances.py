"""Abaqus input files with parts and instances, as Abaqus/CAE writes them."""

from __future__ import annotations

from collections.abc import Callable, Sequence

import numpy as np

from components.fe.formats.keywords import Block
from components.fe.formats.text import file_error, number

Move = Callable[[np.ndarray], np.ndarray]


def instance_of(deck: Sequence[Block]) -> tuple[list[Block], Move]:
    """Return the blocks of the only instance of a deck and the map from its part to the assembly.

    Parameters
    ----------
    deck : sequence of Block
        A deck without parts is returned unchanged.

    Returns
    -------
    blocks : list of Block
        Nodes and elements of the instance's part, or of the instance.
    move : function
        Maps positions (n, 3) in the axes of the part to those of the assembly.

    Raises
    ------
    DeclarationError
        If there are several instances, or nodes outside the instance: Abaqus then renumbers the nodes in its matrices.
    """
    instances = [block for block in deck if block.keyword == "INSTANCE"]
    if not instances:
        return list(deck), lambda places: places
    if len(instances) > 1:
        raise file_error(
            instances[1].path,
            "there are several instances, whose nodes Abaqus renumbers; write the deck without parts and assembly",
            instances[1].line,
        )
    one = instances[0]
    part = [
        b for b in _within(deck, "PART") if b[0].options.get("NAME", "").upper() == one.options.get("PART", "").upper()
    ]
    own = next(inside for begin, *inside in _within(deck, "INSTANCE") if begin is one)
    inside = [*(part[0][1:] if part else ()), *own]
    held = {id(block) for group in (*_within(deck, "PART"), *_within(deck, "INSTANCE")) for block in group}
    beside = next((b for b in deck if b.keyword in ("NODE", "ELEMENT") and id(b) not in held), None)
    if beside is not None:
        what = f"*{beside.keyword} outside the instance makes Abaqus renumber the nodes; omit it to write the matrices"
        raise file_error(beside.path, what, beside.line)
    return inside, _placing(one)


def _within(deck: Sequence[Block], keyword: str) -> list[list[Block]]:
    """Return the blocks between each `*PART` and its `*END PART`, or those of another keyword."""
    groups: list[list[Block]] = []
    inside = False
    for block in deck:
        if block.keyword == keyword:
            groups.append([])
            inside = True
        elif block.keyword == f"END {keyword}":
            inside = False
        if inside:
            groups[-1].append(block)
    return groups


def _placing(instance: Block) -> Move:
    """Return the map to the assembly: the translation in the first data line, then the rotation in the second.

    The rotation is given by two points on its axis and an angle in degrees.
    """
    try:
        rows = [[number(entry) for entry in entries] for _, entries in instance.data]
        shift, turn = rows[0] if rows else [0.0] * 3, rows[1] if len(rows) > 1 else None
        if len(shift) != 3 or (turn is not None and len(turn) != 7):
            raise ValueError
    except ValueError:
        raise file_error(
            instance.path, "an instance needs a translation x, y, z, or also two points and an angle", instance.line
        ) from None
    if turn is None:
        return lambda places: places + shift
    first, second, angle = np.array(turn[:3]), np.array(turn[3:6]), np.radians(turn[6])
    axis = second - first
    size = np.linalg.norm(axis)
    if size == 0:
        raise file_error(instance.path, "the two points on the rotation axis of an instance coincide", instance.line)
    e = axis / size
    skew = np.array([[0, -e[2], e[1]], [e[2], 0, -e[0]], [-e[1], e[0], 0]])
    R = np.eye(3) + np.sin(angle) * skew + (1 - np.cos(angle)) * skew @ skew
    return lambda places: (places + shift - first) @ R.T + first
