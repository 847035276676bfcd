"""Matrices of Ansys: a beam of SOLID186, clamped at one end, that the package ships which reads such files."""

from __future__ import annotations

import shutil
from pathlib import Path

import numpy as np
import pytest

from acausal import DeclarationError
from components.fe import assemble, read_ansys, reduce_body
from tests.components.fe.samples import frequencies

examples = pytest.importorskip(
    "ansys.mapdl.reader.examples",
    reason="ansys-mapdl-reader, the extra ansys, is not installed: it brings vtk, 140 MB",
    exc_type=ImportError,
)
LENGTH, MASS = 0.0254, 0.45359237 * 9.80665 / 0.0254  # inch and pound-force s2/inch
E, NU, RHO = 16.9e6, 0.31, 4.1408e-4


@pytest.fixture(params=["cdb", "rst"])
def path(tmp_path: Path, request: pytest.FixtureRequest) -> Path:
    shutil.copy(examples.fullfile, tmp_path / "job.full")
    source = examples.hexarchivefile if request.param == "cdb" else examples.rstfile
    shutil.copy(source, tmp_path / f"job.{request.param}")
    return tmp_path / "job.full"


def test_sample(path: Path) -> None:
    M, K, nodes = read_ansys(path)
    assert len(nodes) == 321
    assert nodes.numbers.tolist() == list(range(1, 322))
    assert np.asarray(nodes).max(axis=0) == pytest.approx([1, 1, 5])
    assert nodes.cells["hexahedron20"].shape == (40, 20)
    # A slender beam bends a little slower than Euler's: shear and rotary inertia.
    euler = 1.8751040687**2 / (2 * np.pi * 25) * np.sqrt(E / RHO / 12)
    found = frequencies(M, K)
    assert found[0] == pytest.approx(found[1], rel=1e-6)
    assert 0.95 < found[0] / euler < 1
    held = np.flatnonzero(K.diagonal().reshape(-1, 3).sum(axis=1) == 0)
    assert np.asarray(nodes)[held][:, 2] == pytest.approx(np.full(21, held.size and nodes[held[0], 2]))
    with pytest.raises(DeclarationError, match="as if these were fixed"):
        reduce_body(M, K, nodes, frames={"end": [0, 1, 2]})
    # The same elements by another program: reduced integration is softer, and has the same mass.
    mesh = assemble(np.asarray(nodes), nodes.cells, E=E, nu=NU, rho=RHO)
    free = np.repeat(K.diagonal().reshape(-1, 3).sum(axis=1) > 0, 3)
    ours = frequencies(mesh[0][free][:, free], mesh[1][free][:, free])
    assert found[:6] == pytest.approx(ours[:6], rel=0.01)


def test_units_and_names(path: Path) -> None:
    M, K, nodes = read_ansys(path)
    for name in ("job.full", *(f"job{end}" for end in (".cdb", ".rst") if (path.parent / f"job{end}").exists())):
        found = read_ansys(path.parent / name, length=LENGTH, mass=MASS)
        assert abs(found[0] - MASS * M).max() == abs(found[1] - MASS * K).max() == 0
        assert np.abs(found[2] - LENGTH * nodes).max() == 0
        assert found[2].numbers is not None


def test_files_that_end_the_process_that_reads_them(path: Path) -> None:
    content = path.read_bytes()
    for part in (b"", b"hello\n" * 100, content[:100], content[: len(content) // 3]):
        path.write_bytes(part)
        with pytest.raises(DeclarationError, match=r"job\.full: this is not an Ansys file, or is damaged"):
            read_ansys(path)
    path.write_bytes(content)
    other = next(file for file in path.parent.iterdir() if file != path)
    other.write_bytes(other.read_bytes()[:5000])
    with pytest.raises(DeclarationError, match=other.name):
        read_ansys(path)
    other.unlink()
    with pytest.raises(DeclarationError, match=r"neither job\.rst nor job\.cdb"):
        read_ansys(path)
