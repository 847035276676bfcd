"""What is tried next, without an integrator."""

from __future__ import annotations

from dataclasses import replace

import pytest

from acausal.solve.integrate.ladder import Failure, Kind, Refusal, Rescues, Way, accepted, next_ways

QUICK = Way("idas", moves=False, tolerance=1e-6, max_steps=100)
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
        (QUICK, Kind.CORRECTOR, FREE, "rosenbrock", False),
        (replace(QUICK, moves=True), Kind.CORRECTOR, AUTO, "rosenbrock", True),
        (QUICK, Kind.STEPS, AUTO, "rosenbrock", False),
        (QUICK, Kind.STEPS, FREE, "rosenbrock", False),
        (QUICK, Kind.CORRECTOR, replace(AUTO, projects=False), "rosenbrock", False),
        (FIRST, Kind.FLAT, THREE, "idas", False),
        (FIRST, Kind.STEPS, THREE, "rosenbrock", True),
        (FIRST, Kind.STEPS, replace(THREE, damps=False), "idas", False),
        (FIRST, Kind.STEPS, replace(THREE, damps=False, projects=False), "idas", True),
    ],
)
def test_what_follows_a_quick_way(way, kind, rescues, method, moves):
    assert next_ways(way, Refusal(kind, 0.5), rescues) == (replace(way, method=method, moves=moves),)


@pytest.mark.parametrize(
    ("way", "kind", "rescues"),
    [
        (QUICK, Kind.ERROR_TEST, FREE),
        (QUICK, Kind.STEPS, replace(AUTO, damps=False)),
        (QUICK, Kind.CORRECTOR, replace(FREE, methods=("idas",))),
        (replace(QUICK, moves=True), Kind.ERROR_TEST, AUTO),
        (replace(QUICK, method="rosenbrock"), Kind.STEPS, AUTO),
        (replace(QUICK, method="rosenbrock"), Kind.CORRECTOR, FREE),
        (QUICK, Kind.WORN, replace(AUTO, projects=False)),
        (FIRST, Kind.STEPS, replace(THREE, damps=False, loops=False)),
    ],
)
def test_where_nothing_follows_a_quick_way(way, kind, rescues):
    assert next_ways(way, Refusal(kind, 0.5), rescues) == ()


def test_any_number_of_methods_follow_each_other():
    three, way, taken = replace(FREE, methods=("a", "b", "c")), replace(QUICK, method="a"), []
    while following := next_ways(way, Refusal(Kind.CORRECTOR, 0.5), three):
        (way,) = following
        taken.append(way.method)
    assert taken == ["b", "c"]
    found = next_ways(replace(way, careful=True), Refusal(Kind.OTHER, 0.5), three)
    assert [way.method for way in found] == ["b", "a", "c", "b", "a"]


@pytest.mark.parametrize("kind", list(Kind))
def test_quick_ways_come_to_an_end(kind):
    way, tries = QUICK, 0
    while following := next_ways(way, Refusal(kind, 0.5), AUTO):
        (way,), tries = following, tries + 1
    assert tries <= 2


def test_careful_ways_take_the_other_method_and_then_longer_steps():
    way = replace(QUICK, careful=True, tolerance=1e-10)
    found = next_ways(way, Refusal(Kind.ERROR_TEST, 0.5), replace(AUTO, tolerance=1e-10))
    assert [way.method for way in found] == ["rosenbrock", *["rosenbrock", "idas"] * 2]
    assert [way.tolerance for way in found] == pytest.approx([1e-10, 1e-8, 1e-8, 1e-6, 1e-6])
    assert all(way.careful for way in found)


@pytest.mark.parametrize("tolerance", [1e-3, 1e-4, 1e-10])
def test_no_tolerance_becomes_smaller_or_looser_than_1e_4(tolerance):
    rescues = replace(AUTO, methods=("idas",), tolerance=tolerance)
    found = next_ways(replace(QUICK, careful=True, tolerance=tolerance), Refusal(Kind.OTHER, 0.5), rescues)
    assert [way.tolerance for way in found] == sorted({way.tolerance for way in found} - {tolerance})
    assert all(tolerance < way.tolerance <= 1e-4 for way in found)


def test_a_refusal_that_nothing_mends_is_a_failure():
    with pytest.raises(Failure, match="no way to go on") as raised:
        accepted(Refusal(Kind.OTHER, 1.5))
    assert raised.value.time == 1.5
    assert accepted("a leg") == "a leg"


def test_flat_positions_are_left_to_the_next_method_with_chosen_states():
    three, way = (
        replace(AUTO, methods=("following", "idas", "rosenbrock")),
        replace(QUICK, method="following", moves=True),
    )
    assert next_ways(way, Refusal(Kind.FLAT, 0.5), three) == (replace(way, method="idas", moves=False),)
    projects = replace(three, projects=False)
    assert next_ways(way, Refusal(Kind.FLAT, 0.5), projects) == (replace(way, method="idas"),)


def test_too_many_steps_lead_to_the_method_that_damps():
    three, way = replace(AUTO, methods=("following", "idas", "rosenbrock")), replace(QUICK, method="following")
    assert next_ways(way, Refusal(Kind.STEPS, 0.5), three) == (replace(way, method="rosenbrock"),)
