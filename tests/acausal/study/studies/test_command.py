"""The command `acausal study`."""

import json
from pathlib import Path

import pandas as pd
import pytest
from typer.testing import CliRunner

from acausal.cli import app
from tests.acausal.study import decay

FEW = ("--formulation", "fourth", "--tolerances", "1e-4,1e-6", "--repeats", 1, "--intervals", 20, "--workers", 1)


@pytest.fixture
def run(tmp_path, monkeypatch):
    (tmp_path / "mine.py").write_text(Path(decay.__file__).read_text())
    monkeypatch.chdir(tmp_path)
    runner = CliRunner()
    return lambda *arguments: runner.invoke(app, ["study", *(str(a) for a in arguments)])


def test_everything_is_written(run, tmp_path):
    files = ("--csv", "a.csv", "--markdown", "a.md", "--plot", "a.png", "--json", "-")
    done = run("mine.py:Decay", *FEW, "--set", "rate=0.5", "--max-orders", "auto,2", *files)
    assert done.exit_code == 0, done.stderr
    document = json.loads(done.stdout)
    assert document["scene"] == "mine.py:Decay"
    assert len(document["rows"]) == 8
    table = pd.read_csv(tmp_path / "a.csv")
    assert list(table["error"]) == [row["error"] for row in document["rows"]]
    assert set(table["formulation"]) == {"fourth"}
    assert (tmp_path / "a.md").read_text().count("| fourth |") + (tmp_path / "a.md").read_text().count(
        "**fourth**"
    ) == 8
    assert (tmp_path / "a.png").read_bytes().startswith(b"\x89PNG")
    assert sorted(p.name for p in tmp_path.iterdir()) == ["a.csv", "a.md", "a.png", "mine.py"]
    assert "reference: fourth, " in done.stderr


def test_for_people(run):
    done = run("mine.py:Decay", *FEW, "--switch", "rate=1,2")
    assert done.exit_code == 0, done.stderr
    lines = done.stdout.splitlines()
    assert lines[0] == "Decay"
    head = next(line.split() for line in lines if "formulation" in line)
    assert head[:4] == ["formulation", "size", "rate", "tolerance"]
    assert any(line.startswith("an error of 1e-02 costs ") for line in lines)


def test_a_table_as_reference(run, tmp_path):
    CliRunner().invoke(
        app, ["simulate", "mine.py:Decay", "--set", "n=100", "--csv", "r.csv", "--intervals", "20", "--quiet"]
    )
    assert run("mine.py:Decay", *FEW, "--reference", "r.csv", "--quiet").stdout == ""
    done = run("mine.py:Decay", *FEW, "--reference", "r.csv", "--stop-time", 1)
    assert done.exit_code == 2
    assert "the reference r.csv has 21 times up to 2 s, the study 21 up to 1 s" in done.stderr


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (["--tolerances", "1e-3,x"], "--tolerances takes comma-separated values, not `1e-3,x`."),
        (["--max-orders", "high"], "--max-orders takes comma-separated values, not `high`."),
        (
            ["--formulation", "fifth"],
            "there is no formulation `fifth` in the scene; it has: square, fourth, off, unstable.",
        ),
        (["--switch", "rate"], "--switch takes NAME=VALUE,VALUE, such as --switch crank=elastic,rigid, not `rate`."),
        (["--workers", "0"], "workers is 0; it must be a whole number of at least 1."),
        (["--outputs", "z"], "there is no `z` in the model; it has"),
        (["--plot", "a.txt"], "cannot write a.txt: a picture's name ends in .png, .svg or .pdf."),
        (["--csv", "none/a.csv"], "cannot write none/a.csv: there is no directory {dir}/none; create it first."),
        (["--cluster", "nowhere"], "there is no Dask scheduler at nowhere"),
        (["--set", "kind=cube"], "`kind` of Decay is 'cube'; it must be one of 'square', 'fourth', 'off', 'unstable'."),
    ],
)
def test_wrong_input_is_one_message(run, tmp_path, arguments, message):
    done = run("mine.py:Decay", *arguments)
    assert done.stderr.startswith(f"Error: {message.format(dir=tmp_path)}")
    assert len(done.stderr.splitlines()) == 1
    assert (done.exit_code, done.stdout) == (2, "")
