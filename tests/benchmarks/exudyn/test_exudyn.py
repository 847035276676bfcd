"""The comparison with Exudyn in a cheap version: both programs solve the same scenes; no time is tested."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

import acausal as ac
from tests.benchmarks.exudyn import bend
from tests.benchmarks.exudyn.cable import Setting, has_exudyn, simulate
from tests.benchmarks.exudyn.compare import Point, errors_of, front, ours, quickest, theirs
from tests.benchmarks.exudyn.picture import draw
from tests.benchmarks.exudyn.scenes import SCENES, SLIDER_CRANK
from tests.benchmarks.exudyn.tables import Compared, best_rows, equal_rows

# Step of Exudyn, our curve and tolerance, and how far the two may then be apart, as fractions of the ranges.
CHEAP = {
    "spin-up 2 rad/s": (0.0125, 3, 1e-5, (2e-2, 2e-2)),
    "pendulum": (2.5e-3, 0, 1e-5, (2e-3, 0.2)),
    "slider-crank": (2e-3, 0, 1e-4, (2e-3, 0.1)),
    "right-angle frame": (0.025, 3, 1e-3, (5e-2, 5e-2)),
}
with_exudyn = pytest.mark.skipif(not has_exudyn(), reason="Exudyn is not installed")


def point(seconds: float, error: float) -> Point:
    return Point("curve", "1e-3", seconds, seconds / 2, {"x": error}, 10, 5, 20, "idas")


@with_exudyn
@pytest.mark.parametrize("name", CHEAP)
def test_both_programs_agree(name):
    step, number, tolerance, within = CHEAP[name]
    scene = next(s for s in SCENES if s.name == name)
    how = replace(scene.settings[0], step=step, radius=0.8)
    run = simulate(scene.build(how), how, 400)
    assert len(run.times) == 401
    assert run.steps == round(run.times[-1] / step)
    curve = replace(scene.curves[number], tolerances=(tolerance,))
    (found,) = ours(scene, curve, run.outputs, repeats=1)
    for output, most in zip(scene.outputs, within, strict=True):
        assert found.errors[output] < most
    assert found.steps > 0


@with_exudyn
def test_settings_at_which_newton_fails_are_told_and_left_out(capfd):
    scene = next(s for s in SCENES if s.name.startswith("spin-up 4"))
    exact = dict.fromkeys(scene.outputs, np.linspace(0, 1, 401))
    fails, works = Setting(0.1, 0.8), Setting(0.1, 0.6)
    found = theirs(replace(scene, settings=(fails, works)), exact, repeats=1)
    assert [p.setting for p in found] == ["0.1 s, radius 0.6"]
    assert "0.1 s, radius 0.8: no convergence" in capfd.readouterr().out


@with_exudyn
def test_bend_ends_where_the_exact_rod_does():
    coarse, fine = (np.linalg.norm(bend.exudyn_tip(n) - bend.bent_tip()) for n in (4, 8))
    assert fine < 0.2
    assert coarse / fine > 3.5


def test_errors_of_points_are_distances_over_their_largest_range():
    exact = {"x": np.linspace(0, 1, 401)[:, None] * [10.0, 5.0, 0.0]}
    times = np.linspace(0, 10, 161)  # every other one is between two of the reference
    shifted = times[:, None] * [1.0, 0.5, 0.0] + [0.0, 0.3, 0.4]
    assert errors_of({"x": shifted}, times, exact, ["x"]) == {"x": pytest.approx(0.05)}


def test_errors_are_taken_at_the_times_that_both_have():
    exact = {"x": np.arange(401.0) ** 2}
    times = np.linspace(0, 20, 201)
    assert errors_of({"x": exact["x"][::2]}, times, exact, ["x"]) == {"x": 0.0}
    assert errors_of({"x": exact["x"][::2] + 16.0}, times, exact, ["x"]) == {"x": pytest.approx(1e-4)}


def test_front_and_equal_error(tmp_path):
    fast, beaten, exact = point(1e-3, 1e-2), point(2e-3, 2e-2), point(4e-3, 2e-4)
    assert front([exact, beaten, fast], "x") == [fast, exact]
    assert quickest([exact, beaten, fast], "x", 3e-3) == exact
    assert quickest([fast, beaten], "x", 1e-3) is None
    scene = replace(SLIDER_CRANK, outputs=("x",))
    compared = Compared(scene, {"x": 1e-5}, [fast, beaten, exact], [replace(point(8e-3, 2e-4), curve="Exudyn")])
    assert [row[2] for row in best_rows(compared)] == ["1.0", "4.0", "8.0"]
    ratios = {row[1]: row[5:7] for row in equal_rows(compared)}
    assert list(ratios.items())[:2] == [("0.03", ["8.0", "16.0"]), ("0.01", ["8.0", "16.0"])]
    assert list(ratios.items())[2:] == [(error, ["2.0", "4.0"]) for error in ("0.003", "0.001", "0.0003")]
    draw([compared], tmp_path / "picture.png")
    assert (tmp_path / "picture.png").stat().st_size > 1000


@pytest.mark.slow
def test_our_curves_compile():
    for scene in SCENES[-3:]:
        ac.compile(scene.model(**scene.curves[2].options), scene.curves[2].parameters)
