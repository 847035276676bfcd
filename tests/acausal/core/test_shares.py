"""Forces within limits that hold speeds at rest: complementarity, least norm, and joints that reached their limits."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.optimize import lsq_linear

from tests.acausal.core.shares import shares


def problem(seed: int, n: int, rank: int):
    random = np.random.default_rng(seed)
    J = random.standard_normal((n, rank)) * 10.0 ** random.uniform(-2, 2, (n, 1))
    return J, random.standard_normal(rank) * 10.0 ** random.uniform(-1, 1.5)


@pytest.mark.parametrize("rank", [1, 2, 5])
@pytest.mark.parametrize("n", [1, 3, 8])
def test_complementarity(n, rank):
    for seed in range(20):
        J, y = problem(seed, n, rank)
        A, b = J @ J.T, J @ y
        found = shares(A, b, np.zeros(n))
        a, size = b - A @ found.share, np.abs(b) + np.abs(A) @ np.abs(found.share)
        assert np.all(np.abs(found.share) <= 1 + 1e-12)
        exact = lsq_linear(J.T, y, (-1, 1), method="bvls", tol=1e-15).x
        np.testing.assert_array_less(np.abs(A @ (found.share - exact)), 1e-7 * size)
        inside = np.abs(found.share) < 1 - 1e-9
        assert np.all(np.abs(a[inside]) <= 1e-6 * size[inside])
        assert np.all(a * found.share >= -1e-6 * size)
        assert np.all(found.sense[found.sense != 0] == np.sign(found.share[found.sense != 0]))
        assert not np.any(found.sticks & (found.sense != 0))
        assert np.linalg.matrix_rank(A[np.ix_(found.sticks, found.sticks)]) == found.sticks.sum() <= rank


def test_redundant_forces_are_those_of_least_norm():
    J = np.array([1.0, 1.0, -1.0, 1.0])
    found = shares(np.outer(J, J), 2 * J, np.zeros(4))
    np.testing.assert_allclose(found.share, J / 2)
    assert found.sticks.sum() == 1
    assert not found.sense.any()


def test_forces_at_their_limits_stay_there_while_others_hold():
    J = np.ones(4)
    found = shares(np.outer(J, J), 2 * J, np.array([1.0, 0, 0, 0]))
    np.testing.assert_allclose(found.share, [1, 1 / 3, 1 / 3, 1 / 3])
    assert not found.sticks[0]
    assert not found.sense.any()
    relieved = shares(np.outer(J, J), -3.5 * J, np.array([1.0, 0, 0, 0]))
    np.testing.assert_allclose(relieved.share, -3.5 / 4)


def test_all_slide_where_the_load_is_more_than_all_limits():
    J = np.array([1.0, -2.0, 0.1])
    found = shares(np.outer(J, J), 4 * J, np.zeros(3))
    np.testing.assert_allclose(found.sense, [1, -1, 1])
    assert not found.sticks.any()


@pytest.mark.parametrize("short", [0.0, 5e-9])
def test_an_independent_force_at_its_limit_leaves_rest(short):
    A = np.array([[11.0, -6.0], [-6.0, 4.0]])
    found = shares(A, A @ (0.35, 1 - short), np.array([0.0, 1.0]))
    np.testing.assert_allclose(found.share, [0.35, 1], rtol=1e-7)
    np.testing.assert_array_equal(found.sense, [0, 1])
    np.testing.assert_array_equal(found.sticks, [True, False])
