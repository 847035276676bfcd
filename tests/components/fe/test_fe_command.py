"""`python -m components.fe reduce`: every kind of file, what it prints, what it refuses, and files whole or not at all."""

from __future__ import annotations

import shutil
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
import scipy.sparse as sp
from scipy.io import mmwrite
from typer.testing import CliRunner

from components.fe import ReducedBody, box, read_calculix, read_npz, reduce_body, write_sid
from components.fe.__main__ import app
from tests.components.fe.packages import nastran
from tests.components.fe.samples import calculix, deck, frequencies, write_abaqus

KINDS = {"hexahedron": "C3D8I"}
STEEL = {"E": 2.1e11, "nu": 0.3, "rho": 7850.0}
BODY = box((0.1, 0.02, 0.03), (3, 2, 1), "hex8", **STEEL)
FRAMES = ["--frame", "root=0,1,2,3", "--frame", "tip=18,19,20"]
GIVEN = {"frames": {"root": [0, 1, 2, 3], "tip": [18, 19, 20]}, "hold": "root", "modes": 5}


def npz(path: Path, *, length: float = 1.0, mass: float = 1.0) -> Path:
    M, K, nodes = BODY
    np.savez(path, K=K.toarray() / mass, M=M.toarray() / mass, nodes=np.asarray(nodes) / length)
    return path


def run(*words: object) -> tuple[int, str, str]:
    done = CliRunner().invoke(app, ["reduce", *map(str, words)])
    assert "Traceback" not in done.output
    return done.exit_code, done.stdout, done.stderr


def reduced(*words: object, out: Path, **options) -> ReducedBody:
    status, _, error = run(*words, *FRAMES, "--hold", "root", "--modes", 5, "--out", out)
    assert (status, error) == (0, "")
    return ReducedBody.load(out)


def test_the_same_body_from_every_file(tmp_path: Path) -> None:
    M, K, nodes = BODY
    out = tmp_path / "body.npz"
    expected = reduce_body(M, K, nodes, **GIVEN)

    def same(found: ReducedBody) -> None:
        assert found.frequencies == pytest.approx(expected.frequencies, rel=1e-9)
        assert found.mass == pytest.approx(expected.mass, rel=1e-12)
        assert found.second_moment == pytest.approx(expected.second_moment, rel=1e-9, abs=1e-12 * expected.mass)
        size = np.abs(expected.interfaces[1].displacement).max()
        assert np.abs(found.interfaces[1].displacement - expected.interfaces[1].displacement).max() < 1e-7 * size
        assert np.abs(found.modal_products - expected.modal_products).max() < 1e-7

    plain = reduce_body(M, K, np.asarray(nodes), **GIVEN)
    assert reduced(npz(tmp_path / "a.npz"), out=out) == plain
    same(plain)
    same(reduced(npz(tmp_path / "b.npz", length=1e-3, mass=1e3), "--length", 1e-3, "--mass", 1e3, out=out))
    for name, matrix in (("M", sp.coo_matrix(M)), ("K", sp.coo_matrix(K)), ("nodes", np.asarray(nodes))):
        mmwrite(tmp_path / f"c_{name}.mtx", matrix, precision=17)
    assert reduced(tmp_path / "c", out=out) == plain
    assert reduced(tmp_path / "c_K.mtx", out=out) == plain
    for kind, matrix in (("STIF", K), ("MASS", M)):
        write_abaqus(tmp_path / f"d_{kind}1.mtx", matrix, np.arange(len(nodes)) + 1)
    (tmp_path / "d.inp").write_text(deck(nodes, KINDS, **STEEL))
    same(reduced(tmp_path / "d.inp", out=out))
    same(reduced(tmp_path / "d_STIF1.mtx", out=out))
    (tmp_path / "e.inp").write_text(deck(nodes, KINDS, **STEEL))  # alone it is a mesh
    same(reduced(tmp_path / "e.inp", "--material", "2.1e11,0.3,7850", out=out))
    write_sid(expected, tmp_path / "f.sid")
    status, text, error = run(tmp_path / "f.sid", "--out", out)
    assert (status, error) == (0, "")
    assert "5 modes" in text
    same(ReducedBody.load(out))


def test_nastran(tmp_path: Path) -> None:
    op4 = nastran("op4")
    M, K, nodes = BODY
    op4.write(str(tmp_path / "a.op4"), ["KGG", "MGG"], [sp.coo_matrix(K), sp.coo_matrix(M)])
    lines = [f"GRID*   {k + 1:16d}{0:16d}{x:16.9E}{y:16.9E}\n*       {z:16.9E}" for k, (x, y, z) in enumerate(nodes)]
    (tmp_path / "a.bdf").write_text("\n".join([*lines, "ENDDATA", ""]))
    found = reduced(tmp_path / "a.op4", out=tmp_path / "out.npz")
    assert found.frequencies == pytest.approx(reduce_body(*BODY, **GIVEN).frequencies, rel=1e-9)


def test_calculix_by_numbers_of_nodes(tmp_path: Path) -> None:
    folder = calculix(tmp_path)
    out = tmp_path / "out.npz"
    words = ["--frame", "root=1,2,3,4", "--by-number", "--hold", "1,2,3", "--modes", 12, "--out", out]
    status, text, error = run(folder / "c3d20.inp", *words)
    assert (status, error) == (0, "")
    body = ReducedBody.load(out)
    M, K, _ = read_calculix(folder / "c3d20")
    held = np.ones(M.shape[0], dtype=bool)
    held[[0, 1, 2, 4, 3, 6]] = False  # node 1; node 2 stays above it, node 3 in the plane of the three
    assert body.frequencies[:3] == pytest.approx(frequencies(M[held][:, held], K[held][:, held])[:3], rel=1e-6)
    assert f"{body.frequencies[0]:12.6g} Hz" in text
    assert body.interfaces[0].name == "root"
    assert body.nodal is not None
    assert "hexahedron20" in body.nodal.cells
    status, _, error = run(folder / "c3d10_held.sti", "--frame", "a=0,1,2", "--out", out)
    assert status == 2
    assert "(in the file 1, 2, 3, 4, 28, 30, 31, 33, 34)" in error


@pytest.mark.parametrize(
    ("words", "message"),
    [
        (["lost.npz", *FRAMES], "there is no file"),
        (["lost", *FRAMES], "there is no file lost; reduce accepts matrices"),
        (["a.npz"], "add --frame NAME=I,J,K"),
        (["a.npz", "--frame", "tip"], "--frame must be NAME=I,J,K"),
        (["a.npz", "--frame", "tip=x"], "--frame tip must list nodes, such as 0,2,4, not `x`"),
        (["a.npz", "--frame", "2=1"], "`2` is not a valid frame name"),
        (["a.npz", "--frame", "tip=99"], "99"),
        (["a.npz", *FRAMES, "--frame", "tip=1"], "--frame defines `tip` twice"),
        (["a.npz", *FRAMES, "--by-number"], "have no numbers"),
        (["a.npz", *FRAMES, "--hold", "middle"], "--hold must be one of root, tip, mean-axis, or three nodes"),
        (["a.npz", *FRAMES, "--hold", "1,2"], ""),
        (["a.npz", *FRAMES, "--modes", "0"], "modes"),
        (["a.npz", *FRAMES, "--modes", "1000"], "1000"),
        (["a.npz", *FRAMES, "--basis", "best"], "best"),
        (["a.npz", *FRAMES, "--damping", "-1"], "damping"),
        (["a.npz", *FRAMES, "--frequency", "-1"], "frequency"),
        (
            ["a.npz", *FRAMES, "--frequency", "9", "--modes", "3"],
            "--modes does not apply: --frequency determines the number of modes",
        ),
        (["a.npz", *FRAMES, "--length", "0"], "--length must be a positive number"),
        (["a.npz", *FRAMES, "--mass", "nan"], "--mass must be a positive number"),
        (["a.npz", *FRAMES, "--material", "1,2,3"], "--material does not apply"),
        (["a.txt", *FRAMES], "a.txt is not a file of matrices. For a mesh, add --material E,NU,RHO"),
        (["a.txt", *FRAMES, "--material", "1,x"], "--material must be E,NU,RHO"),
        (["a.txt", *FRAMES, "--material", "1e9,0.3,1e3", "--mass", "2"], "--mass does not apply to a mesh"),
        (["a.txt", *FRAMES, "--material", "1e9,0.3,1e3"], "not a mesh"),
        (["a.sid", *FRAMES], "--frame does not apply: the SID"),
    ],
)
def test_wrong_words(tmp_path: Path, monkeypatch: pytest.MonkeyPatch, words: list[str], message: str) -> None:
    """One message, status 2, and no file."""
    pytest.importorskip("meshio", reason="meshio, the extra fe, is not installed")
    monkeypatch.chdir(tmp_path)
    npz(tmp_path / "a.npz")
    (tmp_path / "a.txt").write_text("hello\n")
    (tmp_path / "a.sid").write_text("part\n")
    status, text, error = run(*words, "--out", "out.npz")
    assert status == 2
    assert error.startswith("Error: ")
    assert message in error
    assert text == ""
    assert not (tmp_path / "out.npz").exists()


def test_outputs(tmp_path: Path) -> None:
    source = npz(tmp_path / "a.npz")
    for out, message in (
        (tmp_path / "a.npz", "--out would replace"),
        (tmp_path / "lost" / "b.npz", "there is no directory"),
        (tmp_path / "b.txt", "--out must end in .npz"),
        (tmp_path, "it is a directory"),
    ):
        status, _, error = run(source, *FRAMES, "--out", out)
        assert (status, message in error) == (2, True), error
    assert read_npz(source)[2].shape == (24, 3)
    old = tmp_path / "old.npz"
    old.write_bytes(b"before")
    assert run(source, *FRAMES, "--modes", 1000, "--out", old)[0] == 2
    assert old.read_bytes() == b"before"
    assert run(source, *FRAMES, "--out", old, "--quiet") == (0, "", "")
    assert ReducedBody.load(old).n == 10
    assert sorted(path.name for path in tmp_path.iterdir()) == ["a.npz", "old.npz"]


def test_units_that_cannot_be_are_warned_of(tmp_path: Path) -> None:
    source = npz(tmp_path / "a.npz", length=1e-3, mass=1e3)
    status, _, error = run(source, *FRAMES, "--out", tmp_path / "b.npz")
    assert status == 0
    assert error.startswith("Warning: ")
    assert error.count("\n") == 1
    assert run(source, *FRAMES, "--out", tmp_path / "b.npz", "--quiet") == (0, "", "")


def test_as_a_module(tmp_path: Path) -> None:
    source = npz(tmp_path / "a.npz")
    command = [sys.executable, "-m", "components.fe", "reduce", str(source), *FRAMES, "--out", str(tmp_path / "b.npz")]
    done = subprocess.run(command, capture_output=True, text=True, check=True)
    assert "10 modes" in done.stdout
    assert done.stderr == ""
    shutil.copy(source, tmp_path / "half.npz")
    (tmp_path / "half.npz").write_bytes(source.read_bytes()[:999])
    command[4] = str(tmp_path / "half.npz")
    done = subprocess.run(command, capture_output=True, text=True)
    assert (done.returncode, done.stdout) == (2, "")
    assert done.stderr.startswith("Error: ")
    assert "Traceback" not in done.stderr
