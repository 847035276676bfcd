"""Linear values of operations agree with the values of their expressions."""

from __future__ import annotations

import casadi as ca
import numpy as np
import pytest

from acausal.flatten.linear_values import Linear, LinearValues, add, scale

N = 5
x = ca.SX.sym("x", N)
p = ca.SX.sym("p")


def values(*residuals: ca.SX) -> list[Linear | None]:
    linear = LinearValues(x, p, ca.vertcat(*residuals))
    return [linear.value[node] for node in linear.residual]


@pytest.mark.parametrize(
    ("residual", "expected"),
    [
        (ca.SX(3.0), (3.0, ())),
        (x[1], (0.0, ((1, 1.0),))),
        (2 - x[1] / 4, (2.0, ((1, -0.25),))),
        (x[2] - x[0] + x[2], (0.0, ((0, -1.0), (2, 2.0)))),
        (x[0] + x[1] - x[0], (0.0, ((1, 1.0),))),
        (x[0] + x[1] + x[2], None),
        (x[0] * x[1], None),
        (x[0] * p, None),
        (ca.sin(x[0]), None),
        (ca.SX(0) * x[0], (0.0, ())),
    ],
)
def test_values_of_operations(residual, expected):
    assert values(residual) == [expected]


def test_sums_of_random_terms_are_those_of_vectors():
    rng = np.random.default_rng(0)

    def dense(value: Linear) -> np.ndarray:
        found = np.array([value[0], *np.zeros(N)])
        for unknown, c in value[1]:
            found[1 + unknown] += c
        return found

    for _ in range(200):
        a, b = ((float(rng.integers(-2, 3)), ((int(rng.integers(N)), float(rng.integers(1, 3))),)) for _ in range(2))
        factor = float(rng.integers(-2, 3)) or 1.0
        found = add(a, b, factor)
        assert found is not None
        np.testing.assert_array_equal(dense(found), dense(a) + factor * dense(b))
        assert all(c for _, c in found[1])
        np.testing.assert_array_equal(dense(scale(a, factor)), factor * dense(a))


def test_what_becomes_known_reaches_all_that_holds_it():
    """An update gives what a linear of the expressions with these values gives."""
    rng = np.random.default_rng(1)
    residuals = [x[0] * x[1] + x[2], ca.sin(x[1]) * x[3] - x[4], x[2] / x[1] + x[0], ca.sqrt(x[1]) - x[3] * p]
    known = {k: float(v) for k, v in zip(rng.permutation(N)[:3], rng.uniform(0.5, 2, 3), strict=True)}
    linear = LinearValues(x, p, ca.vertcat(*residuals))
    for unknown, value in known.items():
        linear.solve(int(unknown), (value, ()))
        linear.update()
    there = [known.get(k, x[k]) for k in range(N)]
    fresh = LinearValues(x, p, ca.substitute(ca.vertcat(*residuals), x, ca.vertcat(*there)))
    for one, other in zip(linear.residual, fresh.residual, strict=True):
        a, b = linear.value[one], fresh.value[other]
        assert (a is None) == (b is None)
        if a is not None and b is not None:
            assert a[0] == pytest.approx(b[0], rel=1e-15)
            assert dict(a[1]) == pytest.approx(dict(b[1]), rel=1e-15)
    assert linear.update() == []
