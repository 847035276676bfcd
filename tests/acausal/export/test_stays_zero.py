"""Exports of models with unknowns that stay 0: constants, or states of the full model."""

from __future__ import annotations

import zipfile
from pathlib import Path
from xml.etree.ElementTree import fromstring

import numpy as np
import pytest
from typer.testing import CliRunner

import acausal as ac
from acausal.cli import app
from tests.acausal.flatten.test_stays_zero import ACROSS, Arm

NAMES = ("hinge.phi", "hinge.w")


def exported(path: Path, **options) -> dict[str, dict[str, str]]:
    """Export the arm; return the attributes of its variables by name."""
    ac.export_fmu(Arm(), path, **options)
    with zipfile.ZipFile(path) as archive:
        root = fromstring(archive.read("modelDescription.xml"))
    variables = root.find("ModelVariables")
    assert variables is not None
    return {v.attrib["name"]: v.attrib | (v[0].attrib if len(v) else {}) for v in variables}


@pytest.mark.parametrize("version", [2, 3])
def test_an_fmu_has_them_as_constants(version: int, tmp_path: Path):
    found = exported(tmp_path / "arm.fmu", fmi_version=version)
    for name in ACROSS:
        assert (found[name]["variability"], float(found[name]["start"])) == ("constant", 0.0)
    assert {f"der({name})" for name in NAMES} <= set(found)
    assert "der(across.phi)" not in found


@pytest.mark.parametrize("version", [2, 3])
def test_an_fmu_of_the_full_model_has_them_as_states(version: int, tmp_path: Path):
    found = exported(tmp_path / "arm.fmu", fmi_version=version, full=True)
    assert {f"der({name})" for name in (*NAMES, *ACROSS)} <= set(found)
    assert {found[name].get("variability", "continuous") for name in ACROSS} == {"continuous"}


def test_an_fmu_runs_and_cannot_be_moved_across(tmp_path: Path):
    fmpy = pytest.importorskip("fmpy")
    exported(path := tmp_path / "arm.fmu", fmi_version=2)
    run = fmpy.simulate_fmu(str(path), stop_time=0.5, output_interval=0.1, output=["x", "across.phi"])
    expected = ac.simulate(Arm(), stop_time=0.5, intervals=5, tolerance=1e-8)
    np.testing.assert_allclose(run["x"], expected["x"], atol=1e-4)
    np.testing.assert_array_equal(run["across.phi"], 0)
    with pytest.raises(Exception, match=r"across\.phi|variability|fmi2SetReal"):
        fmpy.simulate_fmu(str(path), stop_time=0.5, start_values={"across.phi": 0.1})


def test_free_parameters_and_the_full_model(tmp_path: Path):
    ac.export_fmu(Arm(), path := tmp_path / "arm.fmu", free=("hinge.d",), full=True)
    assert path.exists()
    ac.export_fmu(ac.compile(Arm(), full=True), tmp_path / "again.fmu", free=("hinge.d",))
    with zipfile.ZipFile(tmp_path / "again.fmu") as archive:
        assert "der(across.phi)" in archive.read("modelDescription.xml").decode()


@pytest.mark.parametrize("full", [False, True])
def test_open_dae(full: bool, tmp_path: Path):
    ac.export_dae(ac.compile(Arm()), path := tmp_path / "arm.dae", full=full)
    loaded = ac.load_dae(path)
    assert loaded.states == ((*NAMES, *ACROSS) if full else NAMES)
    result = ac.simulate(loaded, stop_time=0.2, intervals=4)
    np.testing.assert_array_equal(result["across.phi"], 0)
    assert loaded.report["stays_zero"] == ([] if full else list(ACROSS))


def test_what_a_file_omits_cannot_be_restored(tmp_path: Path):
    ac.export_dae(Arm(), path := tmp_path / "arm.dae")
    with pytest.raises(ac.ExportError, match="full=True compiles the model again"):
        ac.export_fmu(ac.load_dae(path), tmp_path / "arm.fmu", full=True)


def test_on_the_command_line(tmp_path: Path):
    scene, path = f"{Path(__file__).parents[1] / 'flatten' / 'test_stays_zero.py'}:Arm", tmp_path / "arm.fmu"
    done = CliRunner().invoke(app, ["export", scene, "--fmu", str(path), "--full"])
    assert done.exit_code == 0, done.output
    with zipfile.ZipFile(path) as archive:
        assert "der(across.phi)" in archive.read("modelDescription.xml").decode()
