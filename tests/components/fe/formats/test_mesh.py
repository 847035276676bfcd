"""Mesh files: what meshio writes, and decks, give the matrices of the mesh; other files are refused."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from acausal import AcausalWarning, DeclarationError
from components.fe import box, read_mesh, reduce_body
from tests.components.fe.samples import deck

meshio = pytest.importorskip("meshio", reason="meshio, the extra fe, is not installed")
STEEL = {"E": 2.1e11, "nu": 0.3, "rho": 7850.0}
FORMATS = {"gmsh22": ".msh", "vtu": ".vtu", "vtk": ".vtk", "abaqus": ".inp", "nastran": ".bdf"}
KINDS = {"hexahedron": "C3D8", "hexahedron20": "C3D20", "tetra10": "C3D10"}


@pytest.mark.parametrize("element", ["hex8", "hex20", "tet10"])
@pytest.mark.parametrize("kind", FORMATS)
def test_round_trip(tmp_path: Path, element: str, kind: str) -> None:
    """Nodes of no element, such as the centre of an arc, and surfaces, such as loads stand on, are left out."""
    M, K, nodes = box((0.1, 0.02, 0.03), (3, 2, 1), element, **STEEL)
    points = 1e3 * np.vstack([[[9, 9, 9]], nodes])
    cells = [(name, rows + 1) for name, rows in nodes.cells.items()]
    path = tmp_path / f"box{FORMATS[kind]}"
    meshio.Mesh(points, [*cells, ("triangle", np.array([[1, 2, 3]]))]).write(path, file_format=kind)
    found = read_mesh(path, **STEEL, length=1e-3)
    assert np.abs(found[2] - nodes).max() < 1e-12  # of a file with 12 digits
    assert abs(found[0] - M).max() < 1e-11 * abs(M).max()
    assert abs(found[1] - K).max() < 1e-10 * abs(K).max()
    assert {k: r.tolist() for k, r in found[2].cells.items()} == {k: r.tolist() for k, r in nodes.cells.items()}
    if kind == "abaqus":
        assert found[2].numbers.tolist() == list(range(2, len(nodes) + 2))


def test_deck_with_cards_of_gmsh(tmp_path: Path) -> None:
    """Surfaces and lines under names that meshio does not know, elements over two lines without a comma at the end."""
    _, K, nodes = box((0.1, 0.02, 0.03), (2, 1, 1), "hex20", **STEEL)
    text = deck(nodes, KINDS, **STEEL).replace(",\n", "\n")
    text = text.replace("*ELEMENT", "*ELEMENT, type=CPS6, ELSET=Surface1\n900, 1, 2, 3, 4, 5, 6\n*ELEMENT", 1)
    path = tmp_path / "gmsh.inp"
    path.write_text("*Heading\n gmsh\n" + text)
    found = read_mesh(path, **STEEL)
    assert abs(found[1] - K).max() < 1e-9 * abs(K).max()
    body = reduce_body(*found, frames={"end": [0, 1, 2]}, modes=3)
    assert np.array_equal(body.nodal.cells["hexahedron20"], nodes.cells["hexahedron20"])


@pytest.mark.parametrize(
    ("name", "content", "message"),
    [
        ("a.msh", b"hello", "not a mesh that meshio reads"),
        ("a.vtu", b"", "not a mesh that meshio reads"),
        ("a.vtk", bytes(range(256)), "not a mesh that meshio reads"),
        ("a.xyz", b"1 2 3\n", "not a mesh that meshio reads"),
        ("a.bdf", b"BEGIN BULK\nGRID,1,,0.,0.,0.\n", "no line begins with ENDDATA"),
        ("a.dat", b"TITLE\n", "Tecplot meshes are not supported"),
        ("a.inp", b"hello", "no keyword such as"),
        ("a.inp", b"*NODE\n1, 0, 0, 0\n", "there are no solid elements"),
        ("a.inp", b"*NODE\n1, 0, 0, 0\n*ELEMENT, TYPE=C3D10\n1, 1, 1, 1\n", "has 3 nodes, too few for a C3D10"),
        ("a.inp", b"*NODE\n1, 0, 0, 0\n*ELEMENT, TYPE=C3D4\n1, 1, x, 1, 1\n", "an element needs number, node"),
    ],
)
def test_wrong_files(tmp_path: Path, name: str, content: bytes, message: str, capfd: pytest.CaptureFixture) -> None:
    (tmp_path / name).write_bytes(content)
    with pytest.raises(DeclarationError, match=message):
        read_mesh(tmp_path / name, **STEEL)
    assert capfd.readouterr() == ("", "")  # meshio prints, and ends the process


def test_other_elements_and_cut_files(tmp_path: Path) -> None:
    points = np.array([[0.0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]])
    meshio.Mesh(points, [("wedge", np.array([[0, 1, 2, 3, 3, 3]]))]).write(tmp_path / "a.vtu")
    with pytest.raises(DeclarationError, match="unknown element type 'wedge'"):
        read_mesh(tmp_path / "a.vtu", **STEEL)
    meshio.Mesh(points, [("triangle", np.array([[0, 1, 2]]))]).write(tmp_path / "b.vtu")
    with pytest.raises(DeclarationError, match="no solid elements"):
        read_mesh(tmp_path / "b.vtu", **STEEL)
    content = (tmp_path / "a.vtu").read_bytes()
    for part in (len(content) // 2, len(content) - 5):
        (tmp_path / "a.vtu").write_bytes(content[:part])
        with pytest.raises(DeclarationError, match="or is truncated"):
            read_mesh(tmp_path / "a.vtu", **STEEL)
    with pytest.raises(DeclarationError, match="there is no such file"):
        read_mesh(tmp_path / "c.vtu", **STEEL)


def test_linear_tetrahedra_warn(tmp_path: Path) -> None:
    points = np.array([[0.0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1], [1, 1, 1]])
    cells = [("tetra", np.array([[0, 1, 2, 3], [1, 4, 2, 3]])), ("triangle", np.array([[0, 1, 2]]))]
    meshio.Mesh(points, cells).write(tmp_path / "a.vtu")
    with pytest.warns(AcausalWarning, match=r"a\.vtu: tetrahedra of 4 nodes are far too stiff .* Do this: mesh with"):
        M, K, nodes = read_mesh(tmp_path / "a.vtu", **STEEL)
    assert M.sum() / 3 == pytest.approx(7850 * (1 / 6 + 1 / 3))
    assert nodes.cells["tetra"].tolist() == [[0, 1, 2, 3], [1, 4, 2, 3]]
    stretch = 1e-3 * np.asarray(nodes) * [1, 0, 0]
    first, second = 2.1e11 * 0.3 / (1.3 * 0.4), 2.1e11 / 2.6
    assert stretch.ravel() @ (K @ stretch.ravel()) == pytest.approx(1e-6 * (first + 2 * second) / 2)


SMALL = "GRID    {:<8}{:<8}{:<8}{:<8}{:<8}\n"
LARGE = "GRID*   {:<16}{:<16}{:<16}{:<16}\n*       {:<16}\n"
FREE = "GRID,{},{},{},{},{}\n"


@pytest.mark.parametrize("card", [SMALL, LARGE, FREE])
@pytest.mark.parametrize("begin", ["", "$ Created by Gmsh\n", "SOL 103\nCEND\nBEGIN BULK\n"])
def test_bulk_data_with_and_without_begin(tmp_path: Path, card: str, begin: str) -> None:
    """gmsh leaves BEGIN BULK out; exponents may be those of Fortran."""
    places = [("0.", "0.", "0."), ("1.D-1", "0.", "0."), ("0.", "1.0d-1", "0."), ("0.", "0.", "1.-1")]
    text = begin + "".join(card.format(k + 1, "", *xyz) for k, xyz in enumerate(places))
    (tmp_path / "a.bdf").write_text(text + "CTETRA  1       1       1       2       3       4\nENDDATA\n")
    with pytest.warns(AcausalWarning, match="tetrahedra of 4 nodes"):
        M, _, nodes = read_mesh(tmp_path / "a.bdf", **STEEL)
    assert np.asarray(nodes).tolist() == [[0, 0, 0], [0.1, 0, 0], [0, 0.1, 0], [0, 0, 0.1]]
    assert M.sum() / 3 == pytest.approx(7850e-3 / 6)
