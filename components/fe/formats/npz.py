"""Matrices in a .npz file of numpy."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np

from acausal import DeclarationError
from components.fe.reduction.archive import UNREADABLE, reason

PLACES = ("coords_m", "coords_mm", "nodes")


def read_npz(path: str | Path, *, length: float = 1.0, mass: float = 1.0) -> tuple[Any, Any, np.ndarray]:
    """Read mass matrix, stiffness matrix and nodes from a .npz file.

    The nodes are the array `coords_m`, `coords_mm` or `nodes`, shape (N, 3). The stiffness is `K`, shape (3 N, 3 N).
    The mass is `M`, or `mscalar`, shape (N, N), whose entries are multiplied by the 3 x 3 unit matrix. A matrix is full
    or triangular, and either dense under its name or sparse (CSR) as NAME_data, NAME_indices and NAME_indptr.

    Parameters
    ----------
    path : str or Path
        File.
    length, mass : float
        Units of the file in m and kg: 1e-3 and 1e3 for mm, N and Mg. The unit of time must be the second. The name
        `coords_mm` implies no unit.

    Returns
    -------
    M, K : sparse matrix, shape (3 N, 3 N)
        In kg and N/m; equations in the order x, y, z of each node.
    nodes : array, shape (N, 3)
        In m.

    Raises
    ------
    DeclarationError
        If the file is missing, damaged, or lacks one of the arrays.
    """
    from scipy.sparse import csr_array, kron

    try:
        with np.load(path, allow_pickle=False) as file:
            content = {name: file[name] for name in file.files}
    except FileNotFoundError:
        raise DeclarationError(f"there is no file {path}") from None
    except UNREADABLE as error:
        raise DeclarationError(f"{path} is not a .npz file, or is damaged{reason(error)}") from None
    places = next((name for name in PLACES if name in content), None)
    if places is None and "modal_first" in content:
        raise DeclarationError(f"{path} is a reduced body; pass it to FEBody(reduced=...)")
    if places is None:
        raise DeclarationError(f"{path} has no nodes ({', '.join(PLACES)}), only {', '.join(content) or 'nothing'}")
    K, M = _matrix(content, "K", path), _matrix(content, "M", path)
    if M is None and (scalar := _matrix(content, "mscalar", path)) is not None:
        M = csr_array(kron(scalar, np.eye(3), format="csr"))
    if K is None or M is None:
        raise DeclarationError(f"{path} has no {'stiffness (K)' if K is None else 'mass (M or mscalar)'}")
    return mass * M, mass * K, length * np.asarray(content[places], dtype=float)


def _matrix(content: dict[str, np.ndarray], name: str, path: str | Path) -> Any:
    """Return the full matrix of this name, or None if the file does not have it."""
    from scipy.sparse import csr_array, tril, triu

    if name in content:
        A = csr_array(content[name])
    elif f"{name}_data" in content:
        try:
            data, indices, starts = (content[f"{name}_{part}"] for part in ("data", "indices", "indptr"))
            A = csr_array((data, indices, starts), shape=(len(starts) - 1,) * 2)
            A.check_format()
        except (KeyError, ValueError) as error:
            raise DeclarationError(f"{path} has an invalid sparse matrix {name}: {error}") from None
    else:
        return None
    below, above = tril(A, -1), triu(A, 1)
    if bool(below.nnz) == bool(above.nnz):
        return A
    return csr_array(A + (below + above).T)
