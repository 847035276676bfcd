"""Algebraic unknowns at many places, against closed forms; on scenes see the tests of what is consistent."""

from __future__ import annotations

import casadi as ca
import numpy as np
import pytest

from acausal.core import Settler, make_square

P, C, X, Z = (ca.SX.sym(name, n) for name, n in (("p", 2), ("c", 1), ("x", 1), ("z", 4)))


def settler() -> Settler:
    """z1 + z1^3 = p1 x + (p1 x)^3 and z3 = c z1^2 + p2; z0 and z2 are given."""
    right = P[0] * X
    residuals = ca.vertcat(Z[1] + Z[1] ** 3 - right - right**3, Z[3] - C * Z[1] ** 2 - P[1] - 0 * Z[0])
    return Settler(make_square([P, C, X, Z], 2, residuals, 3, np.array([1, 3])))


def known(p: np.ndarray, c: np.ndarray, x: np.ndarray) -> np.ndarray:
    return np.column_stack([p[0] * x[:, 0], c[:, 0] * (p[0] * x[:, 0]) ** 2 + p[1]])


def test_unknowns_are_those_of_the_equations() -> None:
    rng, p, n = np.random.default_rng(0), np.array([0.7, -1.0]), 50
    x, c, z = rng.uniform(-2, 2, (n, 1)), rng.integers(0, 3, (n, 1)).astype(float), rng.uniform(-1, 1, (n, 4))
    z[:, [1, 3]] = known(p, c, x) + rng.uniform(-0.1, 0.1, (n, 2))
    solve = settler()
    found, settled = solve(p, c, x, z, size=np.ones(2), enough=1e-7)
    assert np.all(settled)
    np.testing.assert_allclose(found, known(p, c, x), atol=1e-14)
    first = solve.evaluations
    z[:, [1, 3]] = found
    again, _ = solve(p, c, x, z, size=np.ones(2), enough=1e-7)
    np.testing.assert_allclose(again, found, atol=1e-15)
    assert solve.evaluations == first + n
    far, settled = solve(p + 1, c, x, z, size=np.ones(2), enough=1e-7)
    assert np.any(settled)
    np.testing.assert_allclose(far[settled], known(p + 1, c, x)[settled], atol=1e-13)


def test_places_without_a_solution_leave_the_others_alone() -> None:
    """z^2 = x has none for x < 0, and a slope of 0 at z = 0."""
    square = make_square([P, C, X, Z], 2, Z[0] ** 2 - X, 3, np.array([0]))
    x, z = np.array([[4.0], [-1.0], [9.0], [np.nan], [1.0]]), np.ones((5, 4))
    z[4, 0] = 0.0
    found, settled = Settler(square)(np.zeros(2), np.zeros((5, 1)), x, z, size=np.ones(1), enough=1e-8)
    assert settled.tolist() == [True, False, True, False, False]
    np.testing.assert_allclose(found[[0, 2], 0], [2, 3], atol=1e-14)


def test_arguments_that_do_not_fit_are_refused() -> None:
    with pytest.raises(ValueError, match="arguments of"):
        settler()(np.zeros(2), np.zeros((3, 1)), np.zeros((3, 2)), np.zeros((3, 4)), size=np.ones(2), enough=1e-7)
