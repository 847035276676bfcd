"""Decks of parts and instances, as Abaqus/CAE writes them."""

from __future__ import annotations

from collections.abc import Callable, Sequence

import numpy as np

from components.fe.formats.keywords import Block
from components.fe.formats.text import number, wrong

Move = Callable[[np.ndarray], np.ndarray]


def instance_of(deck: Sequence[Block]) -> tuple[list[Block], Move]:
    """Return the blocks of the one instance of a deck, and how it is placed in the assembly.

    Parameters
    ----------
    deck : sequence of Block
        Without parts it is returned as it is.

    Returns
    -------
    blocks : list of Block
        Nodes and elements of the instance's part, or of the instance.
    move : function
        Maps positions (n, 3) of the part to those in the assembly.

    Raises
    ------
    DeclarationError
        If there are several instances, or nodes beside it: Abaqus numbers the nodes of its matrices anew then.
    """
    instances = [block for block in deck if block.keyword == "INSTANCE"]
    if not instances:
        return list(deck), lambda places: places
    if len(instances) > 1:
        raise wrong(
            instances[1].path,
            "there are several instances, whose nodes Abaqus numbers anew; write the deck without parts and assembly",
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
        what = f"*{beside.keyword} stands beside the instance; Abaqus numbers nodes anew then: leave it out for the matrices"
        raise wrong(beside.path, what, beside.line)
    return inside, _placing(one)


def _within(deck: Sequence[Block], keyword: str) -> list[list[Block]]:
    """The blocks from each `*PART` to `*END PART`."""
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
    """The translation of the first data line, then the turn by an angle in degrees about two points of the second."""
    try:
        rows = [[number(entry) for entry in entries] for _, entries in instance.data]
        shift, turn = rows[0] if rows else [0.0] * 3, rows[1] if len(rows) > 1 else None
        if len(shift) != 3 or (turn is not None and len(turn) != 7):
            raise ValueError
    except ValueError:
        raise wrong(
            instance.path, "an instance is placed by x, y, z and by two points and an angle", instance.line
        ) from None
    if turn is None:
        return lambda places: places + shift
    first, second, angle = np.array(turn[:3]), np.array(turn[3:6]), np.radians(turn[6])
    axis = second - first
    size = np.linalg.norm(axis)
    if size == 0:
        raise wrong(instance.path, "the two points of the axis of an instance are the same", instance.line)
    e = axis / size
    skew = np.array([[0, -e[2], e[1]], [e[2], 0, -e[0]], [-e[1], e[0], 0]])
    R = np.eye(3) + np.sin(angle) * skew + (1 - np.cos(angle)) * skew @ skew
    return lambda places: (places + shift - first) @ R.T + first
