"""What is tried next, without an integrator."""

from __future__ import annotations

from dataclasses import replace

import pytest

from acausal.solve.integrate.ladder import Failure, Kind, Refusal, Rescues, Way, next_way, rescue_ways

QUICK = Way("idas", moves=False, tolerance=1e-6, max_steps=None)
AUTO = Rescues(("idas", "rosenbrock"), projects=True, loops=True, damps=True, tolerance=1e-6)
FREE = replace(AUTO, loops=False)
FIRST = replace(QUICK, method="following", moves=True)
THREE = replace(AUTO, methods=("following", "idas", "rosenbrock"))


@pytest.mark.parametrize(
    ("way", "kind", "rescues", "method", "moves"),
    [
        (QUICK, Kind.WORN, AUTO, "idas", True),
        (QUICK, Kind.APART, AUTO, "idas", True),
        (QUICK, Kind.CORRECTOR, AUTO, "idas", True),
        (QUICK, Kind.STEPS, AUTO, "rosenbrock", False),
        (QUICK, Kind.STEPS, FREE, "rosenbrock", False),
        (FIRST, Kind.FLAT, THREE, "idas", False),
        (FIRST, Kind.STEPS, THREE, "rosenbrock", True),
        (FIRST, Kind.STEPS, replace(THREE, damps=False), "idas", False),
        (FIRST, Kind.STEPS, replace(THREE, damps=False, projects=False), "idas", True),
        (FIRST, Kind.CORRECTOR, replace(THREE, loops=False), "idas", True),
        (FIRST, Kind.ERROR_TEST, replace(THREE, loops=False), "idas", True),
    ],
)
def test_what_follows_a_way(way, kind, rescues, method, moves):
    assert next_way(way, Refusal(kind, 0.5), rescues) == replace(way, method=method, moves=moves)


@pytest.mark.parametrize(
    ("way", "kind", "rescues"),
    [
        (QUICK, Kind.ERROR_TEST, FREE),
        (QUICK, Kind.CORRECTOR, FREE),
        (QUICK, Kind.STEPS, replace(AUTO, damps=False)),
        (QUICK, Kind.CORRECTOR, replace(FREE, methods=("idas",))),
        (replace(QUICK, moves=True), Kind.ERROR_TEST, AUTO),
        (replace(QUICK, method="rosenbrock"), Kind.STEPS, AUTO),
        (replace(QUICK, method="rosenbrock"), Kind.CORRECTOR, FREE),
        (QUICK, Kind.WORN, replace(AUTO, projects=False)),
        (replace(FIRST, method="rosenbrock"), Kind.FLAT, replace(THREE, damps=False)),
    ],
)
def test_where_nothing_follows_a_way(way, kind, rescues):
    assert next_way(way, Refusal(kind, 0.5), rescues) is None


@pytest.mark.parametrize("kind", list(Kind))
@pytest.mark.parametrize("rescues", [AUTO, FREE, THREE, replace(THREE, loops=False, damps=False)])
def test_ways_come_to_an_end(kind, rescues):
    way, tries = replace(QUICK, method=rescues.methods[0]), 0
    while following := next_way(way, Refusal(kind, 0.5), rescues):
        way, tries = following, tries + 1
    assert tries <= 3


def test_an_output_interval_is_tried_by_the_other_methods_and_then_with_larger_tolerances():
    found = rescue_ways(replace(QUICK, tolerance=1e-10), replace(AUTO, tolerance=1e-10))
    assert [way.method for way in found] == ["rosenbrock", *["rosenbrock", "idas"] * 2]
    assert [way.tolerance for way in found] == pytest.approx([1e-10, 1e-8, 1e-8, 1e-6, 1e-6])


@pytest.mark.parametrize("tolerance", [1e-3, 1e-4, 1e-10])
def test_no_tolerance_becomes_smaller_or_looser_than_1e_4(tolerance):
    found = rescue_ways(replace(QUICK, tolerance=tolerance), replace(AUTO, methods=("idas",), tolerance=tolerance))
    assert [way.tolerance for way in found] == sorted({way.tolerance for way in found} - {tolerance})
    assert all(tolerance < way.tolerance <= 1e-4 for way in found)


def test_a_refusal_that_nothing_mends_is_a_failure():
    failure = Failure.of(Refusal(Kind.OTHER, 1.5))
    assert (failure.time, str(failure)) == (1.5, "no way to go on was found")
