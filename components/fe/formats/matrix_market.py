"""Matrices in the Matrix Market exchange format, the mass matrix, the stiffness matrix and the nodes in a file each."""

from __future__ import annotations

import zlib
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np
import scipy.sparse as sp

from acausal import DeclarationError
from acausal.result import shown_name
from components.fe.formats.matrices import Matrices
from components.fe.formats.text import wrong

PARTS = ("M", "K", "nodes")
ENDS = (".mtx", ".mtx.gz")
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
    from scipy.io import mminfo, mmread

    try:
        kind, symmetry = mminfo(path)[4:6]
        if kind not in ("real", "integer") or symmetry not in ("general", "symmetric"):
            raise wrong(path, f"a real matrix, general or symmetric, is expected, not a {kind}, {symmetry} one")
        matrix: Any = mmread(path)
    except (ValueError, OverflowError, MemoryError, EOFError, zlib.error) as error:
        raise wrong(path, f"this is no file in the Matrix Market format, or not whole: {error}".rstrip(". ")) from None
    except OSError as error:
        raise DeclarationError(f"cannot read {shown_name(path)}: {error.strerror or error}.") from None
    matrix = matrix if sp.issparse(matrix) else np.asarray(matrix)
    if not np.isfinite(matrix.data if sp.issparse(matrix) else matrix).all():
        raise wrong(path, "there are entries that are not finite numbers")
    return matrix


def _size(matrix: Any) -> str:
    return " x ".join(map(str, matrix.shape))
