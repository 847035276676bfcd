"""The first words of the command line, and the commands show and new."""

from __future__ import annotations

import runpy
from typing import Any

import pytest
from typer.testing import CliRunner

import components
from acausal.cli import app


def run(*words: str) -> Any:
    return CliRunner().invoke(app, list(words))


def test_without_words_the_command_tells_what_to_do_first():
    done = run()
    assert done.exit_code == 0
    for line in done.stdout.splitlines()[2:]:
        assert line.split()[0] == "acausal"
    known = {command.name or getattr(command.callback, "__name__", "") for command in app.registered_commands}
    assert {line.split()[1] for line in done.stdout.splitlines()[2:-1]} <= known


def test_show_prints_the_table_of_a_component():
    for name in ("rotational.Damper", "Revolute", "revolute"):
        done = run("show", name)
        assert done.exit_code == 0
        assert "Parameters\n----------\n" in done.stdout
        assert "flange_a : Flange" in done.stdout or "axis : Flange, optional" in done.stdout


@pytest.mark.parametrize("entry", components.table(), ids=lambda entry: entry.name)
def test_show_knows_every_component(entry):
    done = run("show", entry.name)
    assert done.exit_code == 0
    assert entry.line in done.stdout


def test_a_name_in_several_domains_or_a_part_of_one_lists_all_matches():
    assert run("show", "Damper").stdout.count("Damper: Linear") == 3
    springs = run("show", "pring").stdout
    assert "rotational.Spring: " in springs
    assert "translational.SpringDamper: " in springs
    assert "Parameters" not in springs
    assert run("show").stdout.count("\n") > 400


def test_unknown_components_are_refused_with_the_nearest():
    done = run("show", "rotational.Dampr")
    assert done.exit_code == 2
    assert "did you mean `Damper` or `rotational.Damper`" in done.stderr


def test_new_writes_a_model_that_runs(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    done = run("new", "tower_crane.py")
    assert done.exit_code == 0
    words = done.stdout.splitlines()[1].split()
    assert words[:2] == ["acausal", "simulate"]
    assert run(*words[1:]).exit_code == 0
    assert (tmp_path / "tower_crane.html").stat().st_size > 1e5
    (tmp_path / "tower_crane.html").unlink()
    runpy.run_path("tower_crane.py", run_name="__main__")
    assert {path.name for path in tmp_path.iterdir()} >= {"tower_crane.png", "tower_crane.html"}


@pytest.mark.parametrize(
    ("name", "text"),
    [
        ("crane.txt", "does not end in .py"),
        ("3d.py", "begin it with a letter"),
        ("there.py", "exists"),
        ("no/x.py", "no"),
    ],
)
def test_new_refuses_files_that_cannot_be(tmp_path, monkeypatch, name, text):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "there.py").write_text("x = 1\n")
    done = run("new", name)
    assert done.exit_code == 2
    assert text in done.stderr
    assert (tmp_path / "there.py").read_text() == "x = 1\n"
    assert [path.name for path in tmp_path.iterdir()] == ["there.py"]
