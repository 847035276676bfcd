"""Plots: curves of one or several results over time or another quantity."""

from pathlib import Path

import numpy as np
import pytest

import acausal as ac
import models
from acausal.cli.scenes import scenes
from acausal.errors import DeclarationError
from acausal.result.plots import Curve, Series, draw
from tests.acausal.result.demo import demo

T = np.linspace(0, 1, 3)


def result(**arrays: tuple[object, object]) -> ac.Result:
    return ac.result_of(T, arrays)


def legends(figure) -> list[list[str]]:
    found = [axes.get_legend() for axes in figure.axes]
    return [[text.get_text() for text in legend.get_texts()] if legend else [] for legend in found]


def test_several_results_share_the_axes_of_a_unit(tmp_path: Path) -> None:
    a, b = result(x=(T, "m"), y=(2 * T, "m"), w=(T, "rad/s")), result(x=(3 * T, "m"), y=(T, "m"), w=(T, "rad/s"))
    figure = ac.plot({"rigid": a, "elastic": b}, "x", "y", "w", title="T", path=tmp_path / "a.png")
    assert legends(figure) == [["rigid: x", "rigid: y", "elastic: x", "elastic: y"], ["rigid", "elastic"]]
    assert [axes.get_ylabel() for axes in figure.axes] == ["x, y [m]", "w [rad/s]"]
    first = figure.axes[0].lines
    assert [line.get_linestyle() for line in first] == ["-", "-", "--", "--"]
    assert len({line.get_color() for line in first}) == 4
    np.testing.assert_array_equal(first[2].get_ydata(), 3 * T)
    assert (tmp_path / "a.png").stat().st_size > 0


def test_outputs_that_all_have_are_compared() -> None:
    own = demo()
    figure = ac.plot({"a": own, "b": demo()})
    assert [axes.get_ylabel() for axes in figure.axes] == [axes.get_ylabel() for axes in own.plot().axes]
    with pytest.raises(DeclarationError, match="nothing to plot"):
        ac.plot({"a": own, "b": result(other=(T, "m"))})


def test_phase_plot() -> None:
    own = result(phi=(T, "rad"), w=(np.cos(T), "rad/s"))
    for figure in (own.plot("w", x="phi"), ac.plot({"a": own}, "w", x="phi")):
        (axes,) = figure.axes
        assert (axes.get_xlabel(), axes.get_ylabel()) == ("phi [rad]", "w [rad/s]")
        np.testing.assert_array_equal(axes.lines[0].get_xdata(), own["phi"])


@pytest.mark.parametrize(
    ("entries", "labels"),
    [
        ([("r[0]", "m"), ("r[1]", "m"), ("r[2]", "m")], ["r x", "r y", "r z"]),
        ([("r[2]", "m"), ("r[0]", "m"), ("r[1]", "m")], ["r z", "r x", "r y"]),
        ([("q[0]", "m"), ("q[1]", "m"), ("q[2]", "rad")], ["q[0]", "q[1]"]),
        ([(f"q[{k}]", "m") for k in range(4)], ["q[0]", "q[1]", "q[2]", "q[3]"]),
        ([("r[0]", "m"), ("r[1]", "m")], ["r[0]", "r[1]"]),
        ([("a", "1"), ("b", "1")], ["a", "b"]),
    ],
)
def test_vectors_have_components_x_y_z(entries: list[tuple[str, str]], labels: list[str]) -> None:
    figure = draw([Curve(Series("time", "s", T), Series(name, unit, T)) for name, unit in entries])
    assert legends(figure)[0] == labels


def test_one_curve_needs_no_legend() -> None:
    assert legends(demo().plot("x")) == [[]]
    assert legends(ac.plot({"one": demo()}, "x")) == [[]]


def test_wrong_arguments() -> None:
    a = result(x=(T, "m"), r=(np.ones((3, 3)), "m"))
    for call, message in (
        (lambda: ac.plot(a, "x"), r"result\.plot"),  # type: ignore[arg-type]
        (lambda: ac.plot({}), "dictionary"),
        (lambda: ac.plot({"a": a, "b": result(y=(T, "m"))}, "x"), "b: there is no `x`"),
        (lambda: a.plot("x", x="r"), r'x="r\[0\]"'),
    ):
        with pytest.raises(DeclarationError, match=message):
            call()


def test_a_notebook_shows_a_figure() -> None:
    assert demo().plot()._repr_png_().startswith(b"\x89PNG")


@pytest.mark.parametrize("name", ["simple-pendulum", "car-axis", "n-four-bar"])
def test_scenes_are_compared_with_themselves(name: str) -> None:
    cls = scenes()[name]
    runs = {text: ac.simulate(cls(), stop_time=0.01, intervals=n) for text, n in (("coarse", 4), ("fine", 8))}
    figure = ac.plot(runs)
    assert sum(len(axes.lines) for axes in figure.axes) == 2 * len(runs["fine"].series())
    assert all("[" in axes.get_ylabel() for axes in figure.axes)


def test_a_loaded_result_is_plotted_beside_a_live_one() -> None:
    import pickle

    live = ac.simulate(models.SimplePendulum(), stop_time=0.01, intervals=4)
    figure = ac.plot({"live": live, "loaded": pickle.loads(pickle.dumps(live))}, "x")
    one, other = figure.axes[0].lines
    np.testing.assert_array_equal(one.get_ydata(), other.get_ydata())
