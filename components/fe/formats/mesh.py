"""Mesh files of solids: meshio reads them, a material makes matrices of them."""

from __future__ import annotations

import io
import re
from contextlib import redirect_stderr, redirect_stdout
from pathlib import Path
from typing import Any

import numpy as np

from components.fe.elements import assemble
from components.fe.elements.assembly import FLAT
from components.fe.formats.cdb import read_cdb
from components.fe.formats.keywords import blocks, cells_of, elements, node_positions
from components.fe.formats.matrices import Matrices
from components.fe.formats.text import doubt, text_of, wrong
from components.fe.formats.third_party import existing, package, read_by
from components.fe.nodes import Nodes

NASTRAN = (".bdf", ".fem", ".nas")
DOUBLE = re.compile(r"(?<=[\d.])D(?=[+-]\d)", re.IGNORECASE)  # exponent of Fortran, 1.5D+10
TECPLOT = (".dat", ".tec")
Cells = dict[str, np.ndarray]


def read_mesh(path: str | Path, *, E: float, nu: float, rho: float, length: float = 1.0) -> Matrices:
    """Return mass and stiffness matrix and nodes of a solid of one material from a file with its mesh.

    Parameters
    ----------
    path : str or Path
        Any file that meshio reads (.msh, .vtu, .vtk, .med, .bdf, ...), a deck of Abaqus or CalculiX (.inp), or an
        archive of Ansys (.cdb), with tetrahedra of 10 or 4 nodes, bricks of 20 or bricks of 8 nodes; these get
        incompatible modes. Tetrahedra of 4 nodes are far too stiff in bending, which a warning says. Surfaces, lines
        and points, and nodes of no solid element, are passed over.
    E, nu, rho : float
        Modulus of elasticity in Pa, Poisson's ratio, density in kg/m3.
    length : float
        Unit of length of the file in m: 1e-3 for mm. Nodes are multiplied by it.

    Returns
    -------
    M, K : sparse (3 n, 3 n)
        In kg and N/m; equations x, y, z of each node.
    nodes : Nodes (n, 3)
        In m, in the order of the file; `nodes.numbers` where it is a deck or an archive, `nodes.cells` the elements.

    Raises
    ------
    DeclarationError
        If the file is missing, cut off or of another kind, the solid has other elements, the material cannot be, or
        meshio is not installed (`pip install 'acausal[fe]'`).
    """
    file = existing(path, "a mesh")
    places, cells, numbers = READERS.get(file.suffix.lower(), _mesh)(file)
    cells = {kind: rows for kind, rows in cells.items() if not kind.startswith(FLAT) and rows.size}
    if not cells:
        raise wrong(file, "there are no solid elements in this mesh")
    used = np.unique(np.concatenate([rows.ravel() for rows in cells.values()]))
    if used[0] < 0 or used[-1] >= len(places):
        raise wrong(file, "an element names a node that is not in the file")
    cells = {kind: np.searchsorted(used, rows) for kind, rows in cells.items()}
    if "tetra" in cells:
        doubt(
            path,
            "tetrahedra of 4 nodes are far too stiff in bending: the first frequency of a bar with one, "
            "two, four of them across is 86, 29, 9 % too high. Do this: mesh with tetrahedra of 10 nodes, in gmsh by `-order 2`",
        )
    places = length * places[used]
    M, K, _ = assemble(places, cells, E=E, nu=nu, rho=rho)
    return M, K, Nodes(places, None if numbers is None else numbers[used], cells)


def _archive(path: Path) -> tuple[np.ndarray, Cells, np.ndarray | None]:
    places, numbers, cells = read_cdb(path)
    return places, cells, numbers


def _deck(path: Path) -> tuple[np.ndarray, Cells, np.ndarray | None]:
    deck = list(blocks(path))
    places = node_positions(deck)
    rows = {name: row for row, name in enumerate(places)}
    cells = {kind: np.array(members) for kind, members in cells_of(elements(deck), rows).items()}
    return np.array(list(places.values())), cells, np.array(list(places))


def _mesh(path: Path) -> tuple[np.ndarray, Cells, np.ndarray | None]:
    if path.suffix.lower() in TECPLOT:  # at one that is cut off meshio would read for ever
        raise wrong(path, "meshes of Tecplot are not read; take .vtu, .msh or .med")
    source = _bulk_data(path) if path.suffix.lower() in NASTRAN else path
    meshio = package("meshio", "fe", "reading a mesh")
    said = io.StringIO()

    def read() -> Any:
        # At a file that it does not know it prints why, and ends the process.
        with redirect_stdout(said), redirect_stderr(said):
            try:
                return meshio.read(source, "nastran" if source is not path else None)
            except SystemExit:
                raise ValueError(" ".join(said.getvalue().split())) from None

    mesh = read_by(read, path, "a mesh that meshio reads")
    places = np.asarray(mesh.points, dtype=float)
    if places.ndim != 2 or places.shape[1] != 3 or not np.isfinite(places).all():
        raise wrong(path, "nodes of a solid have finite x, y, z")
    cells: dict[str, list[np.ndarray]] = {}
    for block in mesh.cells:
        cells.setdefault(block.type, []).append(np.asarray(block.data))
    return places, {kind: np.concatenate(parts) for kind, parts in cells.items()}, None


def _bulk_data(path: Path) -> io.StringIO:
    """Bulk data of Nastran as meshio reads them: below a line BEGIN BULK, which gmsh leaves out, exponents with E."""
    text = text_of(path, "bulk data of Nastran")
    if not re.search(r"^ENDDATA", text, re.MULTILINE):  # meshio would look for it for ever
        raise wrong(path, "no line begins with ENDDATA: this is no bulk data of Nastran, or not whole")
    begun = re.search(r"^\s*BEGIN BULK", text, re.MULTILINE)
    return io.StringIO(("" if begun else "BEGIN BULK\n") + DOUBLE.sub("E", text))


READERS = {".inp": _deck, ".cdb": _archive}
