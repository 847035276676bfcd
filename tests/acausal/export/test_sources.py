"""Exported models whose library an importer compiles from their sources."""

from __future__ import annotations

import shutil
import zipfile
from pathlib import Path
from typing import Any

import numpy as np
import pytest

pytest.importorskip("fmpy")

from fmpy import extract
from fmpy.build import build_platform_binary

import models
from acausal.core.build.compiling import own_compiler
from tests.acausal.export.hybrid import Hybrid, exported, simulated

RUNS: dict[str, tuple[Any, float]] = {
    "four-bar": (models.FourBar(), 2.0),
    "hybrid": (Hybrid(wanted=0.4), 2.0),
}


def from_sources(path: Path, folder: Path) -> Path:
    """The same model with a library that fmpy made from its sources in place of ours."""
    inside = Path(extract(str(path), str(folder)))
    shutil.rmtree(inside / "binaries")
    build_platform_binary(inside)
    made = path.with_name(f"own-{path.name}")
    with zipfile.ZipFile(made, "w") as archive:
        for file in inside.rglob("*"):
            archive.write(file, file.relative_to(inside))
    return made


@pytest.mark.slow
@pytest.mark.parametrize("version", [2, 3])
@pytest.mark.parametrize("scene", RUNS)
def test_the_library_that_others_compile_gives_the_same_bit_by_bit(scene: str, version: int, tmp_path: Path) -> None:
    if not shutil.which("cmake") or not own_compiler():
        pytest.skip("there is no cmake or no C compiler")
    model, stop = RUNS[scene]
    path = exported(model, tmp_path / "a.fmu", version)
    other = from_sources(path, tmp_path / "sources")
    for kind in ("CoSimulation", "ModelExchange"):
        own, found = (simulated(p, kind, stop) for p in (path, other))
        assert np.array_equal(own, found)
        assert len(own) > 40
