"""Mass matrix, stiffness matrix and nodes in three files of the Matrix Market exchange format."""

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
from components.fe.formats.text import file_error, numbers_in, text_of, whole_numbers

PARTS = ("M", "K", "nodes")
ENDS = (".mtx", ".mtx.gz")
KINDS = {"coordinate": 3, "array": 2}  # count of numbers in the size line
BANNER = "%%MatrixMarket"


def read_matrix_market(path: str | Path | Sequence[str | Path], *, length: float = 1.0, mass: float = 1.0) -> Matrices:
    """Read mass matrix, stiffness matrix and nodes from three files in the Matrix Market format.

    The unit of time must be the second. K, a force per length, is a mass per s2 and scales with `mass`, as M does.

    Parameters
    ----------
    path : str, Path or sequence of three
        One of three files whose names differ only in their ends, `plateM.mtx`, `plateK.mtx`, `platenodes.mtx`; M, K,
        nodes may follow `_`, `-` or `.`. Or the common part `plate`, or the folder of `M.mtx`, `K.mtx`, `nodes.mtx`.
        Or a sequence of three files: mass matrix, stiffness matrix, nodes. Files may be compressed, `.mtx.gz`. M and K
        must be square, real and symmetric, with equations x, y, z of each node; nodes have a row x, y, z for each node.
    length : float
        Unit of length of the files in m: 1e-3 for mm. Scales the nodes.
    mass : float
        Unit of mass of the files in kg: 1e3 for mm, N, s, where the unit is the Mg. Scales M and K.

    Returns
    -------
    M, K : sparse (3 n, 3 n)
        In kg and N/m.
    nodes : array (n, 3)
        In m.

    Raises
    ------
    DeclarationError
        If a file is missing, truncated or of another format, or the sizes do not match.
    """
    files = _files(path)
    M, K, nodes = (_read(file) for file in files)
    nodes = nodes.toarray() if sp.issparse(nodes) else np.asarray(nodes)
    if nodes.shape[1] != 3:
        raise file_error(files[2], f"nodes must be a matrix of three columns, x, y, z; this one is {_size(nodes)}")
    for file, matrix in zip(files, (M, K), strict=False):
        if matrix.shape != (3 * len(nodes), 3 * len(nodes)):
            raise file_error(
                file, f"the matrix is {_size(matrix)}, but {len(nodes)} nodes have {3 * len(nodes)} equations"
            )
    return mass * sp.csr_array(M), mass * sp.csr_array(K), length * nodes


def is_matrix_market(path: str | Path) -> bool:
    """Return whether a file begins with the banner of the format."""
    try:
        with open(path, "rb") as file:
            return file.read(len(BANNER)) == BANNER.encode()
    except OSError:
        return False


def _files(path: str | Path | Sequence[str | Path]) -> list[Path]:
    if not isinstance(path, str | Path):
        files = [Path(part) for part in path]
        if len(files) != len(PARTS):
            raise DeclarationError("pass three Matrix Market files: mass matrix, stiffness matrix, nodes")
        return files
    folder = Path(path) if Path(path).is_dir() else Path(path).parent
    begin = "" if Path(path).is_dir() else Path(path).name
    end = next((end for end in ENDS[::-1] if begin.endswith(end)), "")
    part = next((part for part in PARTS if end and begin.removesuffix(end).endswith(part)), None)
    if end and part is None:
        raise file_error(path, "the name does not end in M.mtx, K.mtx or nodes.mtx; pass the names of all three files")
    begin = begin.removesuffix(f"{part}{end}")
    return [_one(folder, begin, name) for name in PARTS]


def _one(folder: Path, begin: str, part: str) -> Path:
    names = [f"{begin}{mark}{part}{end}" for mark in ("", "_", "-", ".") for end in ENDS]
    found = next((name for name in names if (folder / name).is_file()), None)
    if found is None:
        raise file_error(folder / begin, f"neither {names[0]} nor {begin}_{part}.mtx is in its folder")
    return folder / found


def _read(path: Path) -> Any:
    """Read the matrix of a file, sparse or dense; a symmetric one is completed from its lower triangle."""
    lines = _text(path).split("\n")
    words = lines[0].lower().split()
    if len(words) != 5 or words[0] != BANNER.lower() or words[1] != "matrix":
        raise file_error(path, f"a file in the Matrix Market format must begin with `{BANNER} matrix ...`", 1)
    kind, entries, symmetry = words[2:]
    if kind not in KINDS or entries not in ("real", "integer", "double") or symmetry not in ("general", "symmetric"):
        shown = " ".join(words[2:])
        raise file_error(path, f"a real matrix, general or symmetric, is expected, not `{shown_name(shown)}`", 1)
    head = next((k for k, line in enumerate(lines) if k and line.strip() and not line.startswith("%")), len(lines) - 1)
    sizes = lines[head].split()
    if len(sizes) != KINDS[kind] or not all(size.isdecimal() for size in sizes):
        raise file_error(
            path,
            f"the size line needs {KINDS[kind]} integers, not `{shown_name(lines[head])}`",
            head + 1,
        )
    shape, symmetric = (int(sizes[0]), int(sizes[1])), symmetry == "symmetric"
    if symmetric and shape[0] != shape[1]:
        raise file_error(path, f"a symmetric matrix must be square, not {sizes[0]} x {sizes[1]}", head + 1)
    row = "row, column, value" if kind == "coordinate" else "value"
    values = numbers_in(path, "\n".join(lines[head + 1 :]), row, above=head + 1)
    dense = shape[0] * (shape[0] + 1) // 2 if symmetric else shape[0] * shape[1]
    count = int(sizes[2]) if kind == "coordinate" else dense
    if len(values) != count:
        raise file_error(
            path, f"there are {len(values)} entries, but the header says {count}; the file may be truncated"
        )
    if kind == "array":
        return _dense(values[:, 0], shape, symmetric)
    values = values.reshape(-1, 3)
    rows, columns = whole_numbers(path, values[:, :2], "row and column").T - 1
    outside = (rows < 0) | (columns < 0) | (rows >= shape[0]) | (columns >= shape[1])
    if outside.any():
        at = f"({rows[outside][0] + 1}, {columns[outside][0] + 1})"
        raise file_error(path, f"the entry {at} is outside the matrix of {sizes[0]} x {sizes[1]}")
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
        raise file_error(path, f"this is not a gzip file, or is damaged: {error}") from None


def _dense(values: np.ndarray, shape: tuple[int, int], symmetric: bool) -> np.ndarray:
    """Return a matrix from its values by columns; of a symmetric one, from the columns of its lower triangle."""
    if not symmetric:
        return values.reshape(shape, order="F")
    columns, rows = np.triu_indices(shape[0])
    matrix = np.zeros(shape)
    matrix[rows, columns] = matrix[columns, rows] = values
    return matrix


def _size(matrix: Any) -> str:
    return " x ".join(map(str, matrix.shape))
