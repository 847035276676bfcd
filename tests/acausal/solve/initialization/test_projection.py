"""Loops are closed, and projected coordinates chosen, on a circle, where both are known."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

import acausal as ac
from acausal.solve.initialization import coordinate_partitioning as cp
from acausal.solve.initialization.assembly import close, levels, tighten
from acausal.solve.initialization.newton import algebraic
from acausal.solve.initialization.tangent_space import tangent
from acausal.solve.integrate.order import eigenvalues_of
from acausal.solve.point import Rows
from acausal.solve.sparse_blocks import Block, connected_blocks
from tests.acausal.solve.circle import compiled, plane, point, problem

FREE = np.empty(0, int)


def held(*names: str) -> np.ndarray:
    return np.array([compiled().states.index(name) for name in names])


def whole(m: int, n: int) -> list[Block]:
    """A matrix without zeros."""
    return connected_blocks(*np.indices((m, n)).reshape(2, -1), (m, n))


def directions(constants) -> dict[str, float]:
    places = compiled().constraints.entries[1]
    return {compiled().states[k]: float(d) for k, d in zip(places, constants.D, strict=True)}


def test_levels_go_from_positions_to_rates():
    found = [(rows, {compiled().states[k] for k in columns}) for rows, columns in levels(compiled())]
    assert found == [([0], {"x", "y"}), ([1], {"u", "v"})]


@pytest.mark.parametrize("r", [0.5, 1.0, 1.2])
def test_closing_moves_to_the_nearest_point_and_takes_out_the_velocity_across(r):
    """The velocity (2, 0) at (0.6, 0.8) keeps its part along the tangent (0.8, -0.6)."""
    at, mismatch = close(problem(), point(0.6 * r, 0.8 * r, 2.0, 0.0), FREE)
    np.testing.assert_allclose(plane(at.x), [0.6, 0.8, 1.28, -0.96], atol=1e-12)
    assert mismatch < 1e-15


def test_closing_leaves_what_is_given():
    at, mismatch = close(problem(), point(0.6, 0.1, 1.0, 0.0), held("x", "u"))
    np.testing.assert_allclose(plane(at.x), [0.6, 0.8, 1.0, -0.75], atol=1e-12)
    assert mismatch < 1e-14


def test_positions_alone():
    at, _ = close(problem(), point(0.66, 0.88, 1.0, 7.0), FREE, positions=True)
    np.testing.assert_allclose(plane(at.x), [0.6, 0.8, 1, 7], atol=1e-12)


def test_what_cannot_close_tells_how_far_it_is_off():
    """Over the length of the gradient at the guess."""
    at, mismatch = close(problem(), point(2.0, 0.5), held("x"))
    assert mismatch == pytest.approx(3 / np.hypot(4, 1))
    np.testing.assert_allclose(plane(at.x)[1], 0, atol=1e-4)


@pytest.mark.parametrize("off", [1e-9, 1e-4, 0.3])
def test_tightening_closes_what_is_nearly_closed(off):
    at = tighten(problem(), point(0.6 * (1 + off), 0.8 * (1 + off), 0.8, -0.6 + off))
    assert np.max(np.abs(problem().constraints(at)[0])) < 1e-15


@pytest.mark.parametrize(("angle", "follows"), [(0.1, "x"), (0.7, "x"), (0.9, "y"), (1.5, "y"), (3.0, "x")])
def test_the_coordinate_that_the_constraint_holds_best_follows(angle, follows):
    at = point(np.cos(angle), np.sin(angle))
    constants = cp.choose_projection(problem(), at, spare=False)
    rate = {"x": "u", "y": "v"}[follows]
    assert directions(constants) == {name: float(name in (follows, rate)) for name in "xyuv"}
    moving = cp.choose_projection(problem(), at, spare=False, moves=True)
    assert set(cp.independent_states(problem(), replace(at, constants=moving))) == set("xyuv") - {follows, rate}
    assert constants.moves is False


def test_moving_projections_go_along_the_jacobian():
    """Factors of its entries (2 x, 2 y), so that the direction is a unit vector."""
    constants = cp.choose_projection(problem(), point(0.6, 0.8), spare=False, moves=True)
    assert constants.moves
    assert directions(constants) == pytest.approx(dict.fromkeys("xyuv", 0.5))


@pytest.mark.parametrize("angle", [0.0, 0.3, np.pi / 4, 1.5, np.pi / 2])
def test_transversality_is_the_cosine_of_the_largest_angle(angle):
    """Planes with a common line, at an angle."""
    J = np.array([[5.0, 0, 0], [0, 1e-3, 0]])
    D = np.array([[1.0, 0, 0], [0, np.cos(angle), np.sin(angle)]])
    J, D = J.ravel(), D.ravel()
    assert cp._transversality(whole(2, 3), J[None], D) == pytest.approx(np.cos(angle), abs=1e-15)
    assert cp._transversality(whole(2, 3), np.array([J, J]), D).shape == (2,)
    assert cp._transversality(whole(2, 3), J[None], np.zeros(6)) == 1


def test_stiff_coordinates_are_spared_by_the_lowest_threshold_that_serves():
    J, stiffness = np.array([1.0, 1.0]), np.array([1e8, 0.0])
    np.testing.assert_allclose(cp._weights(whole(1, 2), J, stiffness, 1.0), [1 / (1 + 1e7), 1])
    np.testing.assert_allclose(cp._weights(whole(1, 2), np.array([1.0, 1e-3]), stiffness, 1.0), [1 / (1 + 1e3), 1])
    np.testing.assert_allclose(cp._weights(whole(1, 2), np.array([1.0, 0.0]), stiffness, 1.0), [1 / (1 + 1e7), 1])
    # In a run of 1e200 s: the square of the feedback is too small a number.
    with np.errstate(over="ignore"):  # as in a run
        np.testing.assert_array_equal(cp._weights(whole(1, 2), J, stiffness, 1e-199), [0, 1])


def test_two_constraints_take_a_coordinate_each_that_they_hold_well():
    D = np.array([0.1, 0.9, 0.2, 0.9, 0.1, 0.2])
    np.testing.assert_array_equal(cp._select(whole(2, 3), D, np.array([True, True])), [0, 1, 0, 1, 0, 0])
    np.testing.assert_array_equal(cp._select(whole(2, 3), D, np.array([False, True])), [0, 0, 0, 1, 0, 0])


def test_a_choice_wears_out_as_its_coordinate_loses_its_hold():
    """Where y follows from x, the cosine is |y|."""
    constants = cp.choose_projection(problem(), point(0.0, 1.0), spare=False)
    angle = np.array([np.pi / 2, 1.0, 0.3, 0.05, 0.0, -0.4])
    x = np.array([point(np.cos(a), np.sin(a)).x for a in angle])
    np.testing.assert_allclose(
        cp.projection_cosine(problem(), Rows.within(np.zeros(6), x, np.zeros((6, 0)), constants.vector), constants),
        np.abs(np.sin(angle)),
        atol=1e-15,
    )


@pytest.mark.parametrize("angle", [0.2, 1.0, 2.5])
def test_the_tangent_is_what_the_constraints_leave_free(angle):
    at = point(np.cos(angle), np.sin(angle), -2 * np.sin(angle), 2 * np.cos(angle))
    N, independent = tangent(problem(), at)
    assert N.shape == (4, 2)
    np.testing.assert_allclose(problem().constraints(at)[1] @ N, 0, atol=1e-14)
    np.testing.assert_allclose(N[independent], np.eye(2), atol=1e-14)
    larger = ("x", "u") if abs(np.sin(angle)) > abs(np.cos(angle)) else ("y", "v")
    assert {compiled().states[k] for k in independent} == set(larger)


def test_eigenvalues_are_those_on_the_circle():
    """At rest at (0, 1) with a spring k along x the angle obeys a'' = -k a."""
    p, at = problem(4.0), point(0.0, 1.0)
    at = replace(at, constants=cp.choose_projection(p, at, spare=False))
    at = algebraic(p, p.completed(at))
    found = eigenvalues_of(p, at)
    np.testing.assert_allclose(np.sort_complex(found), [-2j, 2j], atol=1e-9)


def test_a_start_off_the_circle_is_brought_there():
    result = ac.simulate(
        ac.compile(type(compiled().tree)(x=ac.guess(0.3), y=ac.guess(0.4), u=ac.guess(0.8), v=ac.guess(-0.6))),
        stop_time=0.1,
        intervals=1,
        initial="guesses",
    )
    assert result["x"][0] == pytest.approx(0.6, abs=1e-9)
    assert result["y"][0] == pytest.approx(0.8, abs=1e-9)
