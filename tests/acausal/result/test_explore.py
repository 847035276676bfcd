"""The explorer: every variable of every scene, within the size; thinning, events, errors, results without a model."""

from __future__ import annotations

import pickle
import warnings
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import acausal as ac
from acausal import (
    Model,
    Scalar,
    der,
    discrete,
    effect,
    observed,
    output,
    parameter,
    reinit,
    structural,
    variable,
    when,
)
from acausal.result import Result, explored
from acausal.result.event_marks import BREAK, event_marks
from models import SCENES
from tests.acausal.animation.explorer import Explored
from tests.shared import CONTRACT, compiled, every_other

# Half a step of the quantisation, of the range of a variable.
HALF = 0.51 / (2**16 - 2)


class Bouncer(Model):
    """A mass that rebounds from a floor."""

    x: Scalar = variable("coordinate", unit="m", start=1.0, fixed=True)
    height: Scalar = output("height", unit="m")
    v: Scalar = variable("velocity", unit="m/s", fixed=True)
    hits: Scalar = discrete("rebounds so far")
    e: Scalar = parameter("restitution", default=0.8)
    label: str = structural("a word", default="ball")
    air: bool = effect("drag of the air", default=False)

    def equations(self):
        yield self.height == self.x
        yield der(self.x) == self.v
        yield der(self.v) == ac.quantity(-9.81, "m/s2")
        yield when(self.x < 0, reinit(self.v, -self.e * self.v), reinit(self.hits, self.hits + 1))


class Unreadable(Bouncer):
    """A quantity of it cannot be formed."""

    @observed
    def lost(self):
        """A quantity."""
        raise ac.DeclarationError("there is no such quantity.")


@pytest.fixture(scope="module")
def bounced() -> Result:
    return ac.simulate(Bouncer(), stop_time=2.0, intervals=200)


@pytest.fixture
def explore(tmp_path: Path) -> Callable[..., Explored]:
    def write(result: Result, **options: Any) -> Explored:
        result.explore(tmp_path / "page.html", **options)
        return Explored(tmp_path / "page.html")

    return write


def compare(page: Explored, result: Result) -> None:
    """Compare all values of a page with the result."""
    places = np.searchsorted(result.time, page.time)
    assert (result.time[places] == page.time).all()
    table = result.to_dataframe(*list(result))
    for path, one in page.variables.items():
        if "columns" not in one:  # a structural parameter
            continue
        shape = tuple(one.get("shape", ()))
        for number, index in zip(one["columns"], np.ndindex(shape), strict=True):
            exact = table[f"{path}[{','.join(map(str, index))}]" if index else path].to_numpy()[places]
            span = np.ptp(exact[np.isfinite(exact)]) if np.isfinite(exact).any() else 0.0
            error = HALF * span + 1e-14 * np.nanmax(np.abs(exact), initial=0)
            np.testing.assert_allclose(page.column(number), exact, rtol=0, atol=error, err_msg=path)


@pytest.mark.parametrize("name", every_other(SCENES))
def test_every_scene_has_all_its_variables_in_a_small_page(explore: Callable[..., Explored], name: str) -> None:
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", ac.AcausalWarning)  # of the physics, which is not what this is about
        result = ac.simulate(compiled(SCENES[name]), stop_time=CONTRACT[name][1] / 8, tolerance=1e-4)
        page = explore(result)
        assert len(page.text) <= 1_500_000
        assert {path for path, one in page.variables.items() if "columns" in one} == set(result)
        assert page.model["plots"] == list(CONTRACT[name][0])
        compare(page, result)


def test_parts_and_variables_are_described(explore: Callable[..., Explored]) -> None:
    root = explore(ac.simulate(compiled(SCENES["four-bar"]), stop_time=0.1)).model["root"]
    assert (root["name"], root["type"]) == ("FourBar", "FourBar")
    joint = next(part for part in root["parts"] if part["name"] == "j1")
    assert joint["type"] == "Revolute"
    assert joint["about"]
    phi = next(one for one in joint["variables"] if one["name"] == "phi")
    assert (phi["unit"], bool(phi["about"])) == ("rad", True)


def test_parameters_and_structural_values(explore: Callable[..., Explored], bounced: Result) -> None:
    page = explore(bounced)
    found = {one["name"]: one for one in page.model["root"]["parameters"]}
    assert page.column(found["e"]["columns"][0])[0] == 0.8
    assert (found["label"]["value"], found["air"]["value"]) == ("ball", "False")


def test_events_tell_what_changed(explore: Callable[..., Explored], bounced: Result) -> None:
    marks = explore(bounced).model["events"]
    assert [mark["t"] for mark in marks] == pytest.approx(bounced.stats.event_times)
    assert [mark["what"] for mark in marks][:2] == ["hits: 0 \u2192 1", "hits: 1 \u2192 2"]


def test_what_changed_is_told_of_single_events_only() -> None:
    time = np.linspace(0, 1, 11)
    steps = np.where(time < 0.35, 0.0, np.where(time < 0.75, 1.0, 2.0))
    variables = [("n", "m", steps), ("x", "m", np.sin(time))]
    marks = event_marks(time, [0.34, 0.72, 0.73, 5.0], [0.5], variables)
    assert marks == [
        {"t": 0.34, "what": "n: 0 \u2192 1 m"},
        {"t": 0.5, "what": BREAK},
        {"t": 0.72, "what": ""},
        {"t": 0.73, "what": ""},
    ]
    assert [mark["what"] for mark in event_marks(time, list(time[1:]), [], variables)] == [""] * 10
    assert event_marks(time[:0], [0.1], [], ()) == []
    assert len(event_marks(time, np.linspace(0, 1, 50_000).tolist(), [], ())) <= 2001


def test_times_around_events_stay(explore: Callable[..., Explored], bounced: Result) -> None:
    page = explore(bounced, frames=20)
    after = np.searchsorted(bounced.time, bounced.stats.event_times)
    assert set(bounced.time[np.concatenate([after - 1, after])]) <= set(page.time)
    assert len(page.time) < 60
    assert page.model["note"] == f"{len(page.time)} of 201 output times are shown."
    compare(page, bounced)


def test_chosen_variables(explore: Callable[..., Explored], bounced: Result) -> None:
    columns = {path for path, one in explore(bounced, variables=["hi*", "v"]).variables.items() if "columns" in one}
    assert columns == {"hits", "v"}


def test_what_cannot_be_read_says_why(explore: Callable[..., Explored]) -> None:
    page = explore(ac.simulate(Unreadable(), stop_time=2.0, intervals=20))
    assert {"x", "v", "lost"} <= set(page.variables)
    assert page.variables["lost"] == {"name": "lost", "about": "there is no such quantity.", "value": "no value"}


def test_of_constants_alone(explore: Callable[..., Explored], bounced: Result) -> None:
    page = explore(bounced, variables=["e"])
    assert len(page.columns) == 0
    compare(page, bounced)


def test_thinned_to_the_budget(
    explore: Callable[..., Explored], bounced: Result, monkeypatch: pytest.MonkeyPatch
) -> None:
    whole = explore(bounced)
    assert (len(whole.time), whole.model["note"]) == (201, "")
    numbers = explored._packed(whole.document)
    monkeypatch.setattr(explored, "ROOM", 0)
    monkeypatch.setattr(explored, "BUDGET", len(whole.text) - numbers // 4)
    page = explore(bounced)
    assert len(page.text) <= explored.BUDGET
    assert 100 <= len(page.time) < 201
    after = np.searchsorted(bounced.time, bounced.stats.event_times)
    assert set(bounced.time[np.concatenate([after - 1, after])]) <= set(page.time)
    assert set(page.variables) == set(whole.variables)
    compare(page, bounced)


def test_too_many_variables_are_refused(tmp_path: Path, bounced: Result, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(explored, "ROOM", 0)
    monkeypatch.setattr(explored, "BUDGET", 1000)
    with pytest.raises(ac.DeclarationError, match=r"even at 100 times; .* variables=\[") as refused:
        bounced.explore(tmp_path / "page.html")
    assert "--variables PATTERN" in str(refused.value)
    assert not list(tmp_path.iterdir())


def test_a_loaded_result_has_the_same_values(explore: Callable[..., Explored], bounced: Result) -> None:
    loaded = pickle.loads(pickle.dumps(bounced))
    page, whole = explore(loaded), explore(bounced)
    assert {path for path, one in whole.variables.items() if "columns" in one} == set(page.variables)
    compare(page, loaded)


def test_a_result_of_arrays(explore: Callable[..., Explored]) -> None:
    time = np.linspace(0, 1, 30)
    result = ac.result_of(time, {"a.b[0].x": (np.sin(time), "m"), "r": (np.outer(time, [1, 2, 3]), "m")})
    compare(explore(result), result)


@pytest.mark.parametrize(
    ("options", "said"),
    [
        ({"frames": 1}, "frames is a whole number, 2 or more, not 1"),
        ({"variables": "x"}, r"variables is a list, such as \[\"crank\.\*\"\], not 'x'"),
        ({"variables": ["y*"]}, r"no variable of the model matches `y\*`"),
        ({"wrong": 1}, "wrong"),
    ],
)
def test_wrong_options_are_refused(tmp_path: Path, bounced: Result, options: dict[str, Any], said: str) -> None:
    with pytest.raises(ac.DeclarationError, match=said):
        bounced.explore(tmp_path / "page.html", **options)


@pytest.mark.parametrize(("name", "said"), [("page.txt", "ends in .html"), ("no/page.html", "no directory")])
def test_wrong_files_are_refused(tmp_path: Path, bounced: Result, name: str, said: str) -> None:
    with pytest.raises(ac.ExportError, match=said):
        bounced.explore(tmp_path / name)
