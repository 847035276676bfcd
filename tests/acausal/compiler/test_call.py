"""Functions called in place, at many times, and once for each model."""

from __future__ import annotations

from types import SimpleNamespace

import casadi as ca
import numpy as np
import pytest

from acausal.compiler.call import Call
from acausal.compiler.memo import memoized, memoized_latest
from acausal.compiler.vectorized import AT_ONCE, PAYS, Vectorized

X = ca.SX.sym("x", 2)


def test_outputs_are_overwritten():
    call = Call(ca.Function("f", [X], [2 * X, ca.sum1(X)]))
    first = call(np.array([1.0, 2.0]))
    np.testing.assert_array_equal(first[0], [2, 4])
    call(np.array([3.0, 5.0]))
    np.testing.assert_array_equal(first[0], [6, 10])
    np.testing.assert_array_equal(first[1], [8])


@pytest.mark.parametrize("n", [1, 2, AT_ONCE, AT_ONCE + 1, 3 * AT_ONCE - 1])
def test_rows_are_those_of_single_calls(n):
    arguments = [ca.SX.sym(name, size) for name, size in (("x", 2), ("z", 3), ("p", 1), ("t", 1), ("c", 2))]
    x, z, p, t, c = arguments
    function = ca.Function("f", arguments, [ca.vertcat(x * p + t, z * c[0], c[1])])
    rng = np.random.default_rng(n)
    xs, zs, ts = rng.random((n, 2)), rng.random((n, 3)), rng.random(n)
    cs, p0 = rng.random((n, 2)), rng.random(1)
    found = Vectorized(function)(xs, zs, p0, ts[:, None], cs)
    expected = [np.array(function(xs[k], zs[k], p0, ts[k], cs[k])).ravel() for k in range(n)]
    np.testing.assert_array_equal(found, expected)


def test_once_for_each_model_and_argument():
    counted = []

    @memoized
    def twice(model, number):
        counted.append((model.name, number))
        return 2 * number

    a, b = SimpleNamespace(memo={}, name="a"), SimpleNamespace(memo={}, name="b")
    assert [twice(a, 1), twice(a, 1), twice(a, 2), twice(b, 1)] == [2, 2, 4, 2]
    assert counted == [("a", 1), ("a", 2), ("b", 1)]


def test_the_latest_of_each_model():
    counted = []

    @memoized_latest(2)
    def twice(model, number):
        counted.append((model.name, number))
        return 2 * number

    a, b = SimpleNamespace(memo={}, name="a"), SimpleNamespace(memo={}, name="b")
    asked = [(a, 1), (b, 1), (a, 1), (b, 1), (a, 2), (a, 1), (a, 3), (a, 2), (a, 1)]
    assert [twice(m, k) for m, k in asked] == [2, 2, 2, 2, 4, 2, 6, 4, 2]
    assert counted == [("a", 1), ("b", 1), ("a", 2), ("a", 3), ("a", 1)]


def test_places_have_the_same_values_once_a_tape_pays():
    x, p = ca.SX.sym("x", 2), ca.SX.sym("p")
    vectorized = Vectorized(ca.Function("f", [x, p], [ca.vertcat(ca.sin(x[0]) * p, x[1] / p)]))
    xs, p0 = np.random.default_rng(0).standard_normal((PAYS // 2, 2)), np.array([0.7])
    first, second, third = (vectorized(xs, p0) for _ in range(3))
    np.testing.assert_array_equal(second, first)
    np.testing.assert_array_equal(third, first)
    assert vectorized._tape is not None
