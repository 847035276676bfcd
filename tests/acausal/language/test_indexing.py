"""Indexing of symbolic arrays agrees with numpy."""

from __future__ import annotations

from typing import Any

import casadi as ca
import numpy as np
import pytest

import acausal as ac
from acausal.language.expression import Expr
from acausal.language.indexing import selected_entries

INDICES: dict[tuple[int, ...], list[Any]] = {
    (4,): [0, -1, 3, slice(None), slice(1, 3), slice(None, None, -1), slice(-3, None), slice(0, 4, 2), slice(2, 2)],
    (3, 2): [
        0,
        -3,
        (1, 1),
        (-1, 0),
        slice(1, 3),
        (slice(None), 0),
        (2, slice(None)),
        (slice(0, 2), slice(None, None, -1)),
    ],
}
CASES = [(shape, index) for shape, indices in INDICES.items() for index in indices]


@pytest.mark.parametrize(("shape", "index"), CASES)
def test_places_are_those_of_numpy(shape, index):
    places = np.arange(int(np.prod(shape))).reshape(shape, order="F")
    np.testing.assert_array_equal(selected_entries(lambda: "v", shape, index), places[index])


@pytest.mark.parametrize(("shape", "index"), CASES)
def test_entries_of_an_expression_are_those_of_its_values(shape, index):
    symbol = ca.SX.sym("v", *shape)
    found = Expr(symbol)[index]
    values = np.random.default_rng(0).standard_normal(shape)
    assert found.shape == values[index].shape
    value = np.array(ca.Function("f", [symbol], [ca.densify(found.sx)])(values))
    np.testing.assert_array_equal(value.reshape(found.shape), values[index])


@pytest.mark.parametrize(
    ("shape", "index"), [((), 1), ((4,), 4), ((4,), -5), ((4,), (0, 1)), ((3, 2), (0, 2)), ((3, 2), (0, 0, 0))]
)
def test_entries_outside_are_refused(shape, index):
    with pytest.raises(ac.DeclarationError, match=r"`v\[.*\]` is outside v"):
        selected_entries(lambda: "v", shape, index)


@pytest.mark.parametrize("index", [True, 1.0, "a", None, (0, 1.5)])
def test_what_is_no_index_is_refused(index):
    with pytest.raises(ac.DeclarationError, match="selected by integers"):
        selected_entries(lambda: "v", (3, 2), index)
