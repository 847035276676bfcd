"""Sizes of the terms of expressions: times the rounding error they bound what rounding changes, and by little too much."""

from __future__ import annotations

from fractions import Fraction

import casadi as ca
import numpy as np
import pytest

from acausal.compiler.rounding import terms

X, Y = ca.SX.sym("x"), ca.SX.sym("y")


def size(expression: ca.SX, *values: float) -> float:
    given = [X, Y][: max(len(values), 1)]
    return float(ca.Function("size", given, [terms(given, ca.densify(expression))])(*values))


def test_sums_keep_the_size_of_terms_that_cancel():
    assert size(X - 100, 100) == 200
    assert size((X - 100) * Y, 100, 3) == 600
    assert size((X - 100) ** 2, 100) == 0
    assert size(ca.sin(X), np.pi) == pytest.approx(np.pi)
    assert size(ca.SX(7), 0) == 7


def test_cases_that_do_not_hold_do_not_matter():
    assert size(ca.if_else(X < 0, ca.sqrt(X), 2 * X), 3) == 24
    assert size(ca.if_else(X < 0, 1 / (X - 3), 0), 3) == 0


def test_expressions_together_are_as_each_alone():
    some = [
        X - 100,
        ca.sin(X * Y) - X,
        ca.sqrt(X) + ca.sqrt(Y),
        X,
        ca.SX(3),
        X * Y - Y / X,
        ca.if_else(X < Y, X, 2 * Y),
    ]
    together = ca.Function("size", [X, Y], [terms([X, Y], ca.densify(ca.vertcat(*some)))])
    for values in ((100, 3), (2, 7)):
        assert together(*values).elements() == [size(one, *values) for one in some]
    assert terms([X], ca.SX(0, 1)).shape == (0, 1)


def test_no_rounding_is_larger():
    def law(t, one, end):
        begin = t - end
        return one / 10 + 2 * (begin - one / 10) - 10 * (begin - one / 10) ** 2

    eps = np.finfo(float).eps
    for t, end in np.random.default_rng(1).uniform(0, 100, (200, 2)):
        exact = law(Fraction(t), Fraction(1), Fraction(end))
        bound = eps * size(law(X, 1, Y), t, end)
        assert abs(Fraction(float(law(t, 1.0, end))) - exact) <= bound
        assert bound <= 20 * eps * (1 + 4 * (t + end) * (1 + abs(t - end)) + 10 * (t - end) ** 2)
