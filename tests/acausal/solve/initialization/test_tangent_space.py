"""Algebraic unknowns that are eliminated from a Jacobian, against dense matrices."""

from __future__ import annotations

import numpy as np
import pytest
import scipy

from acausal.solve.initialization.tangent_space import AT_ONCE, Elimination


@pytest.mark.parametrize("n", [3, AT_ONCE + 2])
def test_schur_complement_and_its_diagonal(n):
    random, m = np.random.default_rng(n), 7
    dense = random.standard_normal((n + m, n + m)) * (random.random((n + m, n + m)) < 0.5) + 3 * np.eye(n + m)
    J = scipy.sparse.csc_matrix(dense)
    rows, columns, z = random.permutation(n), random.permutation(n), np.arange(n, n + m)
    left = Elimination.of(J, rows, columns, z, z)
    through = dense[np.ix_(rows, z)] @ np.linalg.solve(dense[np.ix_(z, z)], dense[np.ix_(z, columns)])
    expected = dense[np.ix_(rows, columns)] - through
    np.testing.assert_allclose(left.matrix(J.data), expected, atol=1e-12)
    np.testing.assert_allclose(left.diagonal(J.data), np.diag(expected), atol=1e-12)


def test_nothing_to_eliminate():
    J = scipy.sparse.csc_matrix(np.arange(4.0).reshape(2, 2))
    left = Elimination.of(J, [0, 1], [1, 0], [], [])
    np.testing.assert_array_equal(left.matrix(J.data), [[1, 0], [3, 2]])
    np.testing.assert_array_equal(left.diagonal(J.data), [1, 2])
