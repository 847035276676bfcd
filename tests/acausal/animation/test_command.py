"""acausal simulate --animate and --explore."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest
from PIL import Image
from typer.testing import CliRunner

from acausal.cli import app
from tests.acausal.animation.explorer import Explored

MODELS = '''
import acausal as ac
from acausal import Model, Scalar, geometry, output, variable


class Falls(Model):
    """It ends at the time 1."""

    stop_time = 0.5
    x: Scalar = variable("coordinate", unit="m", start=1.0)
    height: Scalar = output("height", unit="m")

    def equations(self):
        yield ac.der(self.x) == ac.quantity(-0.5, "m2/s") / self.x
        yield self.height == self.x

    def initial_equations(self):
        yield self.x == 1

    def shapes(self):
        yield geometry.Span((0, 0, 0), (0.2, self.x, 0))


class Nothing(Falls):
    def shapes(self):
        yield geometry.Ground()


class Wrong(Falls):
    def shapes(self):
        yield 1 / 0
'''


@pytest.fixture
def run(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Callable[..., Any]:
    (tmp_path / "mine.py").write_text(MODELS)
    monkeypatch.chdir(tmp_path)
    return lambda *arguments: CliRunner().invoke(app, ["simulate", *map(str, arguments)])


@pytest.mark.parametrize("name", ["run.html", "run.HTM", "run.gif", "run.png"])
def test_one_file_is_written(run: Callable[..., Any], tmp_path: Path, name: str) -> None:
    done = run("mine.py:Falls", "--animate", name, "--intervals", 20, "--quiet")
    assert (done.exit_code, done.output) == (0, "")
    assert {p.name for p in tmp_path.iterdir() if p.is_file()} == {"mine.py", name}
    if name.lower().endswith("m") or name.endswith("html"):
        assert '"name":"height","unit":"m"' in (tmp_path / name).read_text()
    else:
        assert Image.open(tmp_path / name).width == 640


def test_chosen_variables_are_plotted(run: Callable[..., Any], tmp_path: Path) -> None:
    assert run("mine.py:Falls", "--animate", "a.html", "--variables", "x", "--quiet").exit_code == 0
    assert '"plots":[{"name":"x","unit":"m"' in (tmp_path / "a.html").read_text()


@pytest.mark.parametrize(
    ("arguments", "said"),
    [
        (("mine.py:Falls", "--animate", "run.avi"), "ends in .html"),
        (("mine.py:Falls", "--animate", "no/run.html"), "there is no directory"),
        (("mine.py:Falls", "--animate", "mine.py"), "ends in .html"),
        (("mine.py:Falls", "--animate", "a.png", "--plot", "a.png"), "--plot and --animate both write a.png"),
        (("mine.py:Nothing", "--animate", "a.html"), "Nothing cannot be animated"),
        (("mine.py:Falls", "--explore", "run.gif"), "ends in .html"),
        (("mine.py:Falls", "--explore", "no/run.html"), "there is no directory"),
        (("mine.py:Falls", "--explore", "a.html", "--animate", "a.html"), "--animate and --explore both write a.html"),
        (("mine.py:Wrong", "--explore", "a.html"), "shapes() fails"),
        (("mine.py:Falls", "--animate", "a.html", "--deformation", "0"), "deformation is a number from 1 to 1000"),
        (("mine.py:Falls", "--animate", "a.html", "--view", "left"), "view is front, top, right or iso, not 'left'"),
        (("mine.py:Falls", "--animate", "a.html", "--size", "800x600"), "a page is as large as its window"),
        (("mine.py:Falls", "--animate", "a.gif", "--size", "80"), "--size 800x600"),
        (("mine.py:Falls", "--animate", "a.gif", "--size", "8x60"), "each 64 to 4096, not (8, 60)"),
        (("mine.py:Falls", "--animate", "a.png", "--fps", "20"), "fps is for .gif and .mp4"),
        (("mine.py:Falls", "--animate", "a.gif", "--fps", "100"), "from 1 to 50, not 100"),
        (("mine.py:Falls", "--animate", "a.gif", "--trails", "y"), "there is no `y`"),
        (("mine.py:Falls", "--animate", "a.gif", "--trails", "x"), "trails: x is not a point"),
        (
            ("mine.py:Falls", "--animate", "a.html", "--values", "stress"),
            'no curve of the animation has values "stress"',
        ),
    ],
)
def test_refused_before_any_work(
    run: Callable[..., Any], tmp_path: Path, monkeypatch: pytest.MonkeyPatch, arguments: tuple[str, ...], said: str
) -> None:
    monkeypatch.setattr("shutil.which", lambda _: None)
    monkeypatch.setattr("acausal.simulate", lambda *_, **__: pytest.fail("it was simulated"))
    done = run(*arguments)
    assert done.exit_code == 2
    assert said in done.stderr
    assert {p.name for p in tmp_path.iterdir() if p.is_file()} == {"mine.py"}


@pytest.mark.parametrize(
    ("more", "found"),
    [((), {"x", "height"}), (("--variables", "h*"), {"height"}), (("--variables", "x"), {"x", "height"})],
)
def test_the_explorer_has_the_chosen_variables(
    run: Callable[..., Any], tmp_path: Path, more: tuple[str, ...], found: set[str]
) -> None:
    for model in ("Falls", "Nothing"):
        done = run(f"mine.py:{model}", "--explore", "e.html", *more, "--quiet")
        assert (done.exit_code, done.output) == (0, "")
        assert {"x", "height"} & set(Explored(tmp_path / "e.html").variables) == found


def test_a_failed_run_is_explored_up_to_its_failure(run: Callable[..., Any], tmp_path: Path) -> None:
    assert run("mine.py:Nothing", "--stop-time", 2, "--explore", "e.html", "--quiet").exit_code == 1
    page = Explored(tmp_path / "e.html")
    assert page.time[-1] < 2
    assert page.model["note"].startswith("The run stopped at ")


def test_a_failed_run_shows_what_was_computed(run: Callable[..., Any], tmp_path: Path) -> None:
    done = run("mine.py:Falls", "--stop-time", 2, "--animate", "a.html", "--quiet")
    assert done.exit_code == 1
    page = (tmp_path / "a.html").read_text()
    assert '"stopped":"' in page
    assert '"stopped":null' not in page
