"""`--input NAME=FILE.csv:COLUMN` of the commands that run a scene."""

from __future__ import annotations

import json

import numpy as np
import pytest
from typer.testing import CliRunner

import acausal as ac
from acausal.cli import app
from acausal.language.table import Table

SCENE = '''
from acausal import Model, Scalar, der, effect, input, output, variable


class Wheel(Model):
    """A wheel on a spring over a road."""

    stop_time = 2.0
    road: Scalar = input("height", unit="m")
    x: Scalar = output("place", unit="m")
    v: Scalar = variable("speed", unit="m/s", start=0, fixed=True)
    s: Scalar = variable("place", unit="m", start=0, fixed=True)
    damped: bool = effect("damping", default=True)

    def equations(self):
        yield self.x == self.s
        yield der(self.s) == self.v
        yield der(self.v) == -50 * (self.s - self.road) - (2 * self.v if self.damped else 0)
'''
T = np.linspace(0, 3, 40)


@pytest.fixture(autouse=True)
def files(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "wheel.py").write_text(SCENE)
    for name, n in (("road", len(T)), ("short", 20)):
        rows = np.column_stack([np.cos(T), T, np.sin(T)])[:n]
        np.savetxt(f"{name}.csv", rows, delimiter=",", header="other,time,height", comments="")


def ran(*arguments):
    """Run a command."""
    return CliRunner().invoke(app, [arguments[0], "wheel.py:Wheel", *arguments[1:]])


def test_simulate_takes_the_column():
    done = ran("simulate", "--input", "road=road.csv:height", "--csv", "out.csv", "--tolerance", "1e-8")
    assert done.exit_code == 0, done.stderr
    found = np.genfromtxt("out.csv", delimiter=",", names=True)
    namespace: dict = {"__name__": __name__}
    exec(SCENE, namespace)
    exact = ac.simulate(namespace["Wheel"](), inputs={"road": Table(T, np.sin(T))}, tolerance=1e-8)
    np.testing.assert_allclose(found["x"], exact["x"], rtol=1e-6, atol=1e-9)


def test_data_that_end_early():
    refused = ran("simulate", "--input", "road=short.csv:height")
    assert refused.exit_code == 2
    assert "its data cover 0 s to 1.46154 s, the run 0 s to 2 s" in refused.stderr
    assert ran("simulate", "--input", "road=short.csv:height", "--extrapolation", "hold").exit_code == 0
    wrong = ran("simulate", "--input", "road=short.csv:height", "--extrapolation", "linear")
    assert wrong.exit_code == 2
    assert "it must be refuse or hold" in wrong.stderr


@pytest.mark.parametrize("command", ["simulate", "linearize", "study", "effects"])
def test_wrong_data_are_refused(command):
    for given, text in (
        ("roat=road.csv:height", "did you mean `road`?"),
        ("road=road.csv:heigt", "height"),
        ("road=none.csv:height", "none.csv"),
        ("road", "--input takes NAME=FILE.csv:COLUMN"),
    ):
        done = ran(command, "--input", given)
        assert done.exit_code == 2, (given, done.stderr)
        assert text in done.stderr


@pytest.mark.parametrize("command", ["study", "effects"])
def test_studies_run_with_data(command):
    extra = ["--tolerances", "1e-3,1e-5", "--repeats", "1", "--intervals", "50"] if command == "study" else []
    done = ran(command, "--input", "road=road.csv:height", "--workers", "1", "--json", "out.json", *extra)
    assert done.exit_code == 0, done.stderr
    with open("out.json") as file:
        assert json.load(file)["scene"].endswith("Wheel")
