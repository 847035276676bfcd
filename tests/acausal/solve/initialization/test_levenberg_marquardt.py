"""Levenberg's and Marquardt's iteration, with known answers."""

from __future__ import annotations

import numpy as np
import pytest
import scipy

from acausal.solve.initialization.levenberg_marquardt import levenberg_marquardt

RADIUS = 2.0


def circle(u: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    return np.array([u @ u - RADIUS**2]), 2 * u[None]


@pytest.mark.parametrize("sizes", [(1.0, 1.0), (1e-3, 1e3)])
@pytest.mark.parametrize("angle", [0.0, 1.0, 2.5, -2.0])
@pytest.mark.parametrize("far", [0.1, 1.01, 30.0])
def test_a_circle_is_met_where_it_is_nearest(far, angle, sizes):
    """In units of the sizes, in which it is a circle."""
    sizes = np.array(sizes)
    direction = np.array([np.cos(angle), np.sin(angle)])

    def evaluate(u):
        value, J = circle(u / sizes)
        return value, J / sizes

    found = levenberg_marquardt(evaluate, far * RADIUS * direction * sizes, sizes)
    np.testing.assert_allclose(found / sizes, RADIUS * direction, atol=1e-14 * RADIUS * far)


def test_what_cannot_vanish_is_least():
    """A point on a line that is nearest to a circle which the line misses, 1 beside it."""

    def evaluate(u):
        value, J = circle(np.array([u[0], 3.0]))
        return np.append(value, 0.0), np.vstack([J[:, :1], [[0.0]]])

    assert levenberg_marquardt(evaluate, np.array([0.7]), np.ones(1))[0] == pytest.approx(0.0, abs=1e-6)


def test_equal_rows_do_no_harm():
    def evaluate(u):
        value, J = circle(u)
        return np.repeat(value, 3), np.repeat(J, 3, axis=0)

    np.testing.assert_allclose(levenberg_marquardt(evaluate, np.array([3.0, 4.0]), np.ones(2)), [1.2, 1.6], atol=1e-14)


def test_sparse_and_dense_lead_to_the_same():
    """Links of a chain, each 1 long, from a line of links of 1.4."""
    n = 150

    def dense(u):
        d = np.diff(np.append(0.0, u).reshape(-1, 1), axis=0).ravel()
        J = np.zeros((n, n))
        J[np.arange(n), np.arange(n)] = 2 * d
        J[np.arange(1, n), np.arange(n - 1)] = -2 * d[1:]
        return d**2 - 1, J

    def sparse(u):
        value, J = dense(u)
        return value, scipy.sparse.csc_matrix(J)

    start = 1.4 * np.arange(1, n + 1)
    found = levenberg_marquardt(sparse, start, np.ones(n))
    np.testing.assert_allclose(found, np.arange(1, n + 1), atol=1e-12)
    np.testing.assert_allclose(levenberg_marquardt(dense, start, np.ones(n)), found, atol=1e-12)


@pytest.mark.parametrize("nothing", [np.zeros((1, 2)), np.full((1, 2), np.nan)])
def test_where_nothing_helps_the_guess_stays(nothing):
    found = levenberg_marquardt(lambda u: (np.ones(1), nothing), np.array([1.0, 2.0]), np.ones(2))
    np.testing.assert_array_equal(found, [1.0, 2.0])


def test_values_that_do_not_exist_are_kept_clear_of():
    """The logarithm vanishes at 1; full steps from 20 lead below 0."""
    with np.errstate(invalid="ignore"):
        found = levenberg_marquardt(lambda u: (np.log(u), 1 / u[None]), np.array([20.0]), np.ones(1))
    np.testing.assert_allclose(found, 1.0, rtol=1e-14)
