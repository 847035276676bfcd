"""Matrices of CalculiX: what `*FREQUENCY, SOLVER=MATRIXSTORAGE` writes, and the nodes of the input file."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np

from components.fe.formats.keywords import blocks, cells_of, elements, node_positions
from components.fe.formats.matrices import Matrices, condensed, from_entries, placed
from components.fe.formats.text import table, text_of, whole_numbers, wrong
from components.fe.nodes import Nodes

SUFFIXES = (".inp", ".sti", ".mas", ".dof")
INTERNAL = 3  # nodes that CalculiX adds for the incompatible modes of a C3D8I


def read_calculix(path: str | Path, *, length: float = 1.0, mass: float = 1.0) -> Matrices:
    """Return mass and stiffness matrix and nodes of a CalculiX job with `*FREQUENCY, SOLVER=MATRIXSTORAGE`.

    The unit of time is the second: K, in force per length, is a mass per s2 and scales as M does, by `mass` alone.

    Incompatible modes of C3D8I are condensed, K_bb - K_bi inv(K_ii) K_ib, and the mass that CalculiX gives them is left
    out: it is not physical. Equations that are missing because nodes are held or depend on others stay empty in both
    matrices, and `reduce_body` refuses such a body and names the nodes; nodes without elements are left out.

    Parameters
    ----------
    path : str or Path
        One of the files NAME.inp, NAME.sti, NAME.mas, NAME.dof, or NAME; all four stand side by side.
    length : float
        Unit of length of the job in m: 1e-3 for mm. Nodes are multiplied by it.
    mass : float
        Unit of mass of the job in kg: 1e3 for mm, N, s, where the unit is the Mg. M and K are multiplied by it.

    Returns
    -------
    M, K : sparse (3 n, 3 n)
        In kg and N/m; equations x, y, z of each node, in the axes of the job.
    nodes : Nodes (n, 3)
        In m, in ascending order of their numbers, which `nodes.numbers` holds.

    Raises
    ------
    DeclarationError
        If a file is missing, cut off or of another kind, or the body has freedoms other than displacements.
    """
    inp, sti, mas, dof = _files(Path(path))
    deck = list(blocks(inp))
    places, found = node_positions(deck), list(elements(deck))
    names, directions = _equations(dof)
    added = 3 * INTERNAL * sum(kind.startswith("C3D8I") for kind, _ in found)
    inner = names > max(places)
    if np.count_nonzero(inner) != added:
        raise wrong(
            dof,
            f"{np.count_nonzero(inner)} equations belong to nodes that {inp.name} does not have, and incompatible modes of "
            f"C3D8I are {added} of them; only solid elements are read, not shells, beams or membranes, which CalculiX expands",
        )
    M, K = (_matrix(file, names.size) for file in (mas, sti))
    if added:
        try:
            K = condensed(K, inner)
        except np.linalg.LinAlgError:
            raise wrong(sti, "the equations of the incompatible modes cannot be condensed: they are singular") from None
        M, names, directions = M[~inner][:, ~inner], names[~inner], directions[~inner]
    numbers = np.unique(np.concatenate([names, [node for _, nodes in found for node in nodes]]).astype(np.int64))
    missing = [name for name in numbers.tolist() if name not in places]
    if missing:
        raise wrong(inp, f"node {missing[0]} has equations or elements, but no place under *NODE")
    equations = 3 * np.searchsorted(numbers, names) + directions
    M, K = (mass * placed(matrix, equations, 3 * numbers.size) for matrix in (M, K))
    cells = cells_of(found, {name: row for row, name in enumerate(numbers.tolist())})
    return M, K, Nodes(length * np.array([places[name] for name in numbers.tolist()]), numbers, cells)


def _files(path: Path) -> list[Path]:
    known = path.suffix.lower() in SUFFIXES
    stem = path.with_suffix("") if known else path
    return [path if known and path.suffix.lower() == end else Path(f"{stem}{end}") for end in SUFFIXES]


def _equations(path: Path) -> tuple[np.ndarray, np.ndarray]:
    """Number of the node of each equation, and its direction 0, 1, 2."""
    names, directions = [], []
    text = text_of(path, "a list of equations of CalculiX")
    for line, entry in enumerate(text.splitlines(), 1):
        name, point, direction = entry.strip().partition(".")
        if not (point and name.isdecimal() and direction.isdecimal()):
            raise wrong(path, f"a line holds node.direction, such as 12.3, not `{entry.strip()[:60]}`", line)
        if direction not in ("1", "2", "3"):
            raise wrong(
                path, f"node {name} has a freedom {direction} that is no displacement; only solids are read", line
            )
        names.append(int(name))
        directions.append(int(direction) - 1)
    if not text.endswith("\n"):
        raise wrong(path, "the last line has no end, so the file seems to be cut off")
    pairs = np.array([names, directions])
    if np.unique(pairs, axis=1).shape[1] < len(names):
        raise wrong(path, "an equation stands twice in this file")
    return pairs[0], pairs[1]


def _matrix(path: Path, n: int) -> Any:
    values = table(path, "a matrix of CalculiX", "row, column, value")
    index = whole_numbers(path, values[:, :2], "row and column") - 1
    return from_entries(path, index[:, 0], index[:, 1], values[:, 2], n)
