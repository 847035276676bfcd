"""Text of a SID file: nested blocks and matrices that are linear in the modal coordinates."""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np

from components.fe.formats.text import file_error, number, text_of

BLOCKS = ("part", "modal", "refmod", "frame", "node")
MATRICES = (
    "origin",
    "phi",
    "psi",
    "AP",
    "sigma",
    "mdCM",
    "J",
    "Ct",
    "Cr",
    "Me",
    "Gr",
    "Ge",
    "Oe",
    "ksigma",
    "Ke",
    "De",
)
ENTRY = re.compile(r"m([01])\s*\(([\d\s,]+)\)")
SYMMETRIC, UNIT = 2, 4
DIGITS = 1e-6  # relative tolerance of consistency checks, for files written with few digits
LARGEST = 10**8  # entries of a matrix; Ge for 2000 modes has a third of them
# Positions of row, column and mode in m1(., ., .): they differ between the programs that write SID files.
ORDERS = ((0, 2, 1), (0, 1, 2), (1, 2, 0))


@dataclass
class Block:
    """A named block, from its name to its end.

    Parameters
    ----------
    name, value : str
        "node" and "tip" of `new node = tip`.
    line : int
        First line.
    settings : dict
        Line and text of each setting by its name.
    parts : list of Block
        Inner blocks.
    """

    name: str
    value: str
    line: int
    settings: dict[str, tuple[int, str]] = field(default_factory=dict)
    parts: list[Block] = field(default_factory=list)

    def named(self, name: str) -> list[Block]:
        """Return the inner blocks with this name."""
        return [part for part in self.parts if part.name == name]


def read_tree(path: str | Path) -> Block:
    """Return the outermost block of a file; lines above `part` are a heading and ignored.

    Raises
    ------
    DeclarationError
        If the file is not a SID, or a block does not end.
    """
    top = Block("", "", 0)
    stack = [top]
    lines = [" ".join(line.split("!")[0].split()) for line in text_of(path, "a SID").splitlines()]
    begin = lines.index("part") if "part" in lines else 0
    for place, text in enumerate(lines[begin:], begin + 1):
        if not text:
            continue
        words = text.removeprefix("new ").partition("=")
        name, value = words[0].strip(), words[2].strip()
        if text.startswith("end"):
            _end(path, stack, place, text)
        elif words[1] and name not in BLOCKS:
            stack[-1].settings["".join(name.split())] = (place, value)
        elif name in BLOCKS + MATRICES:
            stack[-1].parts.append(Block(name, value, place))
            stack.append(stack[-1].parts[-1])
        else:
            raise file_error(
                path, f"a SID block (part, new modal, frame, mdCM, ...) is expected, not `{text[:60]}`", place
            )
    if len(stack) > 1:
        raise file_error(
            path, f"the file is truncated: it ends inside `{stack[-1].name}`, which begins in line {stack[-1].line}"
        )
    return top


@dataclass(frozen=True)
class Taylor:
    """A matrix M0 + sum over b of M1_b q_b.

    Parameters
    ----------
    constant : array (rows, columns)
        M0.
    linear : array (modes, rows, columns)
        M1.
    """

    constant: np.ndarray
    linear: np.ndarray

    def lines(self, name: str, indent: str) -> Iterator[str]:
        """Yield the lines of a SID file for this matrix."""
        (rows, columns), n = self.constant.shape, len(self.linear)
        order = int(self.linear.any())
        head = {"order": order, "nrow": rows, "ncol": columns, "nq": n, "nqn": 0, "structure": 3}
        yield f"{indent}{name}"
        yield from (f"{indent}   {key:<12} = {value}" for key, value in head.items())
        for i, j in np.ndindex(rows, columns):
            yield f"{indent}   m0({i + 1:4d},{j + 1:4d}) = {self.constant[i, j]:.17g}"
        for b, i, j in zip(*np.nonzero(self.linear), strict=True):
            yield f"{indent}   m1({i + 1:4d},{b + 1:4d},{j + 1:4d}) = {self.linear[b, i, j]:.17g}"
        yield f"{indent}end {name}"


def taylor(path: str | Path, block: Block, order: tuple[int, ...]) -> Taylor:
    """Return the matrix of a block; the file omits zeros.

    Parameters
    ----------
    path : str or Path
        The file, for messages.
    block : Block
        With order, nrow, ncol, nq, structure and entries.
    order : tuple
        Positions of row, column and mode among the indices of m1; one of `ORDERS`.

    Raises
    ------
    DeclarationError
        If an entry is outside the matrix or not a number.
    """
    rows, columns, n, structure = (_whole(path, block, name) for name in ("nrow", "ncol", "nq", "structure"))
    if rows * columns * (n + 1) > LARGEST:
        raise file_error(
            path, f"`{block.name}` is {rows} x {columns} with {n} modes, too large for a reduced body", block.line
        )
    constant, linear = np.zeros((rows, columns)), np.zeros((n, rows, columns))
    if structure == UNIT:
        constant = np.eye(rows, columns)
    for name, (line, text) in block.settings.items():
        entry = ENTRY.fullmatch(name)
        if not entry:
            continue
        index = [int(word) - 1 for word in entry[2].split(",") if word]
        try:
            value = number(text)
            if len(index) != 2 + int(entry[1]) or min(index) < 0:
                raise IndexError
            if entry[1] == "0":
                constant[tuple(index)] = value
            else:
                linear[index[order[2]], index[order[0]], index[order[1]]] = value
        except ValueError:
            raise file_error(path, f"{name} is `{text[:60]}`, not a finite number", line) from None
        except IndexError:
            size = f"{rows} x {columns} with {n} modes"
            raise file_error(path, f"{name} is outside {block.name}, which is {size}", line) from None
    if structure == SYMMETRIC:
        constant, linear = (np.where(m != 0, m, np.swapaxes(m, -1, -2)) for m in (constant, linear))
    return Taylor(constant, linear)


def index_order(path: str | Path, nodes: Sequence[Block]) -> tuple[int, ...]:
    """Return the order of the indices of m1 for which M1 of origin equals M0 of phi, as the kinematics require."""
    for node in nodes:
        (origin,), (phi,) = node.named("origin"), node.named("phi")
        shape, indices = taylor(path, phi, ORDERS[0]).constant, _linear_indices(origin)
        if not indices or not shape.any():
            continue
        most = (3, 1, shape.shape[1])
        for order in ORDERS:
            if all(len(i) == 3 and all(i[order[k]] <= most[k] for k in range(3)) for i in indices):
                moved = taylor(path, origin, order).linear[:, :, 0].T
                if moved.shape == shape.shape and np.allclose(moved, shape, atol=DIGITS * np.abs(shape).max()):
                    return order
        raise file_error(
            path, "m1 of `origin` differs from m0 of `phi`: the node would not move by its mode shapes", origin.line
        )
    return ORDERS[0]


def _linear_indices(block: Block) -> list[list[int]]:
    entries = [ENTRY.fullmatch(name) for name in block.settings]
    return [[int(word) for word in entry[2].split(",") if word] for entry in entries if entry and entry[1] == "1"]


def _end(path: str | Path, stack: list[Block], line: int, text: str) -> None:
    name = text.removeprefix("end").strip()
    if len(stack) == 1 or (name and name != stack[-1].name):
        expected = f"`end {stack[-1].name}`" if len(stack) > 1 else "a block"
        raise file_error(path, f"{expected} is expected here, not `{text[:60]}`", line)
    stack.pop()


def _whole(path: str | Path, block: Block, name: str) -> int:
    line, text = block.settings.get(name, (block.line, ""))
    if not text.isdecimal():
        raise file_error(path, f"`{block.name}` needs an integer {name}{f', not `{text[:60]}`' if text else ''}", line)
    return int(text)
