"""Matrix Market files: what scipy writes is read, under every way to name three files; other files are refused."""

from __future__ import annotations

import gzip
import re
import shutil
from pathlib import Path

import numpy as np
import pytest
import scipy.sparse as sp
from scipy.io import mmwrite

from acausal import DeclarationError
from components.fe import box, read_matrix_market

BODY = box((0.1, 0.02, 0.03), (2, 1, 1), "hex8", E=7e10, nu=0.33, rho=2700)
HEAD = "%%MatrixMarket matrix coordinate real general\n"
WRONG = {
    "empty": ("K", lambda s: "", "the file is empty"),
    "foreign": ("K", lambda s: "hello\n", "must begin with `%%MatrixMarket"),
    "half": ("M", lambda s: s[: len(s) // 2], "a line must be row, column, value|the header says"),
    "lines_lost": (
        "M",
        lambda s: "".join(s.splitlines(True)[:-7]),
        r"there are \d+ entries, but the header says \d+; the file may be truncated",
    ),
    "complex": ("K", lambda s: s.replace(" real ", " complex ", 1), "not `coordinate complex symmetric`"),
    "pattern": (
        "K",
        lambda s: "%%MatrixMarket matrix coordinate pattern general\n36 36 1\n1 1\n",
        "a real matrix, general or symmetric, is expected",
    ),
    "skew": ("K", lambda s: s.replace("symmetric", "skew-symmetric", 1), "skew-symmetric"),
    "infinite": ("K", lambda s: re.sub(r"(?i)(\d)(e\+?0?\d)?\n$", r"\1e999\n", s), "`.*e999` is not a finite number"),
    "nan": (
        "nodes",
        lambda s: s[: s.rindex("\n", 0, -1)] + "\nnan\n",
        "line 39: a line must be value, and `nan` is not a finite number",
    ),
    "outside": ("K", lambda s: f"{HEAD}36 36 1\n1 99 2.0\n", r"the entry \(1, 99\) is outside"),
    "size": ("K", lambda s: f"{HEAD}33 33 1\n1 1 2.0\n", "the matrix is 33 x 33, but 12 nodes have 36 equations"),
    "more": ("nodes", lambda s: s + "7\n", "there are 37 entries, but the header says 36"),
    "sizes": ("K", lambda s: f"{HEAD}36 36\n", "the size line needs 3 integers, not `36 36`"),
    "no_sizes": ("K", lambda s: HEAD, "the size line needs 3 integers"),
    "binary": ("K", lambda s: s + "\0", "this is a binary file"),
    "huge": ("K", lambda s: f"{HEAD}3000000000 3000000000 1\n1 1 2.0\n", "the matrix is 3000000000 x"),
    "plane": ("nodes", lambda s: "%%MatrixMarket matrix array real general\n2 2\n1\n2\n3\n4\n", "three columns"),
    "lost": ("nodes", None, "neither bodynodes.mtx nor"),
}


def write(folder: Path, begin: str, mark: str = "") -> None:
    for name, matrix in zip(("M", "K", "nodes"), BODY, strict=True):
        given = np.asarray(matrix) if name == "nodes" else sp.coo_matrix(matrix)
        mmwrite(folder / f"{begin}{mark}{name}.mtx", given, precision=17)


def same(found: tuple) -> bool:
    return all(abs(a - b).max() == 0 for a, b in zip(found, BODY, strict=True))


@pytest.mark.parametrize("mark", ["", "_", "-", "."])
def test_three_files_by_what_their_names_have_in_common(tmp_path: Path, mark: str) -> None:
    write(tmp_path, "body", mark)
    for given in ("body", *(f"body{mark}{name}.mtx" for name in ("M", "K", "nodes"))):
        assert same(read_matrix_market(tmp_path / given))


def test_folder_three_names_and_compressed_files(tmp_path: Path) -> None:
    write(tmp_path, "")
    assert same(read_matrix_market(tmp_path))
    moved = [
        shutil.move(tmp_path / f"{name}.mtx", tmp_path / f"mat_{k}.txt") for k, name in enumerate(("M", "K", "nodes"))
    ]
    assert same(read_matrix_market(moved))
    for name, path in zip(("M", "K", "nodes"), moved, strict=True):
        (tmp_path / f"z_{name}.mtx.gz").write_bytes(gzip.compress(Path(path).read_bytes()))
    assert same(read_matrix_market(tmp_path / "z"))
    assert same(read_matrix_market(tmp_path / "z_K.mtx.gz"))
    (tmp_path / "z_K.mtx.gz").write_bytes((tmp_path / "z_K.mtx.gz").read_bytes()[:300])
    with pytest.raises(DeclarationError, match=r"z_K\.mtx\.gz"):
        read_matrix_market(tmp_path / "z")


def test_general_and_symmetric_storage_and_units(tmp_path: Path) -> None:
    M, K, nodes = BODY
    mmwrite(tmp_path / "M.mtx", sp.coo_matrix(M * 1e-3), precision=17, symmetry="general")
    mmwrite(tmp_path / "K.mtx", sp.coo_matrix(K * 1e-3), precision=17, symmetry="symmetric")
    mmwrite(tmp_path / "nodes.mtx", np.asarray(nodes) * 1e3, precision=17)
    found = read_matrix_market(tmp_path, length=1e-3, mass=1e3)
    assert all(abs(a - b).max() < 1e-15 * abs(b).max() for a, b in zip(found, BODY, strict=True))
    for symmetry in ("general", "symmetric"):  # dense
        mmwrite(tmp_path / "M.mtx", M.toarray(), precision=17, symmetry=symmetry)
        assert abs(read_matrix_market(tmp_path)[0] - M).max() == 0


@pytest.mark.parametrize("letter", ["D", "d", ""])
def test_exponents_of_fortran(tmp_path: Path, letter: str) -> None:
    """1.5D+10, and 1.5+010: a third digit takes the place of the letter."""
    write(tmp_path, "")
    for path in tmp_path.iterdir():
        path.write_text(re.sub(r"e([+-])(?=\d\d)", rf"{letter}\g<1>0", path.read_text()))
    assert letter or re.search(r"\d[+-]0\d\d", (tmp_path / "K.mtx").read_text())
    assert same(read_matrix_market(tmp_path))


@pytest.mark.parametrize("case", WRONG)
def test_wrong_files(tmp_path: Path, case: str) -> None:
    name, change, message = WRONG[case]
    write(tmp_path, "body")
    path = tmp_path / f"body{name}.mtx"
    if change is None:
        path.unlink()
    else:
        path.write_text(change(path.read_text()))
    with pytest.raises(DeclarationError, match=message):
        read_matrix_market(tmp_path / "body")


def test_other_names(tmp_path: Path) -> None:
    with pytest.raises(DeclarationError, match=r"does not end in M\.mtx"):
        read_matrix_market(tmp_path / "stiffness.mtx")
    with pytest.raises(DeclarationError, match="pass three Matrix Market files"):
        read_matrix_market([tmp_path / "a.mtx", tmp_path / "b.mtx"])
