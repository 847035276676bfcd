"""The first change along a motion that is known in closed form."""

from __future__ import annotations

from types import SimpleNamespace

import numpy as np
import pytest

from acausal.compiler.constants import Layout
from acausal.solve.events.locate import Locator, TooCoarse
from acausal.solve.integrate.trace import Leg
from acausal.solve.looks import uneven
from acausal.solve.point import Point, Rows

NOTHING = Layout(0, 0, 0, 0, 0, 0).begin(np.zeros(0), 1.0)
WIDTH = 1e-9


class Motion:
    """An integrator of x = t, so that conditions are functions of x with a given derivative.

    Attributes
    ----------
    trials : int
        How often it was asked to integrate.
    looks : int
        How often conditions were asked for, at one time or at many.
    """

    def __init__(self, *functions, span=10.0) -> None:
        self.functions, self.span, self.trials, self.looks = functions, span, 0, 0
        self.problem, self.compiled = SimpleNamespace(indicators=self.indicators), SimpleNamespace(nx=1)
        self.tolerance = 1e-8
        self.settings = SimpleNamespace(nominal=np.ones(1))
        self.consistent = self

    def __call__(self, rows, wanted=None):
        return rows, []

    def rates(self, rows):
        return np.ones_like(rows.x)

    def trial(self, at, times, steps):
        self.trials += 1
        return leg(times[1:])

    def indicators(self, rows):
        self.looks += 1
        found = [f(rows.x[:, 0]) for f in self.functions]
        return tuple(np.column_stack(column) for column in zip(*found, strict=True))

    def locator(self) -> Locator:
        guards = SimpleNamespace(needs=())
        width = np.full(len(self.functions), WIDTH)
        return Locator(self, SimpleNamespace(guards=guards, span=self.span, width=lambda at: width))  # type: ignore[arg-type]


def leg(times) -> Leg:
    times = np.asarray(times, dtype=float)
    n = len(times)
    return Leg(Rows.within(times, times[:, None], np.zeros((n, 0)), NOTHING.vector), np.zeros((n, 2)), NOTHING, n)


def first(motion: Motion, times, mode=None, **how):
    """Look along rows at some times, the first of which is the start."""
    mode = np.zeros(len(motion.functions), dtype=bool) if mode is None else np.array(mode)
    at = Point(float(times[0]), np.array([times[0]], dtype=float), np.zeros(0), NOTHING, mode)
    return motion.locator().first(at, leg(times[1:]), **how)


def parabola(at, depth, steep=1.0):
    """Negative by `depth` at most, between the roots of it."""
    return lambda x: (steep * (x - at) ** 2 - depth, 2 * steep * (x - at))


def below(at):
    """Positive up to a time, somewhat bent."""
    return lambda x: (np.exp(at) - np.exp(x), -np.exp(x))


GRID = np.linspace(0, 3, 13)


@pytest.mark.parametrize("span", [10.0, 1e9])
@pytest.mark.parametrize("at", [0.1, 1.0 + 1e-12, 1.7, 2.999])
def test_a_change_is_narrowed_down_to_rounding_however_long_the_run_is(at, span):
    found = first(Motion(below(at), span=span), GRID)
    assert found.after.time == pytest.approx(at, abs=1e-14)
    assert -1e-13 < found.after.value[0] < 0


def test_where_a_row_is_on_the_change_it_is_beyond_by_what_counts():
    assert first(Motion(below(0.25)), GRID).after.time == pytest.approx(0.25, abs=WIDTH / 10)


def test_nothing_is_integrated_anew_where_the_cubic_is_the_motion():
    motion = Motion(below(1.7))
    first(motion, GRID)
    assert motion.trials == 0


@pytest.mark.parametrize("functions", [(below(1.7),), (below(1.7), below(1.72)), (below(1.74), below(1.7))])
def test_few_looks_narrow_it_down(functions):
    """Bisection would take 35."""
    motion = Motion(*functions)
    assert first(motion, GRID).after.time == pytest.approx(1.7, abs=1e-11)
    assert motion.looks <= 12


def test_the_side_counts_and_not_the_sign():
    """A condition that holds is left when its excess becomes positive."""
    motion = Motion(lambda x: (x - 1.3, np.ones_like(x)))
    assert first(motion, GRID, mode=[True]).after.time == pytest.approx(1.3, abs=1e-11)


@pytest.mark.parametrize("depth", [0.05, 1e-4, 1e-6])
def test_a_change_and_back_between_two_looks_is_seen(depth):
    found = first(Motion(parabola(1.1, depth)), np.linspace(0, 3, 7))
    assert found.after.time == pytest.approx(1.1 - depth**0.5, abs=1e-10)


@pytest.mark.parametrize("gap", [1e-3, 1e-7])
def test_what_only_comes_near_does_not_change(gap):
    assert first(Motion(parabola(1.1, -gap)), np.linspace(0, 3, 7)) is None


def test_the_earliest_of_several_conditions_is_found():
    motion = Motion(below(2.2), below(2.05), parabola(1.6, 1e-4), below(2.9))
    found = first(motion, GRID)
    assert found.after.time == pytest.approx(1.59, abs=1e-10)
    assert np.flatnonzero(found.after.value < 0).tolist() == [2]


def test_two_changes_in_one_interval_take_the_first():
    found = first(Motion(below(2.2), below(2.05)), GRID)
    assert found.after.time == pytest.approx(2.05, abs=1e-11)
    assert found.after.value[0] > 0 > found.after.value[1]


def test_the_greatest_values_before_are_kept():
    """The height of a throw."""
    found = first(Motion(lambda x: (0.5 + x * (2 - x), 2 - 2 * x)), GRID)
    assert found.after.time == pytest.approx(1 + 1.5**0.5, abs=1e-11)
    assert found.peak[0] == pytest.approx(1.5)


def test_what_starts_at_its_threshold_leaves_it_only_when_it_comes_back():
    found = first(Motion(lambda x: (x * (2 - x), 2 - 2 * x)), GRID)
    assert found.after.time == pytest.approx(2.0, abs=1e-11)


def test_what_rests_at_its_threshold_does_not_change():
    assert first(Motion(lambda x: (np.zeros_like(x), np.zeros_like(x))), GRID) is None


def test_too_few_looks_are_told_or_done_without():
    """Ten turns between two rows: what happens there cannot be told."""
    motion = Motion(lambda x: (1.5 + np.sin(60 * x), 60 * np.cos(60 * x)))
    rows = uneven(np.linspace(0, 3, 5), 1)
    with pytest.raises(TooCoarse):
        first(motion, rows)
    assert first(motion, rows, content=True) is None
    assert first(motion, np.linspace(0, 3, 400)) is None
