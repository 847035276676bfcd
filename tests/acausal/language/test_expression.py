"""Arithmetic of expressions agrees with numpy for scalars, vectors and matrices."""

from __future__ import annotations

import operator
from typing import Any

import casadi as ca
import numpy as np
import pytest

import acausal as ac
from acausal.language.expression import Expr, as_expr
from acausal.symbols import OPERATIONS, combined

SHAPES: list[tuple[int, ...]] = [(), (3,), (3, 3)]
VALUES = {shape: np.random.default_rng(len(shape)).uniform(1, 2, shape) for shape in SHAPES}
SYMBOLS = {shape: ca.SX.sym("v", *(shape or (1,))) for shape in SHAPES}


def value(expression: Expr) -> np.ndarray:
    found = ca.Function("f", list(SYMBOLS.values()), [ca.densify(expression.sx)])(*VALUES.values())
    return np.array(found).reshape(expression.shape)


def outcome(operate: Any, *operands: Any) -> Any:
    """The value, or None where the operation is refused."""
    try:
        found = operate(*operands)
    except (ac.DeclarationError, ValueError):
        return None
    return value(found) if isinstance(found, Expr) else np.asarray(found)


@pytest.mark.parametrize("operate", [operator.add, operator.sub, operator.mul, operator.truediv, operator.matmul])
@pytest.mark.parametrize("right", SHAPES)
@pytest.mark.parametrize("left", SHAPES)
def test_operations_are_those_of_numpy(left, right, operate):
    """Broadcasting is not: of arrays of two shapes only products with scalars and matrix products are defined."""
    found = outcome(operate, Expr(SYMBOLS[left]), Expr(SYMBOLS[right]))
    if found is None:
        defined = {operator.mul: not left or not right or left == right, operator.truediv: not right}
        assert not defined.get(operate, (left and right) if operate is operator.matmul else left == right)
        return
    expected = operate(VALUES[left], VALUES[right])
    assert found.shape == expected.shape
    np.testing.assert_allclose(found, expected, rtol=1e-14)


@pytest.mark.parametrize("number", [0, 2.5, np.float64(-1.0), np.arange(3.0), (0.0, 1.0, 2.0)])
def test_numbers_on_both_sides(number):
    shape = np.shape(number)
    other = Expr(SYMBOLS[shape])
    for operate in (operator.add, operator.sub, operator.mul):
        np.testing.assert_allclose(value(operate(other, number)), operate(VALUES[shape], np.asarray(number)))
        if not isinstance(number, np.ndarray):
            np.testing.assert_allclose(value(operate(number, other)), operate(np.asarray(number), VALUES[shape]))


@pytest.mark.parametrize("number", [0, 0.0, -0.0, np.int64(0), False])
def test_zero_has_no_entries(number):
    """What is exactly 0 drops out of the equations."""
    assert as_expr(number).sx.nnz() == 0
    assert as_expr((number, 1.0)).sx.nnz() <= 2
    assert as_expr(number).shape == ()


@pytest.mark.parametrize("number", [np.nan, np.inf, 1e300, 7, True])
def test_numbers_are_kept(number):
    np.testing.assert_equal(float(as_expr(number).sx), float(number))


@pytest.mark.parametrize("symbol", OPERATIONS)
def test_operations_without_a_search_for_types_build_the_same(symbol):
    operate = {"+": operator.add, "-": operator.sub, "*": operator.mul, "/": operator.truediv}[symbol]
    scalar, vector = SYMBOLS[()], SYMBOLS[(3,)]
    operands = [scalar, vector, ca.SX(3, 1), ca.SX(1, 1), ca.SX(2.0), vector * scalar - 1]
    for a in operands:
        for b in operands:
            one, other = combined(a, symbol, b), operate(a, b)
            assert str(one) == str(other)
            assert one.sparsity() == other.sparsity()
