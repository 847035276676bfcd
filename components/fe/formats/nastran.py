"""Nastran: matrices of an OP4 file, nodes of the bulk data."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import scipy.sparse as sp

from components.fe.formats.matrices import Matrices, mirrored
from components.fe.formats.text import file_error
from components.fe.formats.third_party import call_reader, existing_file, optional_module
from components.fe.nodes import Nodes

DECKS = (".bdf", ".dat", ".nas", ".blk")
FREEDOMS = 6  # degrees of freedom of a grid point
# meshio's name and node order by card and number of nodes; Nastran orders the vertical edges before the upper face.
CARDS = {
    "CTETRA": {4: ("tetra", range(4)), 10: ("tetra10", range(10))},
    "CHEXA": {8: ("hexahedron", range(8)), 20: ("hexahedron20", (*range(12), *range(16, 20), *range(12, 16)))},
    "CPENTA": {6: ("wedge", range(6)), 15: ("wedge15", (*range(9), *range(12, 15), *range(9, 12)))},
}


def read_nastran(path: str | Path, *, length: float = 1.0, mass: float = 1.0) -> Matrices:
    """Read mass matrix, stiffness matrix and nodes of a Nastran job: KGG and MGG of an OP4 file, and the bulk data.

    The unit of time must be the second. K, a force per length, is a mass per s2 and scales with `mass`, as M does.

    Parameters
    ----------
    path : str or Path
        NAME.op4, binary or formatted, with one matrix whose name begins with K and one whose name begins with M. Both
        have six equations for each grid point in ascending order of their numbers, or only the three displacements.
        NAME.bdf (or .dat, .nas, .blk) with GRID and CORD2 cards must be in the same folder.
    length : float
        Unit of length of the job in m: 1e-3 for mm. Scales the nodes.
    mass : float
        Unit of mass of the job in kg: 1e3 for mm, N, s, where the unit is the Mg. Scales M and K. Jobs with weight
        densities need PARAM,WTMASS.

    Returns
    -------
    M, K : sparse (3 n, 3 n)
        In kg and N/m; equations x, y, z of each node, in the basic coordinate system.
    nodes : Nodes (n, 3)
        Positions in m, in ascending order of the grid point numbers `nodes.numbers`. Grid points without elements,
        mass and stiffness are omitted.

    Raises
    ------
    DeclarationError
        If a file is missing, truncated or of another format, a grid point has a displacement coordinate system,
        rotations have stiffness or mass, or pyyeti is not installed (`pip install 'acausal[nastran]'`).
    """
    file = existing_file(path, "matrices of Nastran")
    deck = next((file.with_suffix(end) for end in DECKS if file.with_suffix(end).is_file()), None)
    if deck is None:
        raise file_error(
            file, f"there is no {file.stem}.bdf (or {', '.join(DECKS[1:])}) with the grid points in its folder"
        )
    op4 = optional_module("pyyeti.nastran.op4", "nastran", "reading an OP4 file")
    found = call_reader(lambda: op4.read(str(file), sparse=True), file, "an OP4 file")
    numbers, places, cells = _grid(deck)
    M, K = (_displacements(file, *_named(file, found, letter), numbers) for letter in "mk")
    used = (abs(M) + abs(K)).diagonal().reshape(-1, 3).any(axis=1)
    used[[row for rows in cells.values() for row in np.ravel(rows)]] = True
    keep, rows = used.repeat(3), np.cumsum(used) - 1
    cells = {kind: rows[np.array(members)] for kind, members in cells.items()}
    M, K = (mass * matrix[keep][:, keep] for matrix in (M, K))
    return M, K, Nodes(length * places[used], numbers[used], cells)


def _named(path: Path, found: dict[str, Any], letter: str) -> tuple[str, Any]:
    names = [name for name in found if name.lower().startswith(letter)]
    if len(names) != 1:
        have = ", ".join(name.upper() for name in found) or "none"
        raise file_error(path, f"exactly one matrix name must begin with {letter.upper()}; the file has {have}")
    return names[0].upper(), found[names[0]]


def _displacements(path: Path, name: str, matrix: Any, numbers: np.ndarray) -> Any:
    """Return the matrix of the displacements; rotations, if present, must have no entries."""
    n, shape = numbers.size, matrix.shape
    matrix = sp.csr_array(matrix)
    matrix.eliminate_zeros()
    if np.iscomplexobj(matrix.data) or not np.isfinite(matrix.data).all():
        raise file_error(path, f"{name} has complex or non-finite entries")
    if shape == (FREEDOMS * n, FREEDOMS * n):
        turning = np.arange(FREEDOMS * n) % FREEDOMS >= 3
        bad = np.flatnonzero(turning & ((np.diff(matrix.indptr) > 0) | (np.diff(matrix.tocsc().indptr) > 0)))
        if bad.size:
            what = f"{name} has entries for a rotation of grid point {numbers[bad[0] // FREEDOMS]}"
            raise file_error(path, f"{what}; only solids are supported, whose degrees of freedom are displacements")
        matrix = matrix[~turning][:, ~turning]
    elif shape != (3 * n, 3 * n):
        size = f"{shape[0]} x {shape[1]}"
        raise file_error(
            path,
            f"{name} is {size}, but {n} grid points have {FREEDOMS * n} equations, or {3 * n} without rotations",
        )
    return mirrored(matrix) if not sp.tril(matrix, -1).nnz or not sp.triu(matrix, 1).nnz else matrix


def _grid(path: Path) -> tuple[np.ndarray, np.ndarray, dict[str, list[list[int]]]]:
    """Return grid point numbers, positions in the basic coordinate system, and elements as rows of these."""
    bulk = optional_module("pyyeti.nastran.bulk", "nastran", "reading bulk data of Nastran")
    what = "Nastran bulk data with GRID cards"
    uset, _ = call_reader(lambda: bulk.bulk2uset(str(path), encoding="latin_1"), path, what)
    index, values = uset.index.to_numpy(), uset[["x", "y", "z"]].to_numpy(dtype=float)
    numbers = np.array([point for point, _ in index], dtype=np.int64)[::FREEDOMS]
    if len(index) != FREEDOMS * numbers.size or not np.isfinite(values).all():
        raise file_error(path, "the grid points include scalar points or positions that are not finite")
    if not numbers.size:
        raise file_error(path, "there are no GRID cards in this file")
    turned = (values[3::6] != np.eye(3)[0]).any(axis=1) | (values[4::6] != np.eye(3)[1]).any(axis=1)
    if turned.any():
        raise file_error(
            path, f"grid point {numbers[turned][0]} has a displacement coordinate system (CD), which is not supported"
        )
    order = np.argsort(numbers, kind="stable")
    rows = {int(name): row for row, name in enumerate(numbers[order])}
    cells: dict[str, list[list[int]]] = {}
    for card, kinds in CARDS.items():
        read = call_reader(
            lambda card=card: bulk.rdcards(str(path), card, return_var="list", no_data_return=[], encoding="latin_1"),
            path,
            what,
        )
        for _, _, *names in read:
            names = [rows[name] for name in names if name in rows]
            kind, places = kinds.get(len(names), ("", ()))
            if kind:
                cells.setdefault(kind, []).append([names[place] for place in places])
    return numbers[order], values[::FREEDOMS][order], cells
