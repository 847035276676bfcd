"""Matrices in the Matrix Market exchange format, the mass matrix, the stiffness matrix and the nodes in a file each."""

from __future__ import annotations

import gzip
import zlib
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np
import scipy.sparse as sp

from acausal import DeclarationError
from acausal.result import shown_name
from components.fe.formats.matrices import Matrices
from components.fe.formats.text import numbers_in, text_of, whole_numbers, wrong

PARTS = ("M", "K", "nodes")
ENDS = (".mtx", ".mtx.gz")
KINDS = {"coordinate": 3, "array": 2}  # with the numbers that say how large the matrix is
BANNER = "%%MatrixMarket"


def read_matrix_market(path: str | Path | Sequence[str | Path], *, length: float = 1.0, mass: float = 1.0) -> Matrices:
    """Return mass and stiffness matrix and nodes from three files in the Matrix Market format.

    The unit of time is the second: K, in force per length, is a mass per s2 and scales as M does, by `mass` alone.

    Parameters
    ----------
    path : str, Path or sequence of three
        One of the three files, whose names are alike up to the end: `plateM.mtx`, `plateK.mtx`, `platenodes.mtx`, or
        with `_`, `-` or `.` before M, K, nodes, or these alone; or `plate`, what they have in common; or the folder of
        `M.mtx`, `K.mtx`, `nodes.mtx`; each may be compressed, `.mtx.gz`. Files of other names are given as three: mass
        matrix, stiffness matrix, nodes. M and K are square, real and symmetric, with equations x, y, z of each node;
        nodes have a row x, y, z for each node.
    length : float
        Unit of length of the files in m: 1e-3 for mm. Nodes are multiplied by it.
    mass : float
        Unit of mass of the files in kg: 1e3 for mm, N, s, where the unit is the Mg. M and K are multiplied by it.

    Returns
    -------
    M, K : sparse (3 n, 3 n)
        In kg and N/m.
    nodes : array (n, 3)
        In m.

    Raises
    ------
    DeclarationError
        If a file is missing, cut off or of another kind, or the sizes do not fit.
    """
    files = _files(path)
    M, K, nodes = (_read(file) for file in files)
    nodes = nodes.toarray() if sp.issparse(nodes) else np.asarray(nodes)
    if nodes.shape[1] != 3:
        raise wrong(files[2], f"nodes are a matrix of three columns, x, y, z; this one is {_size(nodes)}")
    for file, matrix in zip(files, (M, K), strict=False):
        if matrix.shape != (3 * len(nodes), 3 * len(nodes)):
            raise wrong(
                file, f"the matrix is {_size(matrix)}, where {len(nodes)} nodes have {3 * len(nodes)} equations"
            )
    return mass * sp.csr_array(M), mass * sp.csr_array(K), length * nodes


def is_matrix_market(path: str | Path) -> bool:
    """Return whether a file begins as one in this format does."""
    try:
        with open(path, "rb") as file:
            return file.read(len(BANNER)) == BANNER.encode()
    except OSError:
        return False


def _files(path: str | Path | Sequence[str | Path]) -> list[Path]:
    if not isinstance(path, str | Path):
        files = [Path(part) for part in path]
        if len(files) != len(PARTS):
            raise DeclarationError("Matrix Market files are three: mass matrix, stiffness matrix, nodes")
        return files
    folder = Path(path) if Path(path).is_dir() else Path(path).parent
    begin = "" if Path(path).is_dir() else Path(path).name
    end = next((end for end in ENDS[::-1] if begin.endswith(end)), "")
    part = next((part for part in PARTS if end and begin.removesuffix(end).endswith(part)), None)
    if end and part is None:
        raise wrong(path, "the name ends in none of M.mtx, K.mtx, nodes.mtx; give the names of all three files")
    begin = begin.removesuffix(f"{part}{end}")
    return [_one(folder, begin, name) for name in PARTS]


def _one(folder: Path, begin: str, part: str) -> Path:
    names = [f"{begin}{mark}{part}{end}" for mark in ("", "_", "-", ".") for end in ENDS]
    found = next((name for name in names if (folder / name).is_file()), None)
    if found is None:
        raise wrong(folder / begin, f"there is no file {names[0]} beside it, nor {begin}_{part}.mtx")
    return folder / found


def _read(path: Path) -> Any:
    """The matrix of a file, sparse or dense as it is there; the other triangle of a symmetric one included."""
    lines = _text(path).split("\n")
    words = lines[0].lower().split()
    if len(words) != 5 or words[0] != BANNER.lower() or words[1] != "matrix":
        raise wrong(path, f"a file in the Matrix Market format begins with `{BANNER} matrix ...`", 1)
    kind, entries, symmetry = words[2:]
    if kind not in KINDS or entries not in ("real", "integer", "double") or symmetry not in ("general", "symmetric"):
        shown = " ".join(words[2:])
        raise wrong(path, f"a real matrix, general or symmetric, is expected, not `{shown_name(shown)}`", 1)
    head = next((k for k, line in enumerate(lines) if k and line.strip() and not line.startswith("%")), len(lines) - 1)
    sizes = lines[head].split()
    if len(sizes) != KINDS[kind] or not all(size.isdecimal() for size in sizes):
        raise wrong(
            path,
            f"the size of the matrix is given as {KINDS[kind]} whole numbers, not `{shown_name(lines[head])}`",
            head + 1,
        )
    shape, symmetric = (int(sizes[0]), int(sizes[1])), symmetry == "symmetric"
    if symmetric and shape[0] != shape[1]:
        raise wrong(path, f"a symmetric matrix is square, not {sizes[0]} x {sizes[1]}", head + 1)
    row = "row, column, value" if kind == "coordinate" else "value"
    values = numbers_in(path, "\n".join(lines[head + 1 :]), row, above=head + 1)
    dense = shape[0] * (shape[0] + 1) // 2 if symmetric else shape[0] * shape[1]
    count = int(sizes[2]) if kind == "coordinate" else dense
    if len(values) != count:
        raise wrong(path, f"there are {len(values)} entries, where the heading says {count}; the file may be cut off")
    if kind == "array":
        return _dense(values[:, 0], shape, symmetric)
    values = values.reshape(-1, 3)
    rows, columns = whole_numbers(path, values[:, :2], "row and column").T - 1
    outside = (rows < 0) | (columns < 0) | (rows >= shape[0]) | (columns >= shape[1])
    if outside.any():
        at = f"({rows[outside][0] + 1}, {columns[outside][0] + 1})"
        raise wrong(path, f"an entry stands at {at}, outside of the matrix of {sizes[0]} x {sizes[1]}")
    below = symmetric & (rows != columns)
    rows, columns = np.concatenate([rows, columns[below]]), np.concatenate([columns, rows[below]])
    return sp.coo_array((np.concatenate([values[:, 2], values[below, 2]]), (rows, columns)), shape)


def _text(path: Path) -> str:
    what = "a matrix in the Matrix Market format"
    if path.suffix != ".gz":
        return text_of(path, what)
    try:
        return gzip.decompress(path.read_bytes()).decode("latin-1")
    except (OSError, EOFError, zlib.error) as error:
        raise wrong(path, f"this is no compressed file, or not whole: {error}") from None


def _dense(values: np.ndarray, shape: tuple[int, int], symmetric: bool) -> np.ndarray:
    """A matrix given by columns, or by those of its lower triangle."""
    if not symmetric:
        return values.reshape(shape, order="F")
    columns, rows = np.triu_indices(shape[0])
    matrix = np.zeros(shape)
    matrix[rows, columns] = matrix[columns, rows] = values
    return matrix


def _size(matrix: Any) -> str:
    return " x ".join(map(str, matrix.shape))
