"""Propagation of constants and aliases."""

from __future__ import annotations

import casadi as ca

from acausal.flatten.linear_values import LinearValues
from acausal.flatten.simplify import Simplification, Simplifier
from acausal.units import parse

x = ca.SX.sym("x", 6)
p = ca.SX.sym("p")


def simplify(residuals: list[ca.SX], derivative: list[int] | None = None) -> Simplification:
    linear = LinearValues(x, p, ca.vertcat(*residuals))
    return Simplifier(linear, derivative or [-1] * 6, [0] * 6).run()


def test_constants_kill_products_and_go_on() -> None:
    done = simplify([x[2] - x[1] * p, x[1] - x[0] * ca.sin(p), x[0]])
    assert done.solved == {0: (0.0, ()), 1: (0.0, ()), 2: (0.0, ())}


def test_alias_with_factor_and_offset() -> None:
    done = simplify([2 * x[1] - 6 * x[0] + 4])
    assert done.solved in ({1: (-2.0, ((0, 3.0),))}, {0: (2 / 3, ((1, 1 / 3),))})


def test_what_has_to_stay_is_neither_removed_nor_chained() -> None:
    linear = LinearValues(x, p, ca.vertcat(x[0] - x[1], x[2] - x[0], x[0] - 3))
    done = Simplifier(linear, [-1, 3, -1, -1, -1, -1], [0] * 6, stay={0}).run()
    assert done.solved == {2: (0.0, ((0, 1.0),))}, "the chained x[1] is no alias"
    assert set(done.kept) == {2}


def test_constant_reaches_what_became_an_alias_before() -> None:
    linear = LinearValues(x, p, ca.vertcat(x[0] - x[1], x[0] * p + x[2], x[1] - x[3], x[3]))
    done = Simplifier(linear, [-1] * 6, [0] * 6).run()
    assert set(done.solved) == {0, 1, 2, 3}
    assert all(linear.resolve((0.0, ((k, 1.0),))) == (0.0, ()) for k in range(4))


def test_parameters_are_no_constants() -> None:
    assert simplify([p * x[0] - x[1]]).solved == {}


def test_redundant_and_contradictory_equations() -> None:
    done = simplify([x[0] - x[1], x[1] - x[0], x[2] - 1, x[2] - 2])
    assert done.redundant == [1]
    assert [(source.row, abs(value)) for source, value in done.contradictions] == [(3, 1.0)]


def test_speed_becomes_the_derivative() -> None:
    # phi = x0, w = x1, der(phi) = x2, der(w) = x3: w == der(phi)
    done = simplify([x[1] - x[2]], [2, 3, -1, -1, -1, -1])
    assert done.solved == {2: (0.0, ((1, 1.0),))}
    assert done.derivative[0] == 1
    assert done.derivative[1] == 3


def test_derivatives_of_aliases_are_aliases() -> None:
    # x0 = -x1, with derivatives x2, x3 of both
    done = simplify([x[0] + x[1]], [2, 3, -1, -1, -1, -1])
    assert len(done.solved) == 2
    assert {v[1][0][1] for v in done.solved.values()} == {-1.0}


def test_variable_is_not_merged_with_its_derivative() -> None:
    assert simplify([x[0] - x[1]], [1, -1, -1, -1, -1, -1]).solved == {}


def test_constant_derivative_keeps_the_equation() -> None:
    done = simplify([x[1] - 3], [1, -1, -1, -1, -1, -1])
    assert done.solved == {}
    assert done.kept == {0: (-3.0, ((1, 1.0),))}


def test_small_coefficients_are_not_divided_by() -> None:
    for coefficient in (6e-17, 1e-3):
        assert simplify([x[0] + coefficient * x[1]]).solved == {0: (0.0, ((1, -coefficient),))}
        assert simplify([coefficient * x[0] + x[1]]).solved == {1: (0.0, ((0, -coefficient),))}


def test_coefficients_of_other_units_are_not_compared() -> None:
    # A spring: force = 1e6 s, with s = x0, der(s) = x2.
    linear = LinearValues(x, p, ca.vertcat(x[1] - 1e6 * x[0]))
    units = [parse(unit) for unit in ("m", "N", "m/s", "1", "1", "1")]
    assert Simplifier(linear, [2, -1, -1, -1, -1, -1], [0] * 6, units=units).run().solved == {1: (0.0, ((0, 1e6),))}
