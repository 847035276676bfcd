"""Levels of a block triangular system."""

from __future__ import annotations

import numpy as np
import pytest

from acausal.structure import Block, block_triangular, levels


def solved(rows, products):
    return levels(block_triangular(rows, [(k, k) for k in range(len(rows))]), rows, products)


def test_a_chain_of_sums_is_one_level():
    """x0 = 1, x1 = x0 + 1, x2 = x1 + x0."""
    (level,) = solved([[0], [0, 1], [0, 1, 2]], [])
    assert level.linear
    assert level.variables == level.equations == (0, 1, 2)


def test_a_product_waits_for_one_of_its_factors():
    """x0 = 1, x1 = 2, x2 = x0*x1, x3 + x0*x3 = x2: x2 needs x0 or x1 before, and so does x3."""
    first, second = solved([[0], [1], [0, 1, 2], [0, 2, 3]], [(2, 0, 1), (2, 1, 0), (3, 0, 3), (3, 3, 0)])
    assert (first.variables, second.variables) == ((0, 1), (2, 3))
    assert first.linear
    assert second.linear


def test_what_is_not_linear_by_itself_stands_alone():
    """x0**2 = 2, x1 = x0, x2 = 3."""
    found = solved([[0], [0, 1], [2]], [(0, 0, 0)])
    assert [(level.variables, level.linear) for level in found] == [((0,), False), ((2,), True), ((1,), True)]


def test_no_equations_have_no_levels():
    assert levels((), [], []) == ()
    assert levels([Block((0,), (0,))], [[0]], [])[0].linear


@pytest.mark.parametrize("seed", range(100))
def test_each_level_needs_only_those_before_it_and_is_linear_if_it_says_so(seed):
    random = np.random.default_rng(seed)
    n = int(random.integers(1, 13))
    rows = [sorted({k, *random.integers(0, n, random.integers(0, 4)).tolist()}) for k in range(n)]
    products = [(k, a, b) for k in range(n) for a, b in [random.choice(rows[k], 2).tolist()] if random.random() < 0.5]
    found = solved(rows, products)
    assert sorted(v for level in found for v in level.variables) == list(range(n))
    known: set[int] = set()
    for level in found:
        mine = set(level.variables)
        assert {v for e in level.equations for v in rows[e]} <= known | mine
        inside = [p for p in products if p[0] in level.equations and p[1] in mine and p[2] in mine]
        if level.linear:
            assert not inside
        known |= mine
