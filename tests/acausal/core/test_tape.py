"""Tapes give CasADi's values, bit by bit."""

from __future__ import annotations

import casadi as ca
import numpy as np
import pytest

from acausal.compiler.call import Call
from acausal.core import make_tape
from acausal.instructions import READABLE
from models import SCENES
from tests.acausal.core.models import jacobian, points
from tests.shared import compiled

UNARY = (
    *(ca.sqrt, ca.sin, ca.cos, ca.tan, ca.asin, ca.acos, ca.atan, ca.exp, ca.log, ca.sinh, ca.cosh, ca.tanh),
    *(ca.asinh, ca.acosh, ca.atanh, ca.fabs, ca.sign, ca.floor, ca.ceil, ca.log1p, ca.expm1, ca.erf),
    *(lambda x: -x, lambda x: x * x, lambda x: x + x, lambda x: 1 / x, lambda x: x**3, ca.logic_not),
)
BINARY = (
    *(ca.atan2, ca.fmod, ca.remainder, ca.copysign, ca.fmin, ca.fmax, ca.hypot, ca.power),
    *(lambda x, y: x + y, lambda x, y: x - y, lambda x, y: x * y, lambda x, y: x / y),
    *(lambda x, y: x < y, lambda x, y: x <= y, lambda x, y: x == y, lambda x, y: x != y),
    *(ca.logic_and, ca.logic_or, lambda x, y: ca.if_else(x > 0, y, x * y)),
)
ANY = np.array([0.0, -0.0, 0.5, -0.5, 1.0, -1.0, 2.0, -3.0, 1e300, -1e-300, np.inf, -np.inf, np.nan])


def same(tape_values: np.ndarray, function: ca.Function, arguments: list[np.ndarray]) -> None:
    call = Call(function)
    for k, found in enumerate(tape_values):
        expected = np.concatenate(call(*(a[k] if a.ndim == 2 else a for a in arguments)))
        both = np.isnan(expected) & np.isnan(found)
        np.testing.assert_array_equal(found[~both].view(np.int64), expected[~both].view(np.int64))


def test_every_operation_at_every_kind_of_number():
    x, y = ca.SX.sym("x"), ca.SX.sym("y")
    results = [ca.vertcat(*(f(x) for f in UNARY)), ca.vertcat(*(f(x, y) for f in BINARY)), ca.vertcat(x, 3.0)]
    function = ca.Function("all", [x, y], results)
    given = [values.reshape(-1, 1) for values in np.meshgrid(ANY, ANY)]
    same(make_tape(function).rows(*given), function, given)


@pytest.mark.parametrize("name", SCENES)
def test_equations_and_jacobian_of_a_scene(name):
    model = compiled(SCENES[name])
    function, given = jacobian(model), points(model, 20)
    tape = make_tape(function, early=(2, 4))
    same(tape.rows(*given), function, given)
    assert len(tape.kinds) <= max(140, function.n_instructions() / 100), "operations of one kind stand together"


def test_what_follows_from_early_arguments_stands_in_front():
    x, p = ca.SX.sym("x"), ca.SX.sym("p", 2)
    tape = make_tape(ca.Function("f", [x, p], [x * ca.sin(p[0] * p[1]), ca.cos(p[0])]), early=[1])
    assert tape.lengths[: tape.early].sum() == 3
    assert tape.lengths[tape.early :].sum() == 1
    alone = make_tape(ca.Function("f", [x, p], [x * 2]), early=[1])
    assert alone.early == 0
    every = make_tape(ca.Function("f", [x, p], [ca.exp(p)]), early=[1])
    assert every.early == len(every.kinds) == 1


def test_equal_operations_stand_once():
    x, y = ca.SX.sym("x"), ca.SX.sym("y")
    column = [result for _ in range(2) for result in (x * y + ca.sin(x * y), 2.5 * x, ca.sin(2.5 * x))]
    tape = make_tape(ca.Function("f", [x, y], [ca.vertcat(*column)]))
    assert (tape.constants.tolist(), len(tape.first), len(set(tape.output.tolist()))) == ([2.5], 5, 3)


def test_an_operation_that_it_does_not_know():
    x = ca.SX.sym("x")
    with pytest.raises(ValueError, match=rf"operations \{{{ca.OP_ERFINV}\}}"):
        make_tape(ca.Function("f", [x], [ca.erfinv(x)]))


def test_runs_take_what_stands_before_them():
    random = np.random.default_rng(4)
    x = ca.SX.sym("x", 40)
    nodes = list(ca.vertsplit(x))
    for _ in range(3000):
        a, b = (nodes[k] for k in random.integers(0, len(nodes), 2))
        nodes.append([a + b, a * b, a - b, ca.sin(a), ca.fmin(a, b), ca.fabs(b)][random.integers(6)])
    function = ca.Function("f", [x[:20], x[20:]], [ca.vertcat(*nodes[-60:])], READABLE)
    tape = make_tape(function, early=[0])
    own = len(tape.constants) + sum(tape.sizes)
    assert np.all(np.maximum(tape.first, tape.second) < own + np.arange(len(tape.first)))
    changing = set(range(own - 20, own))
    for k, (a, b) in enumerate(zip(tape.first.tolist(), tape.second.tolist(), strict=True)):
        if {a, b} & changing:
            changing.add(own + k)
    assert min(k for k in changing if k >= own) == own + tape.lengths[: tape.early].sum()
    given = [random.standard_normal((5, 20)) for _ in range(2)]
    same(tape.rows(*given), function, given)


def test_nothing_and_constants():
    x = ca.SX.sym("x", 2)
    assert make_tape(ca.Function("f", [x], [ca.SX(0, 1)])).rows(np.zeros((3, 2))).shape == (3, 0)
    assert make_tape(ca.Function("f", [x], [ca.DM([1, 0, 2])])).rows(np.zeros(2)).tolist() == [[1, 0, 2]]
    with pytest.raises(ValueError, match="2"):
        make_tape(ca.Function("f", [x], [x])).rows(np.zeros(3))
    with pytest.raises(ValueError, match="shapes"):
        make_tape(ca.Function("f", [x, ca.SX.sym("y", 2)], [x])).rows(np.zeros((3, 2)), np.zeros((4, 2)))


@pytest.mark.parametrize("name", SCENES)
def test_a_function_made_to_be_read_gives_the_same_tape(name):
    model = compiled(SCENES[name])
    arguments, column = model.arguments[:-1], ca.densify(model.reduced.running.ode)
    one, other = (make_tape(ca.Function("f", arguments, [column], options)) for options in ({}, READABLE))
    for mine, others in zip(one.arrays, other.arrays, strict=True):
        np.testing.assert_array_equal(mine, others)
