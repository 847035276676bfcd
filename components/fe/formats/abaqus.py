"""Abaqus: matrices of `*MATRIX OUTPUT`, nodes of the input file."""

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
from components.fe.formats.text import file_error, table, text_of, whole_numbers
from components.fe.nodes import Nodes

FILE = re.compile(r"(?P<job>.+)_(?P<kind>STIF|MASS)(?P<step>\d*)\.mtx", re.IGNORECASE)
BEGINNING = 10_000  # characters that contain the header and the first entry of a matrix
HELD = 1e36  # term that Abaqus adds to the diagonal at boundary conditions
# Force of a rigid motion, relative to the sum of its absolute terms: far above round-off of 15 digits, far below the
# effect of another order of equations.
RIGID = 1e-6


def read_abaqus(path: str | Path | Sequence[str | Path], *, length: float = 1.0, mass: float = 1.0) -> Matrices:
    """Read mass matrix, stiffness matrix and nodes of an Abaqus job with `*MATRIX GENERATE, STIFFNESS, MASS`.

    Formats of `*MATRIX OUTPUT, STIFFNESS, MASS` are FORMAT=MATRIX INPUT (or LABELS), in which entries name their nodes,
    and FORMAT=COORDINATE, with equations x, y, z of the nodes in ascending order of their numbers. This order is
    verified: the stiffness must not resist rigid-body motions of the nodes.

    The unit of time must be the second. K, a force per length, is a mass per s2 and scales with `mass`, as M does.
    Equations of fixed nodes, marked by 1e36 on the diagonal, are empty in both matrices; `reduce_body` then refuses the
    body and names the nodes.

    Parameters
    ----------
    path : str, Path or sequence of three
        JOB.inp, JOB or one of the matrices, with JOB_STIF1.mtx and JOB_MASS1.mtx (the number is that of the step) in
        the folder of JOB.inp; or three files: mass matrix, stiffness matrix, input file. A deck with parts must have a
        single instance.
    length : float
        Unit of length of the job in m: 1e-3 for mm. Scales the nodes.
    mass : float
        Unit of mass of the job in kg: 1e3 for mm, N, s, where the unit is the Mg. Scales M and K.

    Returns
    -------
    M, K : sparse (3 n, 3 n)
        In kg and N/m; equations x, y, z of each node, in the global axes.
    nodes : Nodes (n, 3)
        Positions in m, in ascending order of the node numbers `nodes.numbers`.

    Raises
    ------
    DeclarationError
        If a file is missing, truncated or of another format, nodes have degrees of freedom other than displacements, or
        nodes and equations do not match.
    """
    masses, stiffness, inp = _files(Path(path)) if isinstance(path, str | Path) else _three_files(path)
    deck, move = instance_of(list(blocks(inp)))
    places, found = node_positions(deck), list(elements(deck))
    numbers = np.unique(np.array([node for _, nodes in found for node in nodes], dtype=np.int64))
    missing = [name for name in numbers.tolist() if name not in places]
    if missing or not numbers.size:
        what = f"node {missing[0]} has elements, but no position under *NODE" if missing else "there are no elements"
        raise file_error(inp, what)
    nodes = move(np.array([places[name] for name in numbers.tolist()]))
    n = 3 * numbers.size
    K, M = (_matrix(file, numbers) for file in (stiffness, masses))
    held = K.diagonal() >= HELD / 2
    if held.any():
        free = sp.diags_array((~held).astype(float))
        M, K = (free @ matrix @ free for matrix in (M, K))
    elif (force := rigid_forces(K, nodes)) > RIGID:
        raise file_error(
            stiffness,
            f"the {n} equations resist rigid-body motions of the nodes ({force:.1g} of the largest forces): their order differs "
            f"from that of the nodes in {inp.name}, or a spring or contact holds the body; use FORMAT=MATRIX INPUT",
        )
    cells = cells_of(found, {name: row for row, name in enumerate(numbers.tolist())})
    return mass * M, mass * K, Nodes(length * nodes, numbers, cells)


def is_abaqus(path: str | Path) -> bool:
    """Return whether a file is an Abaqus matrix by its name, or has such files in its folder."""
    path = Path(path)
    return bool(FILE.fullmatch(path.name)) or bool(_matrix_files(path.parent, path.stem, "STIF"))


def _three_files(paths: Sequence[str | Path]) -> list[Path]:
    files = [Path(path) for path in paths]
    if len(files) != 3:
        raise DeclarationError("pass three files of Abaqus: mass matrix, stiffness matrix, input file")
    return files


def _files(path: Path) -> list[Path]:
    """The mass matrix, the stiffness matrix and the input file."""
    named = FILE.fullmatch(path.name)
    job = named["job"] if named else path.stem if path.suffix.lower() == ".inp" else path.name
    found = []
    for kind in ("STIF", "MASS"):
        files = _matrix_files(path.parent, job, kind)
        if named and len(files) > 1:
            files = [file for file in files if FILE.fullmatch(file.name)["step"] == named["step"]]  # pyright: ignore
        if len(files) > 1:
            raise file_error(
                path, f"there are several matrices, {', '.join(file.name for file in files)}; pass the name of one"
            )
        if not files:
            raise file_error(path, f"there is no matrix {job}_{kind}1.mtx in its folder")
        found += files
    inp = path if path.suffix.lower() == ".inp" else path.parent / f"{job}.inp"
    return [*found[::-1], inp]


def _matrix_files(folder: Path, job: str, kind: str) -> list[Path]:
    files = sorted(folder.iterdir()) if folder.is_dir() else []
    matches = ((FILE.fullmatch(file.name), file) for file in files)
    return [file for match, file in matches if match and match["job"] == job and match["kind"].upper() == kind]


def _matrix(path: Path, numbers: np.ndarray) -> Any:
    """Read the matrix of these nodes."""
    n = 3 * numbers.size
    columns = _columns(path)
    if columns == 3:
        values = table(path, "a matrix of Abaqus", "row, column, value", comments="*")
        index = whole_numbers(path, values[:, :2], "row and column") - 1
        if index.max() + 1 != n:
            raise file_error(path, f"there are {index.max() + 1} equations, but {n // 3} nodes with elements have {n}")
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
        raise file_error(
            path,
            f"node {names.min()} is an internal node of Abaqus (hybrid elements or constraints), which is not supported",
        )
    if freedoms.min() < 1 or freedoms.max() > 3:
        bad = pairs[(freedoms < 1) | (freedoms > 3)][0]
        raise file_error(
            path,
            f"node {bad[0]} has the degree of freedom {bad[1]}, which is not a displacement; only solids are supported",
        )
    rows = np.minimum(np.searchsorted(numbers, names), numbers.size - 1)
    if (numbers[rows] != names).any():
        raise file_error(
            path, f"node {names[numbers[rows] != names][0]} has equations, but no solid element in the input file"
        )
    return 3 * rows + freedoms - 1
