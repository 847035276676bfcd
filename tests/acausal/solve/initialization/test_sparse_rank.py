"""Large matrices by sparse factors, against their singular values and dense factors."""

from __future__ import annotations

import numpy as np
import pytest
import scipy

from acausal.solve.initialization import coordinate_partitioning
from acausal.solve.initialization.coordinate_partitioning import _projector_norm, _select, _transversality
from acausal.solve.initialization.rank import columns_by_pivots, is_regular, least_norm, null_space, outside, rank
from acausal.solve.initialization.sparse_rank import complement, gram, least_singular_value, unit_rows
from acausal.solve.sparse_blocks import connected_blocks_of

M, N = 150, 190


def band(seed: int = 0, m: int = M, n: int = N) -> scipy.sparse.csc_matrix:
    """Rows with six entries each, along a diagonal."""
    random = np.random.default_rng(seed)
    full = np.zeros((m, n))
    for k in range(m):
        first = k * (n - 6) // (m - 1)
        full[k, first : first + 6] = random.standard_normal(6)
    return scipy.sparse.csc_matrix(full)


def test_the_least_singular_value_decides():
    rows = unit_rows(band())
    least = scipy.linalg.svdvals(rows.toarray())[-1]
    assert least > 1e-4
    assert gram(rows, 0.999 * least) is not None
    assert gram(rows, 1.001 * least) is None


def test_dependent_rows_are_found():
    A = band().tolil()
    A[70] = A[69] + A[71]
    A = A.tocsc()
    assert gram(unit_rows(A), 0.0) is None
    assert complement(A, 0.0) is None
    assert not is_regular(A)
    assert is_regular(band())
    assert rank(A.toarray()) == M - 1
    assert len(null_space(A)) == N - M + 1


def test_small_ones_are_left_to_singular_values():
    assert gram(band(m=20, n=30), 0.0) is None


def test_least_norm_is_that_of_dense_factors():
    A, sizes, right = band(), np.geomspace(0.1, 10, N), np.cos(np.arange(M))
    np.testing.assert_allclose(
        least_norm(A, sizes, 1e-9)(right), least_norm(A.toarray(), sizes, 1e-9)(right), rtol=0, atol=1e-8
    )


def test_null_space_and_what_is_outside():
    A = band()
    null, v = null_space(A), np.sin(np.arange(N))
    assert null.shape == (N - M, N)
    np.testing.assert_allclose(null @ null.T, np.eye(N - M), atol=1e-13)
    np.testing.assert_allclose(unit_rows(A) @ null.T, 0, atol=1e-12)
    np.testing.assert_allclose(outside(A)(v), null.T @ (null @ v), atol=1e-10)


def test_columns_are_as_good_as_those_of_dense_pivots():
    A = unit_rows(band())
    ours = columns_by_pivots(A)
    theirs = scipy.linalg.qr(A.toarray(), mode="r", pivoting=True)[1][:M]
    assert len(set(ours.tolist())) == M
    mine, other = (np.linalg.svd(A.toarray()[:, k], compute_uv=False)[-1] for k in (ours, theirs))
    assert mine > 0.1 * other


def test_the_oblique_projector_tells_the_angle():
    J, D = band(0), band(1)
    bases = [np.linalg.qr(A.toarray().T)[0] for A in (J, D)]
    cosine = np.linalg.svd(bases[0].T @ bases[1], compute_uv=False)[-1]
    assert 1 / _projector_norm(J, D) == pytest.approx(cosine, rel=1e-3)


def test_large_parts_are_chosen_and_judged_as_small_ones(monkeypatch):
    J = unit_rows(band(m=30, n=31))
    on, levels = np.ones(30, dtype=bool), connected_blocks_of(J)
    dense = _select(levels, J.data, on)
    worst = _transversality(levels, J.data[None], dense)
    monkeypatch.setattr(coordinate_partitioning, "SMALL", 10)
    found = _select(levels, J.data, on)
    np.testing.assert_array_equal(found, dense)
    np.testing.assert_allclose(_transversality(levels, J.data[None], found), worst, rtol=1e-3)


@pytest.mark.parametrize("last", [1.0, 1e-2, 1e-4, 1e-6])
@pytest.mark.parametrize("turned", [False, True])
def test_the_least_singular_value_of_sparse_rows(last, turned):
    """Of a band whose last row is nearly the one before it."""
    A = unit_rows(band()).tolil()
    A[-1] = A[-2].toarray() + last * A[-1].toarray()
    A = (A.T if turned else A).tocsc()
    expected = np.linalg.svd(A.toarray(), compute_uv=False)[-1]
    assert least_singular_value(A) == pytest.approx(expected, rel=1e-3)


def test_the_least_singular_value_of_equal_rows_is_hidden_by_rounding():
    A = unit_rows(band()).tolil()
    A[-1] = A[-2]
    assert least_singular_value(A.tocsc()) < 1e-7
