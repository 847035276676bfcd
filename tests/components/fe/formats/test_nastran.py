"""Matrices of Nastran: OP4 files and bulk data that pyyeti writes."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
import scipy.sparse as sp

from acausal import DeclarationError
from components.fe import box, read_nastran
from tests.components.fe.packages import nastran

op4, bulk = nastran("op4"), nastran("bulk")
M, K, NODES = box((0.1, 0.02, 0.03), (2, 1, 1), "hex20", E=7e10, nu=0.33, rho=2700)
NUMBERS = 7 * np.arange(len(NODES)) + 5
# Of meshio's node in the order of Nastran: edges between the faces come before those of the second face.
ORDER = [*range(12), *range(16, 20), *range(12, 16)]


def grown(matrix, each: int = 6, turn: float = 0.0):
    """The matrix with six equations of each node."""
    entries = matrix.tocoo()
    rows, columns = (each * (index // 3) + index % 3 for index in (entries.row, entries.col))
    found = sp.coo_matrix((entries.data, (rows, columns)), (each * len(NODES),) * 2).tolil()
    if turn:
        found[4, 4] = turn
    return found.tocoo()


def cards(extra: str = "") -> str:
    lines = ["$ a box", "BEGIN BULK"]
    order = np.argsort(-NUMBERS)  # any order
    lines += [
        f"GRID*   {NUMBERS[k]:16d}{0:16d}{NODES[k][0]:16.9E}{NODES[k][1]:16.9E}\n*       {NODES[k][2]:16.9E}"
        for k in order
    ]
    for k, cell in enumerate(NODES.cells["hexahedron20"]):
        words = [f"{word:8d}" for word in (k + 1, 1, *NUMBERS[cell[ORDER]])]
        lines += ["CHEXA   " + "".join(words[:8]), " " * 8 + "".join(words[8:16]), " " * 8 + "".join(words[16:])]
    return "\n".join([*lines, extra, "ENDDATA", ""])


def write(
    folder: Path, stiffness=None, masses=None, *, binary: bool = True, names=("KGG", "MGG"), extra: str = ""
) -> Path:
    path = folder / "job.op4"
    given = [grown(K) if stiffness is None else stiffness, grown(M) if masses is None else masses]
    op4.write(str(path), list(names), given, binary=binary, digits=16, forms=[6, 6])
    (folder / "job.bdf").write_text(cards(extra))
    return path


@pytest.mark.parametrize("binary", [True, False])
@pytest.mark.parametrize("each", [3, 6])
def test_round_trip(tmp_path: Path, binary: bool, each: int) -> None:
    found = read_nastran(write(tmp_path, grown(K, each), grown(M, each), binary=binary))
    assert abs(found[0] - M).max() < 1e-15
    assert abs(found[1] - K).max() < 1e-15 * abs(K).max()
    assert np.abs(found[2] - NODES).max() < 1e-11
    assert found[2].numbers.tolist() == NUMBERS.tolist()
    assert np.array_equal(found[2].cells["hexahedron20"], NODES.cells["hexahedron20"])


def test_numbers_are_printed_as_before(tmp_path: Path) -> None:
    """In a process that did not import pyyeti yet."""
    told = "import sys; import numpy as np; from components.fe import read_nastran; np.set_printoptions(sign='+', precision=3)"
    told += "; before = np.get_printoptions(); read_nastran(sys.argv[1]); assert 'pyyeti.nastran' in sys.modules"
    told += "; assert np.get_printoptions() == before; assert repr(np.ones(2)) == 'array([+1., +1.])'"
    subprocess.run([sys.executable, "-c", told, str(write(tmp_path))], check=True)


def test_one_triangle_and_units(tmp_path: Path) -> None:
    path = write(tmp_path, sp.tril(grown(K)).tocoo(), sp.triu(grown(M)).tocoo())
    found = read_nastran(path, length=1e-3, mass=1e3)
    assert abs(found[1] - 1e3 * K).max() < 1e-12 * abs(K).max()
    assert abs(found[0] - 1e3 * M).max() < 1e-12
    assert np.abs(found[2] - 1e-3 * NODES).max() < 1e-14


def test_coordinate_systems(tmp_path: Path) -> None:
    """A grid point may stand in a system of its own, but its displacements may not."""
    path = write(tmp_path)
    system = "CORD2R,9,0,1.,0.,0.,1.,0.,1.\n,1.,1.,0."
    text = (tmp_path / "job.bdf").read_text().replace("ENDDATA", system + "\nENDDATA")
    moved = np.asarray(NODES[0]) - [1, 0, 0]  # its x is y of the basic system, and its y is -x
    line = f"GRID*   {5:16d}{9:16d}{moved[1]:16.9E}{-moved[0]:16.9E}\n*       {moved[2]:16.9E}"
    at = text.index(f"GRID*   {5:16d}")
    old = text[at : text.index("\n", text.index("\n", at) + 1)]
    (tmp_path / "job.bdf").write_text(text.replace(old, line))
    assert np.abs(read_nastran(path)[2] - NODES).max() < 1e-11
    (tmp_path / "job.bdf").write_text(text.replace(old, old + f"{9:16d}"))
    with pytest.raises(DeclarationError, match=r"grid point 5 has a displacement coordinate system \(CD\)"):
        read_nastran(path)


def test_points_without_elements_are_left_out(tmp_path: Path) -> None:
    size = 6 * (len(NODES) + 1)
    more = [sp.coo_matrix((m.data, (m.row, m.col)), (size, size)) for m in (grown(K), grown(M))]
    path = write(tmp_path, *more, extra="GRID        9999              1.      2.      3.")
    found = read_nastran(path)
    assert abs(found[1] - K).max() < 1e-15 * abs(K).max()
    assert found[2].numbers.tolist() == NUMBERS.tolist()


def test_what_is_refused(tmp_path: Path) -> None:
    def refused(message: str, *args, **options) -> None:
        with pytest.raises(DeclarationError, match=message):
            read_nastran(write(tmp_path, *args, **options))

    refused("KGG has entries for a rotation of grid point 5", grown(K, turn=1.0))
    refused("MGG is 96 x 96, but 33 grid points have 198", grown(K, 3), grown(M, 3), extra="GRID,9999,,1.,2.,3.")
    refused("exactly one matrix name must begin with M; the file has KGG, BGG", names=("KGG", "BGG"))
    path = write(tmp_path)
    (tmp_path / "job.bdf").unlink()
    with pytest.raises(DeclarationError, match=r"there is no job\.bdf"):
        read_nastran(path)
    (tmp_path / "job.bdf").write_text("hello\n")
    with pytest.raises(DeclarationError, match=r"job\.bdf"):
        read_nastran(path)
    with pytest.raises(DeclarationError, match="there is no such file"):
        read_nastran(tmp_path / "lost.op4")
    with pytest.raises(DeclarationError, match="it is a directory"):
        read_nastran(tmp_path)


@pytest.mark.parametrize("binary", [True, False])
def test_files_that_are_cut_off_or_foreign(tmp_path: Path, binary: bool) -> None:
    path = write(tmp_path, binary=binary)
    content = path.read_bytes()
    for part in (0, 5, 40, 300, len(content) // 3, len(content) // 2, len(content) - 300):
        path.write_bytes(content[:part])
        with pytest.raises(DeclarationError, match=r"job\.op4: .*or is truncated"):
            read_nastran(path)
    for text in (b"hello\nworld\n" * 20, bytes(range(256)) * 8):
        path.write_bytes(text)
        with pytest.raises(DeclarationError, match=r"job\.op4: .*not an OP4 file"):
            read_nastran(path)
