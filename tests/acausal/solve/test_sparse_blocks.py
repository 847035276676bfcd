"""Parts of a sparse matrix that share nothing, against the matrix that they were mixed into."""

from __future__ import annotations

import numpy as np
import scipy

from acausal.solve.sparse_blocks import block_of, connected_blocks, connected_blocks_of


def test_blocks_that_were_mixed_are_found():
    random = np.random.default_rng(0)
    blocks = [random.standard_normal(shape) for shape in ((2, 3), (1, 1), (3, 2))]
    whole = scipy.linalg.block_diag(*blocks)
    mixed = whole[random.permutation(6)][:, random.permutation(6)]
    J = scipy.sparse.csc_matrix(mixed)
    found = connected_blocks_of(J)
    assert sorted((len(p.rows), len(p.columns)) for p in found) == [(1, 1), (2, 3), (3, 2)]
    back = np.zeros((6, 6))
    for block in found:
        own = block.dense(J.data)
        np.testing.assert_array_equal(own, mixed[np.ix_(block.rows, block.columns)])
        np.testing.assert_array_equal(own, block.sparse(J.data).toarray())
        back[np.ix_(block.rows, block.columns)] = own
    np.testing.assert_array_equal(back, mixed)


def test_a_row_without_entries_is_a_part_and_a_column_is_not():
    found = connected_blocks(np.array([0]), np.array([1]), (2, 3))
    assert [(p.rows.tolist(), p.columns.tolist()) for p in found] == [([0], [1]), ([1], [])]
    assert found[1].dense(np.ones(1)).shape == (1, 0)


def test_several_values_at_once():
    (block,) = connected_blocks(*np.indices((2, 2)).reshape(2, -1), (2, 2))
    values = np.arange(12.0).reshape(3, 4)
    np.testing.assert_array_equal(block.dense(values), values.reshape(3, 2, 2))


def test_rows_and_columns_in_any_order():
    random = np.random.default_rng(1)
    whole = np.where(random.random((6, 5)) < 0.6, random.standard_normal((6, 5)), 0.0)
    J = scipy.sparse.csc_matrix(whole)
    block = block_of(J, [4, 0, 3], np.array([3, 1]))
    expected = whole[np.ix_([4, 0, 3], [3, 1])]
    np.testing.assert_array_equal(block.dense(J.data), expected)
    np.testing.assert_array_equal(block.sparse(J.data).toarray(), expected)
    assert block.sparse(J.data).has_sorted_indices
