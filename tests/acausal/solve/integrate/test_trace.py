"""Rows of a run in pieces."""

from __future__ import annotations

import numpy as np
import pytest

from acausal.compiler.constants import Constants, Layout
from acausal.solve.integrate.trace import Leg, Trace
from acausal.solve.point import Point, Rows


def constants(*switches: float) -> Constants:
    return Layout(len(switches), 0, 0, 0, 0, 0).begin(np.array(switches, dtype=float), 1.0)


def leg(*times: float, switch: float = 0.0) -> Leg:
    """At each time t: x = (t, 10 t), z = (100 t), energy supplied t - 1 and dissipated 0."""
    t = np.array(times)
    energy = np.column_stack([t - 1, 0 * t])
    rows = Rows.within(t, np.column_stack([t, 10 * t]), 100 * t[:, None], constants(switch).vector)
    return Leg(rows, energy, constants(switch))


def first() -> Point:
    return Point(1.0, np.array([1.0, 10.0]), np.array([100.0]), constants(0.0))


def traced(*legs: Leg) -> Trace:
    trace = Trace()
    for one in legs:
        trace.add(one)
    return trace


def test_rows_are_those_of_all_stretches_after_the_start():
    rows = traced(leg(2.0, 3.0), leg(3.0, 4.0, switch=1.0)).rows(first())
    assert rows.times.tolist() == [1, 2, 3, 3, 4]
    np.testing.assert_array_equal(rows.x, np.outer(rows.times, [1, 10]))
    np.testing.assert_array_equal(rows.z[:, 0], 100 * rows.times)
    assert rows.constants[:, 0].tolist() == [0, 0, 0, 1, 1]


def test_integrals_go_on_from_the_last_row():
    trace = traced(leg(2.0, 3.0), leg(4.0))
    assert [piece.energy[:, 0].tolist() for piece in trace.pieces] == [[1, 2], [2 + 3]]
    assert trace.energy.tolist() == [5, 0]


def test_energy_spent_at_an_instant_counts_from_there_on():
    trace = Trace()
    trace.spend(np.array([5.0, 1.0]))
    trace.add(leg(2.0, 3.0))
    trace.spend(np.array([0.0, 10.0]))
    trace.add(leg(4.0))
    np.testing.assert_array_equal(np.vstack([piece.energy for piece in trace.pieces]), [[6, 1], [7, 11], [10, 11]])


def test_the_last_row_of_a_piece_is_put_right():
    trace = traced(leg(2.0, 3.0), leg(4.0, 5.0))
    before = trace.pieces[0].rows
    trace.put(-2, Point(9.0, np.array([-1.0, -2.0]), np.array([-3.0]), constants(1.0)))
    rows = trace.rows(first())
    assert rows.times.tolist() == [1, 2, 3, 4, 5]
    np.testing.assert_array_equal(rows.x[1:4], [[2, 20], [-1, -2], [4, 40]])
    assert rows.z[1:4, 0].tolist() == [200, -3, 400]
    assert rows.constants[1:4, 0].tolist() == [0, 1, 0]
    assert before.x[-1].tolist() == [3, 30]  # exchanged, not changed: an interrupt finds the one or the other
    trace.put(-3, first())
    assert [len(p.rows) for p in trace.pieces] == [2, 2]


def test_the_last_row_is_delayed():
    trace = traced(leg(2.0, 3.0))
    trace.delay(3.5)
    assert trace.rows(first()).times.tolist() == [1, 2, 3.5]
    assert trace.pieces[-1].rows.x[-1].tolist() == [3, 30]


@pytest.mark.parametrize(("time", "left"), [(1.5, []), (2.0, []), (2.5, [2]), (4.0, [2, 3]), (9.0, [2, 3, 4, 5])])
def test_rows_before_a_time(time, left):
    trace = traced(leg(2.0, 3.0), leg(4.0, 5.0))
    trace.steps = 12
    trace.cut(time)
    assert trace.rows(first()).times.tolist() == [1, *left]
    assert trace.steps == 12
    assert all(len(rows) == len(energy) > 0 for rows, energy in trace.pieces)


def test_counts_of_calls_add_up_and_outlive_the_rows():
    trace = traced(leg(2.0))
    trace.count("idas", 5, 2, 11)
    trace.count("rosenbrock", 3, 3, 0)
    trace.count("idas", 1, 0, 0)
    empty = trace.emptied()
    for one in (trace, empty):
        assert (one.calls, one.steps, one.factorisations, one.residual_evaluations) == (3, 9, 5, 11)
        assert one.methods == {"idas": 6, "rosenbrock": 3}
    assert empty.pieces == []
    empty.count("idas", 1, 0, 0)
    assert trace.methods["idas"] == 6


def test_parts_of_a_stretch():
    whole = leg(2.0, 3.0, 4.0, 5.0, 6.0, 7.0)
    assert whole.part(1, 3).times.tolist() == [3, 4]
    assert whole.part(1, 3).energy[:, 0].tolist() == [2, 3]
    truth = np.array([True])
    end = whole.end(Point(0.0, np.zeros(2), np.zeros(1), constants(0.0), truth))
    assert (end.time, end.x.tolist(), end.z.tolist(), end.mode) == (7.0, [7, 70], [700], truth)
