"""Formats whose packages are not installed say what installs them."""

from __future__ import annotations

import importlib.util
import sys
from pathlib import Path

import numpy as np
import pytest

from acausal import DeclarationError
from components.fe import Interface, NodalField, NodalResult, ReducedBody, read_ansys, read_mesh, read_nastran


@pytest.fixture(autouse=True)
def _nothing_installed(monkeypatch: pytest.MonkeyPatch) -> None:
    find = importlib.util.find_spec

    def missing(name: str, *rest):
        return None if name.partition(".")[0] in ("meshio", "pyyeti", "ansys") else find(name, *rest)

    monkeypatch.setattr("components.fe.formats.third_party.find_spec", missing)
    monkeypatch.setitem(sys.modules, "meshio", None)


@pytest.mark.parametrize(
    ("read", "names", "extra"),
    [
        (lambda path: read_mesh(path, E=1e9, nu=0.3, rho=1e3), ("a.vtu",), "fe"),
        (read_nastran, ("a.op4", "a.bdf"), "nastran"),
        (read_ansys, ("a.full", "a.rst"), "ansys"),
    ],
)
def test_readers(tmp_path: Path, read, names: tuple[str, ...], extra: str) -> None:
    for name in names:
        (tmp_path / name).write_text("something")
    with pytest.raises(DeclarationError, match=rf"not installed: python -m pip install 'acausal\[{extra}\]'"):
        read(tmp_path / names[0])


def test_files_for_paraview(tmp_path: Path) -> None:
    zero, none = np.zeros((3, 1)), np.zeros((1, 3, 3))
    ref = Interface("ref", np.zeros(3), zero, zero)
    moments = np.zeros(3), np.eye(3), zero, none, none[None], np.eye(1), np.eye(1), np.eye(1)
    body = ReducedBody(1.0, *moments, interfaces=(ref,), nodal=NodalField(np.zeros((1, 3)), np.zeros((1, 3, 1))))

    class Result(dict):
        time = np.array([0.0])
        tree = None

    frame = {name: np.zeros((1, 3)) for name in ("r_0", "v", "a", "z", "R.w")} | {"R.T": np.eye(3)[None]}
    result = Result({f"body.{name}": np.zeros((1, 1)) for name in ("q", "qd", "qdd")})
    result |= {f"body.ref.{name}": value for name, value in frame.items()}
    with pytest.raises(DeclarationError, match=r"needs meshio\. Do this: python -m pip install 'acausal\[fe\]'"):
        NodalResult(result, "body", body).write_vtu(tmp_path / "a.vtu")  # pyright: ignore
