"""Exported models whose content is missing, cut, damaged or of another model: an error that says so."""

from __future__ import annotations

import shutil
from pathlib import Path

import pytest

pytest.importorskip("fmpy")

import fmpy
from fmpy.simulation import instantiate_fmu

import models
from tests.acausal.export.hybrid import Ball, exported
from tests.shared import compiled


@pytest.mark.parametrize("version", [2, 3])
@pytest.mark.parametrize("kind", ["CoSimulation", "ModelExchange"])
@pytest.mark.parametrize(
    ("damage", "why"),
    [
        ("missing", "cannot be read"),
        ("a folder", "cannot be read"),
        ("empty", "it is no model of acausal"),
        ("text", "it is no model of acausal"),
        ("cut", "it is cut off"),
        ("changed", "it is damaged"),
        ("another", "is of model {"),
    ],
)
def test_no_instance_of_a_damaged_model(
    damage: str, why: str, kind: str, version: int, tmp_path: Path, capfd: pytest.CaptureFixture[str]
) -> None:
    folder = Path(fmpy.extract(str(exported(compiled(models.SimplePendulum), tmp_path / "a.fmu", version))))
    other = Path(fmpy.extract(str(exported(Ball(), tmp_path / "b.fmu", version))))
    file = folder / "resources/model.bin"
    content = file.read_bytes()
    file.unlink()
    if damage == "a folder":
        file.mkdir()
    elif damage != "missing":
        changed = content[:100] + b"?" + content[101:]
        foreign = (other / "resources/model.bin").read_bytes()
        file.write_bytes(
            {"empty": b"", "text": b"text", "cut": content[:-8], "changed": changed, "another": foreign}[damage]
        )
    description = fmpy.read_model_description(str(folder))
    with pytest.raises(Exception, match=r"[Ii]nstantiate"):
        instantiate_fmu(str(folder), description, fmi_type=kind)
    assert why in capfd.readouterr().out
    shutil.rmtree(folder)
    shutil.rmtree(other)
