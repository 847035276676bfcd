"""Matrices of Abaqus: what `*MATRIX OUTPUT` writes, and the nodes of the input file."""

from __future__ import annotations

import re
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np
import scipy.sparse as sp

from acausal import DeclarationError
from components.fe.formats.instances import instance_of
from components.fe.formats.keywords import blocks, cells_of, elements, node_positions
from components.fe.formats.matrices import Matrices, from_entries, rigid_forces
from components.fe.formats.text import table, text_of, whole_numbers, wrong
from components.fe.nodes import Nodes

FILE = re.compile(r"(?P<job>.+)_(?P<kind>STIF|MASS)(?P<step>\d*)\.mtx", re.IGNORECASE)
BEGINNING = 10_000  # characters with the heading of a matrix and its first entry
HELD = 1e36  # what Abaqus adds to the diagonal where a boundary condition holds a node
# Of the forces that hold each entry's share: far above rounding of 15 digits, far below any other order of equations.
RIGID = 1e-6


def read_abaqus(path: str | Path | Sequence[str | Path], *, length: float = 1.0, mass: float = 1.0) -> Matrices:
    """Return mass and stiffness matrix and nodes of an Abaqus job with `*MATRIX GENERATE, STIFFNESS, MASS`.

    `*MATRIX OUTPUT, STIFFNESS, MASS` with FORMAT=MATRIX INPUT (or LABELS), in which every entry names its nodes, or
    FORMAT=COORDINATE, in which equations are taken as x, y, z of the nodes in ascending order of their numbers. That the
    stiffness resists no rigid motion of the nodes shows whether they belong to the equations.

    The unit of time is the second: K, in force per length, is a mass per s2 and scales as M does, by `mass` alone.
    Equations of held nodes, to whose diagonal Abaqus adds 1e36, are left empty in both matrices, and `reduce_body` refuses
    such a body and names the nodes.

    Parameters
    ----------
    path : str, Path or sequence of three
        JOB.inp, JOB or one of the matrices: JOB_STIF1.mtx and JOB_MASS1.mtx (the number is that of the step) stand
        beside JOB.inp. Files of other names, or in other folders, are given as three: mass matrix, stiffness matrix, input
        file. A deck of parts is read where it has one instance.
    length : float
        Unit of length of the job in m: 1e-3 for mm. Nodes are multiplied by it.
    mass : float
        Unit of mass of the job in kg: 1e3 for mm, N, s, where the unit is the Mg. M and K are multiplied by it.

    Returns
    -------
    M, K : sparse (3 n, 3 n)
        In kg and N/m; equations x, y, z of each node, in the global axes.
    nodes : Nodes (n, 3)
        In m, in ascending order of their numbers, which `nodes.numbers` holds.

    Raises
    ------
    DeclarationError
        If a file is missing, cut off or of another kind, the body has freedoms other than displacements, or the nodes do
        not belong to the equations.
    """
    masses, stiffness, inp = _files(Path(path)) if isinstance(path, str | Path) else _three(path)
    deck, move = instance_of(list(blocks(inp)))
    places, found = node_positions(deck), list(elements(deck))
    numbers = np.unique(np.array([node for _, nodes in found for node in nodes], dtype=np.int64))
    missing = [name for name in numbers.tolist() if name not in places]
    if missing or not numbers.size:
        what = f"node {missing[0]} has elements, but no place under *NODE" if missing else "there are no elements"
        raise wrong(inp, what)
    nodes = move(np.array([places[name] for name in numbers.tolist()]))
    n = 3 * numbers.size
    K, M = (_matrix(file, numbers) for file in (stiffness, masses))
    held = K.diagonal() >= HELD / 2
    if held.any():
        free = sp.diags_array((~held).astype(float))
        M, K = (free @ matrix @ free for matrix in (M, K))
    elif (force := rigid_forces(K, nodes)) > RIGID:
        raise wrong(
            stiffness,
            f"the {n} equations resist rigid motions of the nodes ({force:.1g} of the largest forces): the equations are in "
            f"another order than the nodes in {inp.name}, or a spring or contact holds the body; FORMAT=MATRIX INPUT names nodes",
        )
    cells = cells_of(found, {name: row for row, name in enumerate(numbers.tolist())})
    return mass * M, mass * K, Nodes(length * nodes, numbers, cells)


def is_abaqus(path: str | Path) -> bool:
    """Return whether a file is a matrix of Abaqus, by its name, or such files stand beside it."""
    path = Path(path)
    return bool(FILE.fullmatch(path.name)) or bool(_beside(path.parent, path.stem, "STIF"))


def _three(paths: Sequence[str | Path]) -> list[Path]:
    files = [Path(path) for path in paths]
    if len(files) != 3:
        raise DeclarationError("files of Abaqus are three: mass matrix, stiffness matrix, input file")
    return files


def _files(path: Path) -> list[Path]:
    """The mass matrix, the stiffness matrix and the input file."""
    named = FILE.fullmatch(path.name)
    job = named["job"] if named else path.stem if path.suffix.lower() == ".inp" else path.name
    found = []
    for kind in ("STIF", "MASS"):
        files = _beside(path.parent, job, kind)
        if named and len(files) > 1:
            files = [file for file in files if FILE.fullmatch(file.name)["step"] == named["step"]]  # pyright: ignore
        if len(files) > 1:
            raise wrong(
                path, f"there are several matrices, {', '.join(file.name for file in files)}; give the name of one"
            )
        if not files:
            raise wrong(path, f"there is no matrix {job}_{kind}1.mtx in its folder")
        found += files
    inp = path if path.suffix.lower() == ".inp" else path.parent / f"{job}.inp"
    return [*found[::-1], inp]


def _beside(folder: Path, job: str, kind: str) -> list[Path]:
    files = sorted(folder.iterdir()) if folder.is_dir() else []
    matches = ((FILE.fullmatch(file.name), file) for file in files)
    return [file for match, file in matches if match and match["job"] == job and match["kind"].upper() == kind]


def _matrix(path: Path, numbers: np.ndarray) -> Any:
    """The matrix with the equations of these nodes."""
    n = 3 * numbers.size
    columns = _columns(path)
    if columns == 3:
        values = table(path, "a matrix of Abaqus", "row, column, value", comments="*")
        index = whole_numbers(path, values[:, :2], "row and column") - 1
        if index.max() + 1 != n:
            raise wrong(path, f"there are {index.max() + 1} equations, where {n // 3} nodes with elements have {n}")
    else:
        values = table(path, "a matrix of Abaqus", "node, freedom, node, freedom, value", comments="*")
        names = whole_numbers(path, values[:, :4], "nodes and freedoms")
        index = _equations(path, names.reshape(-1, 2), numbers).reshape(-1, 2)
    return from_entries(path, index[:, 0], index[:, 1], values[:, -1], n, full=False)


def _columns(path: Path) -> int:
    lines = text_of(path, "a matrix of Abaqus")[:BEGINNING].splitlines()
    data: Sequence[str] = next(
        (line.replace(",", " ").split() for line in lines if line.strip() and line[0] != "*"), ()
    )
    return 3 if len(data) == 3 else 5


def _equations(path: Path, pairs: np.ndarray, numbers: np.ndarray) -> np.ndarray:
    names, freedoms = pairs.T
    if names.min() <= 0:
        raise wrong(
            path,
            f"node {names.min()} is an internal one of Abaqus (of hybrid elements or constraints), no node of a solid",
        )
    if freedoms.min() < 1 or freedoms.max() > 3:
        bad = pairs[(freedoms < 1) | (freedoms > 3)][0]
        raise wrong(path, f"node {bad[0]} has a freedom {bad[1]} that is no displacement; only solids are read")
    rows = np.minimum(np.searchsorted(numbers, names), numbers.size - 1)
    if (numbers[rows] != names).any():
        raise wrong(
            path, f"node {names[numbers[rows] != names][0]} has equations, but no solid element in the input file"
        )
    return 3 * rows + freedoms - 1
