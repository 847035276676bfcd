"""Matrices of CalculiX: frequencies of what it wrote, what is condensed, what is refused, and runs where it is installed."""

from __future__ import annotations

import re
import shutil
import subprocess
from pathlib import Path

import numpy as np
import pytest

from acausal import DeclarationError
from components.fe import box, read_calculix, reduce_body, rows_of
from components.fe.nodes import Nodes
from tests.components.fe.samples import NAMES, calculix, deck, expected, frequencies

KINDS = {"hexahedron": "C3D8I", "hexahedron20": "C3D20", "tetra10": "C3D10"}
# Of what such a file may hold instead: the name of the file, what happens to its text, and a part of the message.
WRONG = {
    "no_nodes_file": ("inp", None, "No such file"),
    "no_stiffness": ("sti", None, "No such file"),
    "empty": ("sti", lambda s: "", "the file is empty"),
    "binary": ("mas", lambda s: "\0\1\2" * 100, "this is a binary file"),
    "foreign": ("sti", lambda s: "hello\nworld\n", "line 1: a line must be row, column, value, not `hello`"),
    "foreign_deck": ("inp", lambda s: "hello\nworld\n", "no keyword such as"),
    "half_a_line": ("sti", lambda s: s[: len(s) // 2 - 3], "row, column, value|is incomplete"),
    "half_a_number": ("sti", lambda s: s[:-6], "is incomplete; the file seems to be truncated"),
    "half_a_file": (
        "sti",
        lambda s: "\n".join(s.splitlines()[:1000]) + "\n",
        "has no diagonal entry; the file may be",
    ),
    "not_a_number": ("sti", lambda s: s.replace("1 2  ", "1 2  x", 1), "line 2: .*`x2.1.*is not a finite number"),
    "infinite": ("sti", lambda s: s.replace("e+08", "e+999", 1), "is not a finite number"),
    "nan": ("mas", lambda s: s.replace("0.0000000000000e+00", "nan", 1), "`nan` is not a finite number"),
    "four_columns": ("sti", lambda s: s.replace("1 2  ", "1 2  3 ", 1), "line 2: a line must be row, column, value"),
    "outside": ("sti", lambda s: s + "1 999  1.0\n", r"the entry \(1, 999\) is outside"),
    "no_row": ("sti", lambda s: s + "0 3  1.0\n", r"the entry \(0, 3\) is outside"),
    "half_row": ("sti", lambda s: s + "1.5 3  1.0\n", "row and column must be integers, not 1.5"),
    "twice": ("sti", lambda s: s + s.splitlines()[0] + "\n", r"the entry \(1, 1\) occurs twice"),
    "equations_cut": ("dof", lambda s: s[: len(s) // 2].rsplit("\n", 1)[0] + "\n", "is outside the matrix"),
    "equations_cut_in_a_line": ("dof", lambda s: s[:-2], "node.direction|is incomplete"),
    "rotation": (
        "dof",
        lambda s: s.replace("2.3", "2.4", 1),
        "node 2 has the degree of freedom 4, which is not a displacement",
    ),
    "equation_twice": ("dof", lambda s: s.replace("2.3", "2.2", 1), "an equation occurs twice"),
    "word_for_an_equation": ("dof", lambda s: s.replace("2.3", "x.3", 1), "line 6: a line must be node.direction"),
    "huge": ("dof", lambda s: s.replace("2.3", f"{10**20}.3", 1), "the node number 1000"),
    "node_of_huge_number": (
        "inp",
        lambda s: s.replace("\n5,", f"\n{10**20},", 1),
        "line 6: a node number must be from 1",
    ),
    "node_zero": ("inp", lambda s: s.replace("\n5,", "\n0,", 1), "line 6: a node number must be from 1"),
    "shell": ("dof", lambda s: s.replace("1.1\n", "900.1\n", 1), "only solids are supported"),
    "no_node": ("inp", lambda s: s.replace("\n5,", "\n905,", 1), "node 5 has equations or elements, but no position"),
    "node_without_number": (
        "inp",
        lambda s: s.replace("\n5,", "\nx,", 1),
        "line 6: a node needs number, x, y, z",
    ),
    "node_twice": ("inp", lambda s: s.replace("\n5,", "\n4,", 1), "node 4 is defined twice"),
    "generated": ("inp", lambda s: s.replace("*ELEMENT", "*NGEN\n1,9,1\n*ELEMENT", 1), r"\*NGEN is not supported"),
    "cylinder": ("inp", lambda s: s.replace("*NODE,", "*NODE,SYSTEM=C,", 1), "cylindrical"),
    "include_lost": ("inp", lambda s: s + "*INCLUDE, INPUT=lost.inc\n", "lost.inc: No such file"),
    "include_nothing": ("inp", lambda s: s + "*INCLUDE\n", "lacks INPUT"),
    "include_itself": ("inp", lambda s: s + "*INCLUDE, INPUT=c3d20.inp\n", "INCLUDE is nested"),
}


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return calculix(tmp_path_factory.mktemp("calculix"))


@pytest.mark.parametrize("name", NAMES)
@pytest.mark.parametrize("end", ["", ".inp", ".sti"])
def test_frequencies(folder: Path, name: str, end: str) -> None:
    M, K, nodes = read_calculix(folder / f"{name}{end}")
    want = expected(name)
    found = frequencies(M, K)[: want.size]
    elastic = want > 0
    assert np.abs(found[elastic] / want[elastic] - 1).max() < 1e-6
    assert found[~elastic].max(initial=0) < 1e-4 * want[elastic][0]
    assert M.shape == K.shape == (3 * len(nodes), 3 * len(nodes))
    assert abs(K - K.T).max() == 0
    assert nodes.numbers.tolist() == list(range(1, len(nodes) + 1))
    if "held" not in name:
        body = reduce_body(M, K, nodes, frames={"end": [0, 1, 2, 3]}, modes=10)
        assert body.frequencies == pytest.approx(want[6:], rel=1e-6)
        assert body.mass == pytest.approx(7850 * 0.1 * 0.015 * 0.01, rel=1e-12)


@pytest.mark.parametrize("name", ["c3d8i", "c3d20", "c3d10"])
@pytest.mark.parametrize("more", [" 1, 2,", ","])
def test_more_nodes_than_an_element_has(folder: Path, tmp_path: Path, name: str, more: str) -> None:
    """CalculiX takes the first nodes of an element, whatever follows in its last line, a comma included."""
    for end in ("sti", "mas", "dof"):
        shutil.copy(folder / f"{name}.{end}", tmp_path)
    head, rest = (folder / f"{name}.inp").read_text().split("*ELEMENT", 1)
    lines, after = rest.split("*", 1)
    longer = [line + ("" if line.endswith(",") else f",{more}") for line in lines.strip("\n").split("\n")[1:]]
    text = f"{head}*ELEMENT{lines.splitlines()[0]}\n" + "\n".join(longer) + f"\n*{after}"
    (tmp_path / f"{name}.inp").write_text(text)
    plain, found = read_calculix(folder / name), read_calculix(tmp_path / name)
    assert abs(found[1] - plain[1]).max() == 0
    kinds = plain[2].cells
    assert {kind: rows.tolist() for kind, rows in found[2].cells.items()} == {k: r.tolist() for k, r in kinds.items()}


def test_exponents_of_fortran(folder: Path, tmp_path: Path) -> None:
    for end in ("inp", "sti", "mas", "dof"):
        text = (folder / f"c3d20.{end}").read_text()
        (tmp_path / f"c3d20.{end}").write_text(re.sub(r"(?<=\d)e(?=[+-]\d)", "D", text))
    assert "D+" in (tmp_path / "c3d20.sti").read_text()
    assert abs(read_calculix(tmp_path / "c3d20")[1] - read_calculix(folder / "c3d20")[1]).max() == 0


def test_units(folder: Path) -> None:
    """In mm, N, Mg the numbers of a file mean 1e3 kg and 1e3 N/m."""
    plain, scaled = read_calculix(folder / "c3d8i"), read_calculix(folder / "c3d8i", length=1e-3, mass=1e3)
    assert abs(scaled[0] - 1e3 * plain[0]).max() == 0
    assert abs(scaled[1] - 1e3 * plain[1]).max() < 1e-12 * abs(plain[1]).max()
    assert np.abs(scaled[2] - 1e-3 * plain[2]).max() < 1e-17


def test_held_nodes_are_named(folder: Path) -> None:
    M, K, nodes = read_calculix(folder / "c3d10_held")
    with pytest.raises(DeclarationError, match=r"were fixed") as caught:
        reduce_body(M, K, nodes, frames={"end": [68, 69, 70]}, modes=4)
    assert "nodes 0, 1, 2, 3, 27, 29, 30, 32, 33 (in the file 1, 2, 3, 4, 28, 30, 31, 33, 34)" in str(caught.value)


def test_rows_of_numbers(folder: Path) -> None:
    nodes = read_calculix(folder / "c3d20")[2]
    assert rows_of(nodes, [17, 1]) == [16, 0]
    with pytest.raises(DeclarationError, match="there is no node 99 in the file; its node numbers are 1 to 56"):
        rows_of(nodes, [99])
    with pytest.raises(DeclarationError, match="use rows, counted from 0"):
        rows_of(nodes[2:], [3])  # a part of the nodes no longer knows


def test_node_numbers_with_gaps_and_nodes_without_elements(folder: Path, tmp_path: Path) -> None:
    for end in ("sti", "mas"):
        shutil.copy(folder / f"c3d20.{end}", tmp_path / f"job.{end}")
    rename = {number: 10 * number + 3 for number in range(1, 57)}
    equations = (folder / "c3d20.dof").read_text().split()
    lines = [f"{rename[int(e.partition('.')[0])]}.{e.partition('.')[2]}" for e in equations]
    (tmp_path / "job.dof").write_text("\n".join(lines) + "\n")
    plain = read_calculix(folder / "c3d20")
    renamed = Nodes(plain[2], list(rename.values()), plain[2].cells)
    text = deck(renamed, KINDS, E=1, nu=0, rho=1).replace("*ELEMENT", "20, 7, 7, 7\n*ELEMENT", 1)
    (tmp_path / "job.inp").write_text(text)
    M, K, nodes = read_calculix(tmp_path / "job")
    assert nodes.numbers.tolist() == list(rename.values())
    assert np.array_equal(nodes, plain[2])
    assert abs(M - plain[0]).max() == abs(K - plain[1]).max() == 0


@pytest.mark.parametrize("case", WRONG)
def test_wrong_files(folder: Path, tmp_path: Path, case: str) -> None:
    end, change, message = WRONG[case]
    for kind in ("inp", "sti", "mas", "dof"):
        shutil.copy(folder / f"c3d20.{kind}", tmp_path / f"c3d20.{kind}")
    path = tmp_path / f"c3d20.{end}"
    if change is None:
        path.unlink()
    else:
        path.write_text(change(path.read_text()))
    with pytest.raises(DeclarationError, match=message) as caught:
        read_calculix(tmp_path / "c3d20")
    assert "c3d20" in str(caught.value) or "lost.inc" in str(caught.value)


@pytest.mark.slow
@pytest.mark.skipif(shutil.which("ccx") is None, reason="CalculiX is not installed")
@pytest.mark.parametrize("element", ["hex8", "hex20", "tet10"])
def test_run_in_millimetres(tmp_path: Path, element: str) -> None:
    """CalculiX's stiffness is that of our own elements, and its matrices in mm, N, Mg are those in SI."""
    E, nu, rho = 70e9, 0.33, 2700.0
    M, K, nodes = box((0.1, 0.02, 0.03), (4, 2, 1), element, E=E, nu=nu, rho=rho)
    millimetres = Nodes(nodes * 1e3, cells=nodes.cells)
    step = "*STEP\n*FREQUENCY, SOLVER=MATRIXSTORAGE\n\n*END STEP"
    (tmp_path / "job.inp").write_text(deck(millimetres, KINDS, E=E * 1e-6, nu=nu, rho=rho * 1e-12, step=step))
    subprocess.run(["ccx", "job"], cwd=tmp_path, capture_output=True, timeout=100)
    M_c, K_c, places = read_calculix(tmp_path / "job", length=1e-3, mass=1e3)
    assert np.abs(places - nodes).max() < 1e-15
    assert abs(K_c - K).max() < 1e-9 * abs(K).max()
    if element != "tet10":  # whose mass CalculiX integrates with 4 points
        assert abs(M_c - M).max() < 1e-9 * abs(M).max()
    assert M_c.sum() / 3 == pytest.approx(rho * 0.1 * 0.02 * 0.03, rel=1e-10)
    with pytest.warns(match="density|speed of sound"):
        reduce_body(*read_calculix(tmp_path / "job"), frames={"end": [0, 1, 2]}, modes=1)
