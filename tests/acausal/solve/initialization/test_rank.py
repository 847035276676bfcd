"""Ranks, null spaces and pivots of matrices with known singular values."""

from __future__ import annotations

import numpy as np
import pytest

from acausal.policy import POLICY
from acausal.solve.initialization.rank import null_space, pivots, rank, row_space, scaled

RANK = POLICY.ranks.rank


def matrix(seed: int, m: int, n: int, r: int, spread: float = 1.0) -> np.ndarray:
    """Random m x n matrix of rank r, with singular values from 1 down to `spread`."""
    random = np.random.default_rng(seed)
    left, right = (np.linalg.qr(random.standard_normal((k, k)))[0] for k in (m, n))
    return left[:, :r] * np.geomspace(1, spread, r) @ right[:r]


SHAPES = [(1, 1, 1), (1, 6, 1), (4, 4, 4), (4, 4, 3), (6, 9, 4), (9, 6, 4), (5, 5, 1)]


@pytest.mark.parametrize("spread", [1.0, 1e-3])
@pytest.mark.parametrize(("m", "n", "r"), SHAPES)
def test_rank_is_that_of_the_singular_values_whatever_the_sizes_of_rows(m, n, r, spread):
    for seed in range(5):
        A = matrix(seed, m, n, r, spread)
        sizes = 10.0 ** np.random.default_rng(seed).integers(-12, 13, (m, 1))
        assert rank(A) == rank(sizes * A) == r


@pytest.mark.parametrize(("angle", "expected"), [(1e-4, 2), (10 * RANK, 2), (RANK, 1), (1e-12, 1), (0.0, 1)])
def test_two_rows_at_a_small_angle(angle, expected):
    """Singular values of two unit rows at the angle a are sqrt(1 +- cos a): the smaller one is a / sqrt 2."""
    assert rank(np.array([[1, 0], [np.cos(angle), np.sin(angle)]])) == expected


def test_what_is_rounding_grows_with_the_size_of_the_matrix():
    rows = np.zeros((2, 100))
    rows[:, 0], rows[1, 1] = 1.0, 20 * RANK
    assert (rank(rows[:, :3]), rank(rows)) == (2, 1)


def test_a_looser_tolerance_takes_rows_for_dependent():
    rows = np.array([[1, 0], [1, 1e-4]])
    assert (rank(rows), rank(rows, 1e-3)) == (2, 1)


@pytest.mark.parametrize(("m", "n", "r"), SHAPES)
def test_row_space_and_null_space_are_orthogonal_complements(m, n, r):
    A = matrix(1, m, n, r)
    rows, null = row_space(A), null_space(A)
    assert (len(rows), len(null)) == (r, n - r)
    both = np.vstack([rows, null])
    np.testing.assert_allclose(both @ both.T, np.eye(n), atol=1e-13)
    np.testing.assert_allclose(A @ null.T, 0, atol=1e-13)
    np.testing.assert_allclose(A @ rows.T @ rows, A, atol=1e-13)


def test_a_rank_that_is_known_better_counts():
    rows = np.array([[1.0, 0, 0], [1.0, 1e-6, 0]])
    assert len(null_space(rows)) == 1
    np.testing.assert_allclose(np.abs(null_space(rows, independent=1)[:, 0]), 0, atol=1e-6)
    assert len(null_space(rows, independent=1)) == 2


def test_no_rows_leave_everything_free():
    empty = np.zeros((0, 3))
    assert rank(empty) == 0
    np.testing.assert_array_equal(null_space(empty), np.eye(3))
    assert row_space(empty).shape == (0, 3)


def test_rows_become_unit_vectors_and_those_that_vanish_stay():
    np.testing.assert_allclose(scaled(np.array([[3e-9, 4e-9], [0, 0], [0, -2e5]])), [[0.6, 0.8], [0, 0], [0, -1]])


def test_pivots_take_the_largest_column_first_then_what_is_left_of_the_others():
    assert pivots(np.diag([1.0, 4.0, 2.0])).tolist() == [1, 2, 0]
    # Of two nearly parallel columns the second is worth little once the first is taken.
    assert pivots(np.array([[3.0, 2.9, 0.0], [0.0, 0.1, 1.0]])).tolist() == [0, 2, 1]


@pytest.mark.parametrize("seed", range(10))
def test_as_many_pivots_as_the_rank_are_independent_columns(seed):
    A = matrix(seed, 6, 9, 4)
    assert np.linalg.cond(A[:, pivots(A)[:4]]) < 100
