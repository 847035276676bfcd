"""Sparse LU against scipy, on random matrices and on those of all scenes."""

from __future__ import annotations

import numpy as np
import pytest
import scipy.sparse
from scipy.sparse.linalg import splu

from acausal.core import LU, make_tape
from models import SCENES
from tests.acausal.core.models import jacobian, points
from tests.shared import compiled


def backward_error(A: scipy.sparse.csc_matrix, x: np.ndarray, b: np.ndarray) -> float:
    """Residual over the size of its terms, of rows whose largest entries are 1."""
    size = np.max(np.abs(A.toarray()), axis=1)
    return float(np.max(np.abs(A @ x - b) / size) / np.max((abs(A) @ np.abs(x) + np.abs(b)) / size))


def matrix(values: np.ndarray, row: np.ndarray, start: np.ndarray) -> scipy.sparse.csc_matrix:
    return scipy.sparse.csc_matrix((values, row, start), shape=(len(start) - 1,) * 2)


@pytest.mark.parametrize("n", [1, 2, 5, 30, pytest.param(200, marks=pytest.mark.slow)])
def test_random_matrices_are_solved_or_refused_as_singular(n):
    random = np.random.default_rng(n)
    regular = 0
    for k in range(60):
        A = scipy.sparse.random(n, n, min(1, 3 / n), "csc", random_state=random)
        A = scipy.sparse.csc_matrix(A + (k % 2) * scipy.sparse.identity(n))
        lu, b = LU(A.indptr, A.indices), random.standard_normal(n)
        for values in (A.data, random.standard_normal(A.nnz), 10.0 ** random.uniform(-9, 9, A.nnz)):
            A.data = values
            full = A.toarray() / np.maximum(np.max(np.abs(A.toarray()), axis=1, keepdims=True), 1e-300)
            assert lu.factor(values) or np.linalg.cond(full) > 1e13
            if np.linalg.cond(full) < 1e10:
                regular += 1
                # What kept pivots may lose, and what rounding does with new ones.
                assert backward_error(A, lu.solve(b), b) < 1e-9
                fresh = LU(A.indptr, A.indices)
                assert fresh.factor(values)
                assert backward_error(A, fresh.solve(b), b) < 1e-13
    assert regular > 20


@pytest.mark.parametrize("name", SCENES)
def test_pivots_are_kept_along_a_scene(name):
    model = compiled(SCENES[name])
    function, given = jacobian(model), points(model, 40)
    pattern = function.sparsity_out(1)
    start, row = np.array(pattern.colind()), np.array(pattern.row())
    values = make_tape(function).rows(*given)[:, model.nx + model.nz :]
    # The iteration matrix of an implicit method: random constants make it regular in loops as well.
    diagonal = np.array([k for j in range(model.nx) for k in range(start[j], start[j + 1]) if row[k] == j], dtype=int)
    values[:, diagonal] -= 1e3
    lu, b = LU(start, row), np.random.default_rng(0).standard_normal(len(start) - 1)
    solved = 0
    for entries in values:
        try:
            expected = splu(matrix(entries, row, start)).solve(b)
        except RuntimeError:
            assert not lu.factor(entries)
            continue
        assert lu.factor(entries)
        solved += 1
        x = lu.solve(b)
        assert backward_error(matrix(entries, row, start), x, b) < 1e-9
        if np.linalg.cond(matrix(entries, row, start).toarray()) < 1e8:
            np.testing.assert_allclose(x, expected, rtol=1e-5, atol=1e-7 * np.max(np.abs(expected)))
    assert solved > 0
    assert lu.counts.chosen <= solved / 2 + 1


def test_a_bordered_diagonal_is_not_filled():
    """Elimination from the border would fill all n^2 entries."""
    n = 300
    A = scipy.sparse.lil_matrix(scipy.sparse.identity(n) * 4)
    A[0, :], A[:, 0] = 1.0, 1.0
    A = scipy.sparse.csc_matrix(A)
    lu = LU(A.indptr, A.indices)
    assert lu.factor(A.data)
    assert lu.counts.entries == A.nnz
    assert lu.counts.operations == 3 * (n - 1)


@pytest.mark.parametrize("n", [4, 8, 12, 20])
def test_factors_that_grow_are_no_sign_of_a_singular_matrix(n):
    """Of a staircase the cheapest pivots are the small ones: each lets the full column grow by 1 / 0.15."""
    A = np.zeros((n, n))
    A[:, 0] = 1
    for k in range(n - 1):
        A[k : k + 2, n - 1 - k] = 0.15, 1
    assert np.linalg.cond(A) < 30
    A = scipy.sparse.csc_matrix(A)
    lu, b = LU(A.indptr, A.indices), np.arange(1.0, n + 1)
    assert lu.factor(A.data)
    assert backward_error(A, lu.solve(b), b) < 1e-12


def test_pivots_that_vanish_are_chosen_anew():
    start, row = np.array([0, 2, 4]), np.array([0, 1, 0, 1])
    lu = LU(start, row)
    for values, chosen in (([4.0, 1, 1, 3], 1), ([3.0, 1, 1, 4], 1), ([1e-9, 1, 1, 1e-9], 2), ([1.0, 1, 1, 1], 3)):
        regular = lu.factor(np.array(values))
        assert lu.counts.chosen == chosen
        assert regular == (np.linalg.matrix_rank(np.reshape(values, (2, 2))) == 2)
    assert not lu.factor(np.array([np.nan, 1, 1, 1]))
    assert not lu.factor(np.array([np.inf, 1, 1, 1]))
    assert lu.factor(np.array([2.0, 0, 0, 2]))
    assert lu.solve(np.ones(2)).tolist() == [0.5, 0.5]


def test_other_lengths_are_refused():
    lu = LU(np.array([0, 1]), np.array([0]))
    with pytest.raises(ValueError, match="1 entries"):
        lu.factor(np.ones(2))
    with pytest.raises(ValueError, match="1 values"):
        lu.solve(np.ones(2))
    assert LU(np.array([0]), np.zeros(0)).factor(np.zeros(0))
