"""CalculiX: matrices of `*FREQUENCY, SOLVER=MATRIXSTORAGE`, nodes of the input file."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np

from components.fe.formats.keywords import blocks, cells_of, elements, node_positions
from components.fe.formats.matrices import Matrices, condensed, from_entries, placed
from components.fe.formats.text import LARGEST, file_error, table, text_of, whole_numbers
from components.fe.nodes import Nodes

SUFFIXES = (".inp", ".sti", ".mas", ".dof")
INTERNAL = 3  # nodes that CalculiX adds for the incompatible modes of a C3D8I


def read_calculix(path: str | Path, *, length: float = 1.0, mass: float = 1.0) -> Matrices:
    """Read mass matrix, stiffness matrix and nodes of a CalculiX job with `*FREQUENCY, SOLVER=MATRIXSTORAGE`.

    The unit of time must be the second. K, a force per length, is a mass per s2 and scales with `mass`, as M does.

    Incompatible modes of C3D8I are condensed, K_bb - K_bi inv(K_ii) K_ib, without the unphysical mass that CalculiX
    gives them. Equations of fixed or dependent nodes are empty in both matrices; `reduce_body` then refuses the body
    and names the nodes. Nodes without elements are omitted.

    Parameters
    ----------
    path : str or Path
        One of the files NAME.inp, NAME.sti, NAME.mas, NAME.dof, or NAME; all four must be in one folder.
    length : float
        Unit of length of the job in m: 1e-3 for mm. Scales the nodes.
    mass : float
        Unit of mass of the job in kg: 1e3 for mm, N, s, where the unit is the Mg. Scales M and K.

    Returns
    -------
    M, K : sparse (3 n, 3 n)
        In kg and N/m; equations x, y, z of each node, in the axes of the job.
    nodes : Nodes (n, 3)
        Positions in m, in ascending order of the node numbers `nodes.numbers`.

    Raises
    ------
    DeclarationError
        If a file is missing, truncated or of another format, or nodes have degrees of freedom other than displacements.
    """
    inp, sti, mas, dof = _files(Path(path))
    deck = list(blocks(inp))
    places, found = node_positions(deck), list(elements(deck))
    names, directions = _equations(dof)
    added = 3 * INTERNAL * sum(kind.startswith("C3D8I") for kind, _ in found)
    inner = names > max(places)
    if np.count_nonzero(inner) != added:
        raise file_error(
            dof,
            f"{np.count_nonzero(inner)} equations belong to nodes not in {inp.name}, but C3D8I accounts for {added} of "
            "them; only solids are supported, not shells, beams or membranes, which CalculiX expands",
        )
    M, K = (_matrix(file, names.size) for file in (mas, sti))
    if added:
        try:
            K = condensed(K, inner)
        except np.linalg.LinAlgError:
            raise file_error(
                sti, "the equations of the incompatible modes are singular and cannot be condensed"
            ) from None
        M, names, directions = M[~inner][:, ~inner], names[~inner], directions[~inner]
    numbers = np.unique(np.concatenate([names, [node for _, nodes in found for node in nodes]]).astype(np.int64))
    missing = [name for name in numbers.tolist() if name not in places]
    if missing:
        raise file_error(inp, f"node {missing[0]} has equations or elements, but no position under *NODE")
    equations = 3 * np.searchsorted(numbers, names) + directions
    M, K = (mass * placed(matrix, equations, 3 * numbers.size) for matrix in (M, K))
    cells = cells_of(found, {name: row for row, name in enumerate(numbers.tolist())})
    return M, K, Nodes(length * np.array([places[name] for name in numbers.tolist()]), numbers, cells)


def _files(path: Path) -> list[Path]:
    known = path.suffix.lower() in SUFFIXES
    stem = path.with_suffix("") if known else path
    return [path if known and path.suffix.lower() == end else Path(f"{stem}{end}") for end in SUFFIXES]


def _equations(path: Path) -> tuple[np.ndarray, np.ndarray]:
    """Return the node number and the direction 0, 1, 2 of each equation."""
    names, directions = [], []
    text = text_of(path, "a list of equations of CalculiX")
    for line, entry in enumerate(text.splitlines(), 1):
        name, point, direction = entry.strip().partition(".")
        if not (point and name.isdecimal() and direction.isdecimal()):
            raise file_error(path, f"a line must be node.direction, such as 12.3, not `{entry.strip()[:60]}`", line)
        if int(name) > LARGEST:
            raise file_error(path, f"the node number {name[:60]} is too large", line)
        if direction not in ("1", "2", "3"):
            raise file_error(
                path,
                f"node {name} has the degree of freedom {direction}, which is not a displacement; only solids are supported",
                line,
            )
        names.append(int(name))
        directions.append(int(direction) - 1)
    if not text.endswith("\n"):
        raise file_error(path, "the last line is incomplete; the file seems to be truncated")
    pairs = np.array([names, directions])
    if np.unique(pairs, axis=1).shape[1] < len(names):
        raise file_error(path, "an equation occurs twice in this file")
    return pairs[0], pairs[1]


def _matrix(path: Path, n: int) -> Any:
    values = table(path, "a matrix of CalculiX", "row, column, value")
    index = whole_numbers(path, values[:, :2], "row and column") - 1
    return from_entries(path, index[:, 0], index[:, 1], values[:, 2], n)
