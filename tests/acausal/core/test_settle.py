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


@pytest.mark.parametrize("enough", [1e-1, 1e-3, 1e-7])
@pytest.mark.parametrize("away", [1.0, 1e-2, 1e-4, 1e-6, 1e-10])
def test_what_is_enough_tells_the_error(enough, away) -> None:
    """Its square, and rounding, in an unknown that bends the equations and in one that follows from it."""
    rng, p, n = np.random.default_rng(1), np.array([0.7, -1.0]), 200
    x, c, z = rng.uniform(1, 2, (n, 1)), np.ones((n, 1)), np.zeros((n, 4))
    exact = known(p, c, x)
    z[:, [1, 3]] = exact * (1 + away * rng.uniform(-1, 1, (n, 2)))
    solve = settler()
    found, settled = solve(p, c, x, z, size=np.max(np.abs(exact), axis=0), enough=enough)
    assert np.all(settled)
    assert np.max(np.abs(found - exact)) < 10 * enough**2 + 1e-14
    if away <= enough:
        assert solve.evaluations == n


def test_an_unknown_that_is_nothing_but_rounding_settles() -> None:
    """z1 = z0 - 1e6 x is 0 but for rounding of its terms, and its size is no more than that."""
    square = make_square([P, C, X, Z], 2, ca.vertcat(Z[0] - 1e6 * X**2 / X, Z[1] - Z[0] + 1e6 * X), 3, np.array([0, 1]))
    x, z = np.random.default_rng(0).uniform(0.1, 1, (50, 1)), np.zeros((50, 4))
    z[:, 0], z[:, 1] = 1e6 * x[:, 0] * (1 + 1e-4), 1e-4
    found, settled = Settler(square)(np.zeros(2), np.zeros((50, 1)), x, z, size=np.array([1e6, 1e-12]), enough=1e-7)
    assert np.all(settled)
    np.testing.assert_allclose(found, np.column_stack([1e6 * x[:, 0], np.zeros(50)]), atol=1e-9)


@pytest.mark.parametrize("far", [1e2, 1e4, 1e8])
def test_large_terms_far_away_hide_no_error(far) -> None:
    """z0^2 = x and z1 = z0: terms at the first places are far larger than those at the solution."""
    square = make_square([P, C, X, Z], 2, ca.vertcat(Z[0] ** 2 - X, Z[1] - Z[0]), 3, np.array([0, 1]))
    x, z = np.random.default_rng(0).uniform(0.5, 2, (50, 1)), np.zeros((50, 4))
    z[:, :2] = far
    given = np.zeros(2), np.zeros((50, 1)), x, z
    found, settled = Settler(square)(*given, size=np.ones(2), enough=1e-7)
    np.testing.assert_allclose(found[settled], np.sqrt(x[settled]) * np.ones(2), rtol=1e-13)
    assert settled.all() or far > 1e7


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


def test_whether_equations_hold_is_told_by_the_sizes_of_their_terms() -> None:
    p, c, x = np.array([0.7, -1.0]), np.array([[2.0]]), np.array([[1.5]])
    z = np.zeros((1, 4))
    z[:, [1, 3]] = known(p, c, x)
    square = settler().square

    def hold(z: np.ndarray, tolerance: float) -> bool:
        rows = z[:, square.unknowns - 4]  # behind p, c and x
        return bool(square.hold(p, c, x, z, sizes=np.abs(rows), tolerance=tolerance).all())

    assert hold(z, 1e-14)
    for k, off in ((1, 1e-6), (3, 1e-6), (3, np.nan)):
        there = z.copy()
        there[0, k] *= 1 + off
        assert not hold(there, 1e-7)
        assert hold(there, 1e-5) == np.isfinite(off)
    # Of z3 = c z1^2 + p2 = 0 nothing is left but a residual.
    p[1] = -c[0, 0] * z[0, 1] ** 2
    z[0, 3] = 0.0
    assert hold(z, 1e-14)
    z[0, 3] = 1e-9
    assert hold(z, 1e-8)


@pytest.mark.parametrize("steep", [1e3, 1e4, 1e5, 1e6])
@pytest.mark.parametrize("beside", [1e-3, 0.3])
def test_bent_laws_are_solved_from_either_side(steep, beside) -> None:
    """2 tanh(steep z) + beside z = x + w and w = 0.1 z, from guesses on all of its parts."""
    residuals = ca.vertcat(2 * ca.tanh(steep * Z[1]) + beside * Z[1] - X - Z[3], Z[3] - 0.1 * beside * Z[1])
    solve = Settler(make_square([P, C, X, Z], 2, residuals, 3, np.array([1, 3])))
    ends = np.concatenate([np.linspace(-4, 4, 33), [1.999999, 2.000001, -1.9999999, 1e-9]])
    guesses = np.array([sign * 10.0**k for k in range(-8, 4) for sign in (-1, 1)])
    x, first = (grid.reshape(-1, 1) for grid in np.meshgrid(ends, guesses))
    z = np.hstack([np.zeros_like(first), first, np.zeros_like(first), np.zeros_like(first)])
    found, settled = solve(np.zeros(2), np.zeros(1), x, z, size=np.ones(2), enough=1e-7)
    left = 2 * np.tanh(steep * found[:, 0]) + 0.9 * beside * found[:, 0] - x[:, 0]
    assert np.mean(settled) > 0.99
    np.testing.assert_allclose(left[settled], 0, atol=4e-7)  # of terms up to 4


def test_no_solution_is_not_made_up() -> None:
    """z1^2 + 1 = x has none below 1, whatever the steps."""
    solve = Settler(make_square([P, C, X, Z], 2, ca.vertcat(Z[1] ** 2 + 1 - X, Z[3] - Z[1]), 3, np.array([1, 3])))
    x, z = np.linspace(-3, 0.99, 40)[:, None], np.random.default_rng(0).uniform(-2, 2, (40, 4))
    assert not np.any(solve(np.zeros(2), np.zeros(1), x, z, size=np.ones(2), enough=1e-7)[1])
