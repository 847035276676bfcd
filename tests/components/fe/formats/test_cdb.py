"""Archives of Ansys, written by the tests as CDWRITE lays them out: blocks of fixed fields."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from acausal import AcausalWarning, DeclarationError
from components.fe import box, read_mesh
from components.fe.elements.box import mesh

STEEL = {"E": 2.1e11, "nu": 0.3, "rho": 7850.0}
ROUTINES = {"hexahedron": 185, "hexahedron20": 186, "tetra10": 187, "tetra": 285}
FORMATS = {"wide": ("(3i9,6e21.13e3)", 9, 21, 13, "(19i9)", 9), "narrow": ("(3i8,6e16.9)", 8, 16, 9, "(19i10)", 10)}


def archive(points: np.ndarray, cells: dict[str, list], form: str = "wide", routines: dict[str, int] = ROUTINES) -> str:
    """The text of an archive; nodes are numbered 11, 13, 15, ..., and trailing zeros of a place are left out."""
    head, i, e, digits, elements, k = FORMATS[form]
    lines = ["/COM,ANSYS", "/PREP7"]
    lines += [f"ET,{number:9d},{routines[kind]}" for number, kind in enumerate(cells, 1)]
    lines += [f"NBLOCK,6,SOLID,{len(points):9d},{len(points):9d}", head]
    for row, place in enumerate(np.asarray(points)):
        used = np.trim_zeros(place, "b")
        lines.append(f"{11 + 2 * row:{i}d}{0:{i}d}{0:{i}d}" + "".join(f"{x:{e}.{digits}E}" for x in used))
    lines += ["N,R5.3,LOC,       -1,", f"EBLOCK,19,SOLID,{9:9d},{9:9d}", elements]
    count = 0
    for number, members in enumerate(cells.values(), 1):
        for nodes in np.asarray(members):
            count += 1
            names = [0 if row < 0 else 11 + 2 * row for row in nodes]
            whole = [1, number, 1, 1, 0, 0, 0, 0, len(names), 0, count, *names]
            lines += ["".join(f"{word:{k}d}" for word in part) for part in (whole[:19], whole[19:]) if part]
    return "\n".join([*lines, f"{-1:{k}d}", "FINISH", ""])


@pytest.mark.parametrize("element", ["hex8", "hex20", "tet10"])
@pytest.mark.parametrize("form", FORMATS)
def test_round_trip(tmp_path: Path, element: str, form: str) -> None:
    M, K, nodes = box((0.1, 0.02, 0.03), (3, 2, 1), element, **STEEL)
    (tmp_path / "a.cdb").write_text(archive(1e3 * nodes, nodes.cells, form))
    found = read_mesh(tmp_path / "a.cdb", **STEEL, length=1e-3)
    assert np.abs(found[2] - nodes).max() < 1e-9
    assert abs(found[0] - M).max() < 1e-7 * abs(M).max()
    assert abs(found[1] - K).max() < 1e-7 * abs(K).max()
    assert found[2].numbers.tolist() == [11 + 2 * row for row in range(len(nodes))]
    assert {k: r.tolist() for k, r in found[2].cells.items()} == {k: r.tolist() for k, r in nodes.cells.items()}


def test_bricks_collapsed_to_tetrahedra(tmp_path: Path) -> None:
    """I J K K M M M M: with nodes on edges, which are at the corner where the edge has no length."""
    _, K, nodes = box((0.1, 0.02, 0.03), (1, 1, 1), "tet10", **STEEL)
    a = nodes.cells["tetra10"]
    i, j, k, m = a[:, 0], a[:, 1], a[:, 2], a[:, 3]
    ij, jk, ki, im, jm, km = (a[:, c] for c in range(4, 10))
    bricks = np.stack([i, j, k, k, m, m, m, m, ij, jk, k, ki, m, m, m, m, im, jm, km, km], axis=1)
    (tmp_path / "a.cdb").write_text(archive(nodes, {"hexahedron20": bricks}))
    found = read_mesh(tmp_path / "a.cdb", **STEEL)
    assert abs(found[1] - K).max() < 1e-10 * abs(K).max()
    assert np.array_equal(found[2].cells["tetra10"], a)


def test_solids_without_nodes_on_edges_and_surfaces(tmp_path: Path) -> None:
    """Solids of 10 nodes that have 4, or zeros for the others; elements of surfaces are passed over."""
    points, cells = mesh((0.1, 0.02, 0.03), (1, 1, 1), "tet10")
    used, rows = np.unique(cells["tetra10"][:, :4], return_inverse=True)
    corners = rows.reshape(-1, 4)
    bare = np.hstack([corners[3:], np.full((3, 6), -1)])
    text = archive(
        points[used],
        {"tetra10": corners[:3], "bare": bare, "surface": corners[:2, :3]},
        routines={"tetra10": 187, "bare": 187, "surface": 154},
    )
    (tmp_path / "a.cdb").write_text(text)
    with pytest.warns(AcausalWarning, match="tetrahedra of 4 nodes"):
        M, _, nodes = read_mesh(tmp_path / "a.cdb", **STEEL)
    assert M.sum() / 3 == pytest.approx(7850 * 6e-5)
    assert np.array_equal(nodes.cells["tetra"], corners)


WRONG = {
    "foreign": (lambda s: "hello\n", "there is no NBLOCK in it; CDWRITE,DB writes both"),
    "nodes_alone": (lambda s: s[: s.index("EBLOCK")], "there is no EBLOCK of solids in it"),
    "cut_in_nodes": (lambda s: s[: s.index("N,R5.3")], "it ends inside NBLOCK, which begins in line 4"),
    "cut_in_elements": (lambda s: s[: s.index("FINISH") - 12], "it ends inside EBLOCK"),
    "half_an_element": (
        lambda s: "\n".join([*s.split("\n")[:-4], *s.split("\n")[-3:]]),
        "element 2 has 8 nodes instead of 20",
    ),
    "no_format": (lambda s: s.replace("(3i9,6e21.13e3)", "hello", 1), "line 5: NBLOCK must begin with its format"),
    "word": (lambda s: s.replace("E-02", "x-02", 1), "x, y, z of a node must be numbers"),
    "type": (lambda s: s.replace("ET,        1", "ET,        2", 1), "a type that no ET defines"),
    "node": (
        lambda s: s.replace("       11       ", "       12       ", 1),
        "refers to node 11, which is not in the file",
    ),
    "letters": (lambda s: s.replace("(19i9)\n        1", "(19i9)\n        x", 1), "integers are expected here"),
}


@pytest.mark.parametrize("case", WRONG)
def test_wrong_files(tmp_path: Path, case: str) -> None:
    change, message = WRONG[case]
    _, _, nodes = box((0.1, 0.02, 0.03), (2, 1, 1), "hex20", **STEEL)
    (tmp_path / "a.cdb").write_text(change(archive(nodes, nodes.cells)))
    with pytest.raises(DeclarationError, match=message):
        read_mesh(tmp_path / "a.cdb", **STEEL)
