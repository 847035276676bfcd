"""Mesh files of solids, read by meshio and assembled to matrices with one material."""

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
from components.fe.formats.text import file_error, file_warning, text_of
from components.fe.formats.third_party import call_reader, existing_file, optional_module
from components.fe.nodes import Nodes

NASTRAN = (".bdf", ".fem", ".nas")
DOUBLE = re.compile(r"(?<=[\d.])D(?=[+-]\d)", re.IGNORECASE)  # exponent of Fortran, 1.5D+10
TECPLOT = (".dat", ".tec")
Cells = dict[str, np.ndarray]


def read_mesh(path: str | Path, *, E: float, nu: float, rho: float, length: float = 1.0) -> Matrices:
    """Read a mesh file and return mass matrix, stiffness matrix and nodes of a solid of one material.

    Parameters
    ----------
    path : str or Path
        Any file that meshio reads (.msh, .vtu, .vtk, .med, .bdf, ...), an input file of Abaqus or CalculiX (.inp), or
        an Ansys archive (.cdb), with tetrahedra of 10 or 4 nodes or bricks of 20 or 8 nodes. Bricks of 8 nodes get
        incompatible modes. Tetrahedra of 4 nodes are far too stiff in bending and raise a warning. Surfaces, lines,
        points and nodes without solid elements are ignored.
    E, nu, rho : float
        Modulus of elasticity in Pa, Poisson's ratio, density in kg/m3.
    length : float
        Unit of length of the file in m: 1e-3 for mm. Scales the nodes.

    Returns
    -------
    M, K : sparse (3 n, 3 n)
        In kg and N/m; equations x, y, z of each node.
    nodes : Nodes (n, 3)
        Positions in m, in the order of the file; `nodes.cells` are the elements, and `nodes.numbers` the node numbers
        of a deck or archive.

    Raises
    ------
    DeclarationError
        If the file is missing, truncated or of another format, the solid has other elements, the material is
        impossible, or meshio is not installed (`pip install 'acausal[fe]'`).
    """
    file = existing_file(path, "a mesh")
    places, cells, numbers = READERS.get(file.suffix.lower(), _mesh)(file)
    cells = {kind: rows for kind, rows in cells.items() if not kind.startswith(FLAT) and rows.size}
    if not cells:
        raise file_error(file, "there are no solid elements in this mesh")
    used = np.unique(np.concatenate([rows.ravel() for rows in cells.values()]))
    if used[0] < 0 or used[-1] >= len(places):
        raise file_error(file, "an element refers to a node that is not in the file")
    cells = {kind: np.searchsorted(used, rows) for kind, rows in cells.items()}
    if "tetra" in cells:
        file_warning(
            path,
            "tetrahedra of 4 nodes are far too stiff in bending: the first frequency of a bar with one, two, four of "
            "them across is 86, 29, 9 % too high. Do this: mesh with tetrahedra of 10 nodes, in gmsh by `-order 2`",
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
    if path.suffix.lower() in TECPLOT:  # meshio loops for ever on a truncated file
        raise file_error(path, "Tecplot meshes are not supported; use .vtu, .msh or .med")
    source = _bulk_data(path) if path.suffix.lower() in NASTRAN else path
    meshio = optional_module("meshio", "fe", "reading a mesh")
    said = io.StringIO()

    def read() -> Any:
        # meshio prints the reason and exits when a file has an unknown format.
        with redirect_stdout(said), redirect_stderr(said):
            try:
                return meshio.read(source, "nastran" if source is not path else None)
            except SystemExit:
                raise ValueError(" ".join(said.getvalue().split())) from None

    mesh = call_reader(read, path, "a mesh that meshio reads")
    places = np.asarray(mesh.points, dtype=float)
    if places.ndim != 2 or places.shape[1] != 3 or not np.isfinite(places).all():
        raise file_error(path, "the nodes of a solid need finite x, y, z")
    cells: dict[str, list[np.ndarray]] = {}
    for block in mesh.cells:
        cells.setdefault(block.type, []).append(np.asarray(block.data))
    return places, {kind: np.concatenate(parts) for kind, parts in cells.items()}, None


def _bulk_data(path: Path) -> io.StringIO:
    """Return Nastran bulk data in the form that meshio accepts: with BEGIN BULK, which gmsh omits, and exponents E."""
    text = text_of(path, "bulk data of Nastran")
    if not re.search(r"^ENDDATA", text, re.MULTILINE):  # meshio loops for ever without it
        raise file_error(path, "no line begins with ENDDATA: this is not Nastran bulk data, or is truncated")
    begun = re.search(r"^\s*BEGIN BULK", text, re.MULTILINE)
    return io.StringIO(("" if begun else "BEGIN BULK\n") + DOUBLE.sub("E", text))


READERS = {".inp": _deck, ".cdb": _archive}
