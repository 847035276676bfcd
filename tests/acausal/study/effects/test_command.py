"""`acausal effects`, and `--effects` of the other commands."""

from __future__ import annotations

import json
from pathlib import Path

import pandas as pd
import pytest
from typer.testing import CliRunner

from acausal.cli import app

MODEL = '''"""A model of a user."""
from acausal import Component, Model, Scalar, der, effect, exp, output, part, structural, time, variable


class Leaf(Component):
    bent: bool = effect("a small slope of the leaf", default=True)
    x: Scalar = variable("integral", fixed=True)

    def equations(self):
        yield der(self.x) == 1 + (1e-3 * exp(time) if self.bent else 0)


class Tree(Model):
    """A leaf, and a slope of its own."""

    stop_time = 0.5
    steep: bool = effect("whether the slope is steep", default=False)
    leaf_kind: str = effect("kind of the leaf", default="grown", choices=("grown", "none"))
    x: Scalar = output("position")
    s: Scalar = variable("integral", fixed=True)

    @part
    def leaf(self):
        return Leaf() if self.leaf_kind == "grown" else None

    def equations(self):
        yield der(self.s) == (2 * exp(time) if self.steep else 1)
        yield self.x == self.s + (self.leaf.x if self.leaf_kind == "grown" else 0)
'''


def run(*arguments: object) -> tuple[int, str]:
    done = CliRunner().invoke(app, [str(a) for a in arguments])
    return done.exit_code, done.output


@pytest.fixture
def scene(tmp_path: Path) -> str:
    (tmp_path / "user.py").write_text(MODEL)
    return f"{tmp_path / 'user.py'}:Tree"


def choices(tmp_path: Path, **document: object) -> Path:
    path = tmp_path / "choices.json"
    path.write_text(json.dumps({"scene": "elsewhere/user.py:Tree", "effects": {}, **document}))
    return path


def last(tmp_path: Path, scene: str, *arguments: object) -> float:
    code, text = run("simulate", scene, "--csv", tmp_path / "r.csv", "--intervals", 2, *arguments)
    assert code == 0, text
    return pd.read_csv(tmp_path / "r.csv")["x"].iloc[-1]


def test_round_trip(scene, tmp_path):
    """What the study writes is what a simulation uses; the scene stands without the steep slope."""
    files = {name: tmp_path / f"e.{name}" for name in ("csv", "md", "json")}
    to = ("--csv", files["csv"], "--markdown", files["md"], "--json", files["json"], "--apply", tmp_path / "set.json")
    code, text = run("effects", scene, "--workers", 1, "--pairs", 2, "--accuracy", "1e-9", *to)
    assert code == 0, text
    assert "steep=False" in text
    document = json.loads((tmp_path / "set.json").read_text())
    assert document["scene"] == scene
    assert document["effects"] == {"steep": True, "leaf_kind": "grown", "leaf.bent": True}
    assert json.loads(files["json"].read_text())["reference"]["choices"] == {}
    assert files["csv"].read_text().startswith("kind,choices,x largest,x rms,")
    assert "| steep=False |" in files["md"].read_text()
    full = last(tmp_path, scene, "--set", "steep=true")
    assert last(tmp_path, scene, "--effects", tmp_path / "set.json") == full != last(tmp_path, scene)


def test_effects_of_a_file(scene, tmp_path):
    path = choices(tmp_path, effects={"leaf.bent": False})
    assert last(tmp_path, scene, "--effects", path) == pytest.approx(1.0, abs=1e-9)
    assert last(tmp_path, scene) > 1.0001


def test_set_wins(scene, tmp_path):
    path = choices(tmp_path, effects={"leaf.bent": False, "steep": True})
    assert last(tmp_path, scene, "--effects", path, "--set", "steep=false") == pytest.approx(1.0, abs=1e-9)
    # Without the leaf its effect has no place, which the file could not know.
    without = last(tmp_path, scene, "--effects", path, "--set", "steep=false", "--set", "leaf_kind=none")
    assert without == pytest.approx(0.5, abs=1e-9)


@pytest.mark.parametrize("command", ["check", "linearize"])
def test_other_commands_take_effects_as_well(scene, tmp_path, command):
    path = choices(tmp_path, effects={"leaf_kind": "none"})
    code, text = run(command, scene, "--effects", path, "--json", tmp_path / "c.json")
    assert code == 0, text
    assert json.loads((tmp_path / "c.json").read_text())["states"] == ["s"]


@pytest.mark.parametrize(
    ("document", "message"),
    [
        ({"effects": {"leaf.bend": True}}, "no `leaf.bend` among the effects of the scene; did you mean `leaf.bent`"),
        ({"effects": {"leaf_kind": "none", "leaf.bent": True}}, "no `leaf.bent` among the effects of the scene"),
        ({"effects": {"steep": "very"}}, '`steep` of Tree is "very"; it must be true or false'),
        ({"effects": None}, "contains no choices of effects; `acausal effects"),
        ({"scene": "slider-crank"}, "is for the scene slider-crank, not for"),
    ],
)
def test_wrong_files(scene, tmp_path, document, message):
    code, text = run("simulate", scene, "--effects", choices(tmp_path, **document))
    assert code == 2
    assert message in text


def test_files_that_are_none(scene, tmp_path):
    code, text = run("simulate", scene, "--effects", tmp_path / "missing.json")
    assert code == 2
    assert "cannot read" in text
    (tmp_path / "broken.json").write_text("{")
    code, text = run("simulate", scene, "--effects", tmp_path / "broken.json")
    assert code == 2
    assert "is not a JSON document" in text


def test_what_cannot_be_written_is_refused_before_any_work(scene, tmp_path):
    code, text = run("effects", scene, "--apply", tmp_path / "nowhere" / "set.json")
    assert code == 2
    assert "there is no directory" in text


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (("--accuracy", "2"), "accuracy is 2.0; it must lie between 0 and 1"),
        (("--workers", "0"), "workers is 0; it must be a whole number of at least 1"),
        (("--outputs", "z*"), "no variable of the model matches `z*`"),
        (("--set", "stepe=true"), "there is no `stepe` in the model; did you mean `steep`"),
    ],
)
def test_wrong_arguments(scene, arguments, message):
    code, text = run("effects", scene, *arguments)
    assert code == 2
    assert message in text
