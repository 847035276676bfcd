"""`--max-steps` and `--max-seconds`: what was computed until then is written, as after other failures."""

from __future__ import annotations

import json
from pathlib import Path

import pandas as pd
import pytest
from typer.testing import CliRunner

from acausal.cli import app

FILES = ("--csv", "a.csv", "--json", "a.json")


@pytest.mark.parametrize(
    ("scene", "name", "value", "stop"),
    [
        ("simple-pendulum", "steps", 100, 50),
        ("four-bar", "steps", 50, 50),
        ("simple-pendulum", "seconds", 0.3, 1e7),
    ],
)
def test_what_was_computed_is_written(
    scene: str, name: str, value: float, stop: float, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    arguments = [
        "simulate",
        scene,
        f"--max-{name}",
        f"{value}",
        "--stop-time",
        f"{stop}",
        "--intervals",
        "10000",
        *FILES,
    ]
    done = CliRunner().invoke(app, arguments)
    assert done.exit_code == 1, done.stderr
    assert done.stderr.startswith("Error: the simulation failed: ")
    assert f"max_{name}" in done.stderr
    times = pd.read_csv("a.csv")["time"]
    assert 1 < len(times) < 10_000
    written = json.loads(Path("a.json").read_text())
    assert written["error"]
    assert f"max_{name}" in written["stopped"]


def test_a_limit_that_is_not_reached_changes_nothing() -> None:
    done = CliRunner().invoke(app, ["simulate", "simple-pendulum", "--max-steps", "100000", "--max-seconds", "600"])
    assert done.exit_code == 0, done.stderr


@pytest.mark.parametrize("value", ["0", "-1", "many"])
@pytest.mark.parametrize("name", ["steps", "seconds"])
def test_a_wrong_limit_is_refused(name: str, value: str) -> None:
    done = CliRunner().invoke(app, ["simulate", "simple-pendulum", f"--max-{name}", value])
    assert done.exit_code == 2
    assert "No such option" not in done.stderr
