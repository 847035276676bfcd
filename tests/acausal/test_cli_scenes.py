"""The command line on the scenes of models/."""

import json

import pandas as pd
import pytest
from typer.testing import CliRunner

from acausal.cli import app
from acausal.compiler import report
from tests.shared import CONTRACT


def run(*arguments):
    return CliRunner().invoke(app, [str(a) for a in arguments])


def test_list_has_a_line_for_each_scene():
    done = run("list")
    assert done.exit_code == 0
    named = {line.split()[0]: line.split(maxsplit=1)[1] for line in done.stdout.splitlines()}
    assert set(CONTRACT) <= set(named)
    assert all(named.values())


LONG = ("slider-crank", "squeezer", "bricard", "four-bar-spatial", "car-axis")


@pytest.mark.parametrize("scene", [pytest.param(s, marks=pytest.mark.slow if s in LONG else ()) for s in CONTRACT])
def test_columns_and_rows(scene, tmp_path):
    path = tmp_path / "a.csv"
    short = ("--stop-time", 0.02) if scene in ("pendulum", "free-vibration") else ()
    done = run("simulate", scene, "--csv", path, "--intervals", 20, "--tolerance", 1e-4, "--quiet", *short)
    assert (done.exit_code, done.output) == (0, "")
    table = pd.read_csv(path)
    assert list(table) == ["time", *CONTRACT[scene][0]]
    assert len(table) == 21
    assert table["time"].iloc[-1] == (0.02 if short else CONTRACT[scene][1])
    assert not table.isna().any(axis=None)


def test_spin_up_reaches_its_angle(tmp_path):
    path = tmp_path / "a.csv"
    assert run("simulate", "spin-up", "--set", "omega=3", "--csv", path, "--quiet").exit_code == 0
    assert pd.read_csv(path)["angle"].iloc[-1] == pytest.approx(3 * (20 - 7.5))


def test_spin_up_inside_variables(tmp_path):
    path = tmp_path / "a.csv"
    assert run("simulate", "spin-up", "--csv", path, "--quiet", "--variables", "beam.frame_b.r_0").exit_code == 0
    table = pd.read_csv(path)
    assert list(table)[4:] == [f"beam.frame_b.r_0[{k}]" for k in range(3)]
    assert table["beam.frame_b.r_0[0]"].iloc[0] == pytest.approx(8)


@pytest.mark.parametrize("scene", ["spin-up", "simple-pendulum", "free-vibration"])
def test_check_and_linearize(scene):
    checked = run("check", scene, "--json", "-")
    states = json.loads(checked.stdout)["states"]
    linear = json.loads(run("linearize", scene, "--json", "-").stdout)
    assert set(linear["states"]) >= set(states)  # and those that stay zero in a run
    assert len(linear["eigenvalues"]) == len(linear["states"])
    assert all(len(pair) == 2 for pair in linear["eigenvalues"])
    assert linear["frequencies_hz"] == sorted(linear["frequencies_hz"])


def test_check_tells_what_became_of_a_planar_loop():
    done = run("check", "four-bar", "--json", "-")
    text, document = " ".join(done.stderr.split()), json.loads(done.stdout)
    (loop,) = document["loops"]
    assert (loop["kind"], loop["constraints"], loop["redundant"], loop["redundant_by_rank"]) == ("planar loop", 6, 3, 0)
    joints = ["j1", "j2", "j3", "j4"]
    assert sorted(loop["parts"]) == joints
    assert sorted(name.rpartition(".")[2] for name in loop["undetermined"]) == ["f[2]", "t[0]", "t[1]"]
    assert len(document["independent_states"]) == 2
    assert "planar loop" in text
    assert "3 of its 6 constraints redundant and dropped, 3 kept" in text
    assert "chosen by pivoting" in text
    assert all(name in text for name in (*joints, *loop["undetermined"], *document["independent_states"]))


def test_check_finds_what_only_ranks_tell():
    (loop,) = json.loads(run("check", "bricard", "--json", "-").stdout)["loops"]
    assert (loop["kind"], loop["redundant"], loop["redundant_by_rank"]) == ("loop", 1, 1)
    assert sorted(loop["parts"]) == [f"joint[{k}]" for k in range(6)]


@pytest.mark.parametrize(
    ("why", "line"),
    [("", "the core"), ("it was not built", "CasADi, which takes longer than the core: it was not built")],
)
def test_check_tells_what_integrates(monkeypatch, why, line):
    monkeypatch.setattr(report, "why_not", lambda: why)
    done = run("check", "simple-pendulum", "--json", "-")
    assert f"  integrator    {line}\n" in done.stderr
    assert json.loads(done.stdout)["core_missing"] == why


def test_linearize_has_a_state_for_each_freedom():
    linear = json.loads(run("linearize", "four-bar", "--json", "-").stdout)
    assert len(linear["states"]) == len(linear["eigenvalues"]) == 2


def test_json_of_spin_up_holds_the_energies():
    done = run("simulate", "spin-up", "--json", "-", "--quiet")
    assert done.stderr == ""
    document = json.loads(done.stdout)
    assert document["scene"] == "spin-up"
    assert document["steps"] > 0
    assert document["energy_supplied"] > 0


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (["spinup"], "there is no scene `spinup`; did you mean `spin-up`? Scenes: free-vibration, "),
        (["spin-up", "--set", "omgea=4"], "there is no `omgea` in the model; did you mean `omega`"),
        (["spin-up", "--set", "formulation=fme"], "`formulation` of SpinUp is 'fme'; it must be one of "),
        (["spin-up", "--set", "volumes=0"], "`volumes` of SpinUp is 0; it must be a number of at least 1."),
        (["spin-up", "--set", "volumes=2.5"], "`volumes` of SpinUp is 2.5; it must be a whole number."),
        (["spin-up", "--set", "omega=fast"], "`omega` of SpinUp is 'fast'; it must be a number."),
        (
            ["spin-up", "--variables", "beam.frame_b.r0"],
            "there is no `beam.frame_b.r0` in the model; did you mean `beam.frame_b.r_0`",
        ),
    ],
)
def test_wrong_input(arguments, message):
    done = run("simulate", *arguments)
    assert done.exit_code == 2
    assert done.stderr.startswith(f"Error: {message}")
    assert done.stderr.count("\n") == 1
