"""Matrices of Abaqus in the formats that its manual describes, written by the tests."""

from __future__ import annotations

import re
from pathlib import Path

import numpy as np
import pytest
import scipy.sparse as sp

from acausal import DeclarationError
from components.fe import box, read_abaqus, reduce_body
from components.fe.nodes import Nodes
from tests.components.fe.samples import deck, write_abaqus

KINDS = {"hexahedron": "C3D8I", "hexahedron20": "C3D20", "tetra10": "C3D10"}
M, K, PLAIN = box((0.1, 0.02, 0.03), (2, 1, 1), "hex20", E=7e10, nu=0.33, rho=2700)
NODES = Nodes(PLAIN, 7 * np.arange(len(PLAIN)) + 5, PLAIN.cells)
MATERIAL = {"E": 7e10, "nu": 0.33, "rho": 2700}
WRONG = {
    "empty": ("STIF1", lambda s: "", "the file is empty"),
    "comments": ("STIF1", lambda s: "** nothing\n", "the file has no lines of a matrix of Abaqus"),
    "foreign": (
        "STIF1",
        lambda s: "hello, world, this is\n",
        "line 1: a line must be node, freedom, node, freedom, value",
    ),
    "cut": ("STIF1", lambda s: s[:-2], "seems to be truncated"),
    "cut_in_a_line": ("MASS1", lambda s: s[: s.rindex(",")], "node, freedom, node, freedom, value"),
    "rotation": ("STIF1", lambda s: s.replace("5,3,", "5,4,", 1), "node 5 has the degree of freedom 4"),
    "internal": ("STIF1", lambda s: s.replace("\n5,3,", "\n-1,3,", 1), "node -1 is an internal node"),
    "other_node": ("STIF1", lambda s: s.replace("\n5,3,", "\n6,3,", 1), "node 6 has equations, but no solid element"),
    "twice": ("MASS1", lambda s: s + s.splitlines()[1] + "\n", "occurs twice"),
    "spring": ("STIF1", lambda s: s.replace("5,1, 5,1, ", "5,1, 5,1, 9", 1), "resist rigid-body motions"),
}


def write(folder: Path, *, labels: bool = True, triangle: bool = True, held=(), text: str = "", step: int = 1) -> Path:
    for kind, matrix in (("STIF", K), ("MASS", M)):
        held_here = held if kind == "STIF" else ()
        path = folder / f"job_{kind}{step}.mtx"
        write_abaqus(path, matrix, NODES.numbers, labels=labels, triangle=triangle, held=held_here)
    (folder / "job.inp").write_text(text or deck(NODES, KINDS, **MATERIAL))
    return folder / "job"


@pytest.mark.parametrize("labels", [True, False])
@pytest.mark.parametrize("triangle", [True, False])
def test_round_trip(tmp_path: Path, labels: bool, triangle: bool) -> None:
    write(tmp_path, labels=labels, triangle=triangle)
    for name in ("job", "job.inp", "job_STIF1.mtx", "job_MASS1.mtx"):
        found = read_abaqus(tmp_path / name)
        assert abs(found[0] - M).max() < 1e-15
        assert abs(found[1] - K).max() < 1e-15 * abs(K).max()
        assert np.abs(found[2] - PLAIN).max() < 1e-12
        assert found[2].numbers.tolist() == NODES.numbers.tolist()
        assert np.array_equal(found[2].cells["hexahedron20"], PLAIN.cells["hexahedron20"])


def test_names_given(tmp_path: Path) -> None:
    """Mass matrix, stiffness matrix and input file of any names, in any folders."""
    job = write(tmp_path)
    write(tmp_path, step=2)
    (tmp_path / "mesh").mkdir()
    names = [tmp_path / "m.txt", tmp_path / "k.txt", tmp_path / "mesh" / "body.dat"]
    for old, new in zip(("job_MASS2.mtx", "job_STIF2.mtx", "job.inp"), names, strict=True):
        (tmp_path / old).rename(new)
    found = read_abaqus(names)
    assert abs(found[0] - M).max() < 1e-15
    assert abs(found[1] - K).max() < 1e-15 * abs(K).max()
    assert found[2].numbers.tolist() == NODES.numbers.tolist()
    with pytest.raises(DeclarationError, match="pass three files of Abaqus: mass matrix, stiffness matrix, input file"):
        read_abaqus(names[:2])
    with pytest.raises(DeclarationError, match=r"job\.inp: No such file"):
        read_abaqus([f"{job}_MASS1.mtx", f"{job}_STIF1.mtx", f"{job}.inp"])


@pytest.mark.parametrize("labels", [True, False])
def test_exponents_of_fortran(tmp_path: Path, labels: bool) -> None:
    path = write(tmp_path, labels=labels)
    for file in tmp_path.glob("*.mtx"):
        file.write_text(re.sub(r"e(?=[+-]\d\d)", "D", file.read_text()))
    (tmp_path / "job.inp").write_text(
        re.sub(r"(?m)^(5, )0, 0, 0", r"\g<1>0.D+00, 0d0, 0.0D0", deck(NODES, KINDS, **MATERIAL))
    )
    assert "5, 0.D+00, 0d0" in (tmp_path / "job.inp").read_text()
    found = read_abaqus(path)
    assert abs(found[1] - K).max() < 1e-15 * abs(K).max()
    assert abs(found[0] - M).max() < 1e-15


def test_units(tmp_path: Path) -> None:
    found = read_abaqus(write(tmp_path), length=1e-3, mass=1e3)
    assert abs(found[0] - 1e3 * M).max() < 1e-12
    assert abs(found[1] - 1e3 * K).max() < 1e-12 * abs(K).max()
    assert np.abs(found[2] - 1e-3 * PLAIN).max() < 1e-15


def test_held_nodes_are_named(tmp_path: Path) -> None:
    path = write(tmp_path, held=(0, 1, 2, 33, 34, 35))
    found = read_abaqus(path)
    assert found[0].diagonal()[:4].tolist() == [0, 0, 0, M.diagonal()[3]]
    with pytest.raises(DeclarationError, match=r"nodes 0, 11 \(in the file 5, 82\).*were fixed"):
        reduce_body(*found, frames={"end": [1, 2, 3]})


def test_steps(tmp_path: Path) -> None:
    write(tmp_path)
    write(tmp_path, step=2)
    with pytest.raises(DeclarationError, match=r"several matrices, job_STIF1.mtx, job_STIF2.mtx"):
        read_abaqus(tmp_path / "job.inp")
    assert abs(read_abaqus(tmp_path / "job_MASS2.mtx")[0] - M).max() < 1e-15


def test_equations_in_another_order_are_found(tmp_path: Path) -> None:
    """COORDINATE names no nodes; the stiffness shows that they are others."""
    text = deck(Nodes(NODES, np.roll(NODES.numbers, 1), NODES.cells), KINDS, **MATERIAL)
    path = write(tmp_path, labels=False, text=text)
    with pytest.raises(DeclarationError, match=r"resist rigid-body motions of the nodes .* use FORMAT=MATRIX INPUT"):
        read_abaqus(path)
    (tmp_path / "job_STIF1.mtx").write_text("1 1 5.0\n")
    with pytest.raises(DeclarationError, match="there are 1 equations, but 32 nodes with elements have 96"):
        read_abaqus(path)


def test_part_and_instance(tmp_path: Path) -> None:
    """An instance is shifted, then turned; here by 90 degrees about an axis along z through (1, 2, 3)."""
    place = "*Instance, name=I-1, part=p-1\n1., 2., 3.\n1., 2., 3., 1., 2., 4., 90.\n*End Instance"
    body = deck(NODES, KINDS, **MATERIAL)
    nodes, rest = body[: body.index("*MATERIAL")], body[body.index("*MATERIAL") :]
    text = f"*Part, name=P-1\n{nodes}*End Part\n*Assembly, name=A\n{place}\n*End Assembly\n{rest}"
    T = np.array([[0.0, -1, 0], [1, 0, 0], [0, 0, 1]])
    R = sp.kron(sp.eye_array(len(NODES)), T)
    turned = (R @ K @ R.T).tocsr()
    path = write(tmp_path, text=text)
    with pytest.raises(DeclarationError, match="resist rigid-body motions"):  # of the body that was not turned
        read_abaqus(path)
    write_abaqus(tmp_path / "job_STIF1.mtx", turned, NODES.numbers)
    found = read_abaqus(path)
    assert np.abs(found[2] - (PLAIN @ T.T + [1, 2, 3])).max() < 1e-12
    assert abs(found[1] - turned).max() < 1e-12 * abs(K).max()
    for extra, message in (
        ("*Instance, name=I-2, part=P-1\n*End Instance\n*End Assembly", "several instances"),
        ("*Node\n1, 0., 0., 0.\n*End Assembly", "outside the instance makes Abaqus renumber"),
    ):
        (tmp_path / "job.inp").write_text(text.replace("*End Assembly", extra))
        with pytest.raises(DeclarationError, match=message):
            read_abaqus(path)


@pytest.mark.parametrize("case", WRONG)
def test_wrong_files(tmp_path: Path, case: str) -> None:
    kind, change, message = WRONG[case]
    path = write(tmp_path)
    file = tmp_path / f"job_{kind}.mtx"
    file.write_text(change(file.read_text()))
    with pytest.raises(DeclarationError, match=message):
        read_abaqus(path)


def test_files_that_are_not_there(tmp_path: Path) -> None:
    path = write(tmp_path)
    (tmp_path / "job_MASS1.mtx").unlink()
    with pytest.raises(DeclarationError, match=r"there is no matrix job_MASS1\.mtx"):
        read_abaqus(path)
    write(tmp_path, text="*HEADING\nnothing\n")
    with pytest.raises(DeclarationError, match="no node under"):
        read_abaqus(path)
