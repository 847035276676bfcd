"""Functions of other libraries in tapes and in CasADi's functions: values, derivatives, and derivatives of these products."""

from __future__ import annotations

import gc

import casadi as ca
import numpy as np
import pytest

import acausal as ac
from acausal.core.externals import VALUE, external_data, values_of
from acausal.core.tape import make_tape
from acausal.instructions import READABLE
from acausal.language.external import External
from acausal.symbols import dense


class Product(External):
    """a b + c and sin(a c), with their derivatives."""

    def __init__(self):
        self.argument, self.calls = np.zeros(3), 0
        self._value = VALUE(self.value)
        super().__init__("product", ("product", "sine"), external_data(self.argument, self._value))

    def value(self, own, place):
        self.calls += 1
        a, b, c = self.argument
        slope = c * np.cos(a * c), 0, a * np.cos(a * c)
        return [a * b + c, np.sin(a * c), b, slope[0], a, slope[1], 1, slope[2]][place]


@pytest.fixture
def product():
    return Product()


def expressions(number):
    x, v = ca.SX.sym("x", 3), ca.SX.sym("v", 3)
    y = values_of(number, x, [0, 1], 2)
    rate = ca.jtimes(y, x, v)
    backwards = ca.jtimes(y, x, ca.vertcat(1, 2), True)
    return [x, v], [y, ca.jacobian(y, x), rate, ca.jacobian(rate, v), backwards]


def test_values_and_derivatives(product):
    given, found = expressions(ca.SX(product.number))
    at = np.array([1.0, 2.0, 3.0]), np.array([0.5, -1.0, 2.0])
    J = np.array([[2, 1, 1], [3 * np.cos(3), 0, np.cos(3)]])
    right = [[5, np.sin(3)], *J.T, J @ at[1], *J.T, J.T @ [1, 2]]
    column = np.concatenate([np.ravel(part) for part in right])
    by_casadi = [dense(part).full() for part in ca.Function("f", given, found, READABLE)(*at)]
    np.testing.assert_allclose(np.concatenate([part.ravel(order="F") for part in by_casadi]), column, atol=1e-15)
    tape = make_tape(ca.Function("f", given, [dense(e) for e in found], READABLE))
    np.testing.assert_allclose(tape.rows(*at)[0], column, atol=1e-15)
    product.calls = 0
    tape.rows(*at)
    assert product.calls == 8  # each value and each derivative once


def test_a_function_that_is_gone_has_no_value():
    product = Product()
    given, found = expressions(ca.SX(product.number))
    tape = make_tape(ca.Function("f", given, [dense(found[0])], READABLE))
    del product
    gc.collect()
    assert np.all(np.isnan(tape.rows(np.ones(3), np.ones(3))))


class Part(External):
    """The identity, which has no value above 0.5."""

    def __init__(self):
        self.argument = np.zeros(1)
        self._value = VALUE(lambda own, place: np.nan if self.argument[0] > 0.5 else [self.argument[0], 1.0][place])
        super().__init__("supplier.so", ("value",), external_data(self.argument, self._value))


class Growing(ac.Model):
    x: ac.Scalar = ac.variable("state", start=0, fixed=True)
    part: Part = ac.structural("function", cls=Part)

    def equations(self):
        yield ac.quantity(1, "s") * ac.der(self.x) == 1 + ac.external(self.part, [self.x], [0])[0]


def test_where_a_function_has_no_value_it_is_named():
    model = Growing(part=Part())
    result = ac.simulate(model, stop_time=0.4, tolerance=1e-9)
    np.testing.assert_allclose(result["x"], np.expm1(result.time), atol=1e-8)
    with pytest.raises(
        ac.SimulationError, match=r"(?s)t = 0\.405.*asks supplier\.so for a value that it does not have"
    ):
        ac.simulate(model, stop_time=1)
    with pytest.raises(ac.ExportError, match=r"supplier\.so"):
        ac.export_fmu(model, "never.fmu")
