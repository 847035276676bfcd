"""Ansys: matrices of a .full file, nodes of a results file or an archive."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path
from tempfile import TemporaryDirectory

import numpy as np
import scipy.sparse as sp

from components.fe.formats import ansys_process
from components.fe.formats.matrices import Matrices, mirrored, placed
from components.fe.formats.text import file_error
from components.fe.formats.third_party import existing_file, require_module
from components.fe.nodes import Nodes

COORDINATES = (".rst", ".cdb")
# meshio's names of solid elements by the number of nodes; the order of nodes is the same.
SOLIDS = {4: "tetra", 6: "wedge", 8: "hexahedron", 10: "tetra10", 15: "wedge15", 20: "hexahedron20"}


def read_ansys(path: str | Path, *, length: float = 1.0, mass: float = 1.0) -> Matrices:
    """Read mass matrix, stiffness matrix and nodes of an Ansys job: its .full file, and its .rst or .cdb file.

    The unit of time must be the second. K, a force per length, is a mass per s2 and scales with `mass`, as M does.
    Equations of fixed nodes are not in the file and empty in both matrices; `reduce_body` then refuses the body and
    names the nodes.

    Parameters
    ----------
    path : str or Path
        NAME.full of a modal analysis with a consistent mass matrix (LUMPM,OFF), with NAME.rst (results) or NAME.cdb
        (written by CDWRITE) for the node positions in the same folder.
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
        If a file is missing, truncated or of another format, nodes have degrees of freedom other than displacements or
        rotated axes, or ansys-mapdl-reader is not installed (`pip install 'acausal[ansys]'`).
    """
    file = existing_file(path, "matrices of Ansys")
    if file.suffix.lower() in COORDINATES:
        file = existing_file(file.with_suffix(".full"), "matrices of Ansys")
    require_module("ansys.mapdl.reader", "ansys", "reading files of Ansys")
    beside = next((file.with_suffix(end) for end in COORDINATES if file.with_suffix(end).is_file()), None)
    if beside is None:
        raise file_error(file, f"neither {file.stem}.rst nor {file.stem}.cdb with the nodes is in its folder")
    found = _read(file, beside)
    equations = found["equations"]
    bad = equations[(equations[:, 1] < 0) | (equations[:, 1] > 2)]
    if len(bad):
        raise file_error(
            file, f"node {bad[0, 0]} has a degree of freedom that is not a displacement; only solids are supported"
        )
    numbers, rows = np.unique(equations[:, 0], return_inverse=True)
    nodes = _nodes(beside, found, numbers)
    nodes[:] *= length
    places, count = 3 * rows.ravel() + equations[:, 1], len(equations)
    triangles = (sp.csr_array((found[f"{name} values"], found[f"{name} index"]), (count, count)) for name in "MK")
    M, K = (mass * placed(mirrored(triangle), places, 3 * numbers.size) for triangle in triangles)
    return M, K, nodes


def _read(full: Path, beside: Path) -> dict[str, np.ndarray]:
    """Read the arrays of both files in a separate process, which damaged files may crash."""
    with TemporaryDirectory() as folder:
        out = Path(folder, "arrays.npz")
        # -P: the folder of that file has a module with the name of the package.
        command = [sys.executable, "-P", ansys_process.__file__, str(full), str(beside), str(out)]
        done = subprocess.run(command, capture_output=True, text=True, errors="replace")
        if done.returncode or not out.is_file():
            last = beside if str(beside) in done.stdout.splitlines() else full
            why = done.stderr.strip().splitlines()[-1:] if done.returncode > 0 else ["the reader crashed"]
            raise file_error(last, f"this is not an Ansys file, or is damaged ({', '.join(why)})".replace(".)", ")"))
        with np.load(out) as content:
            return dict(content)


def _nodes(path: Path, found: dict[str, np.ndarray], numbers: np.ndarray) -> Nodes:
    """Return the nodes with these numbers, in the unit of the file, and the solid elements between them."""
    known, places, angles = (found[name] for name in ("nnum", "nodes", "node_angles"))
    if not known.size:
        raise file_error(path, "there are no nodes in this file")
    order = np.argsort(known)
    at = order[np.minimum(np.searchsorted(known, numbers, sorter=order), known.size - 1)]
    if (known[at] != numbers).any():
        raise file_error(path, f"node {numbers[known[at] != numbers][0]} has equations, but no position in this file")
    if angles.size and angles.reshape(known.size, -1)[at].any():
        raise file_error(path, "nodes have rotated axes (NROTAT), which is not supported")
    cells = {kind: found[key] for count, kind in SOLIDS.items() if (key := f"cells {count}") in found}
    cells = {kind: np.searchsorted(numbers, c) for kind, c in cells.items() if np.isin(c, numbers).all()}
    return Nodes(places[at][:, :3], numbers, cells)
