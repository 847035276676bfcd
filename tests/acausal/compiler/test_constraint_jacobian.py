"""The constraint of a point on a circle, as numbers."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from acausal.solve.initialization.newton import algebraic
from tests.acausal.solve.circle import compiled, plane, point, problem

# One constraint at two levels: x^2 + y^2 - 1, and its time derivative.
PLACES = [(3.0, 4.0, 0.0, 0.0), (0.6, -0.8, 2.0, 1.5), (0.1, 0.2, -3.0, 5.0)]


def columns(J: np.ndarray) -> np.ndarray:
    """Columns in the order x, y, u, v."""
    return np.array([plane(row) for row in J])


@pytest.mark.parametrize(("x", "y", "u", "v"), PLACES)
def test_residuals_and_their_jacobian_at_both_levels(x, y, u, v):
    value, J = problem().constraints(point(x, y, u, v))
    np.testing.assert_allclose(np.abs(value), np.abs([x**2 + y**2 - 1, 2 * x * u + 2 * y * v]), atol=1e-14)
    found = columns(J.toarray())
    sign = np.sign(found[0, 1] * y)
    np.testing.assert_allclose(sign * found, [[2 * x, 2 * y, 0, 0], [2 * u, 2 * v, 2 * x, 2 * y]], atol=1e-14)


def test_each_level_holds_coordinates_of_its_own():
    """The rates are left to the level of rates, although positions enter there too."""
    c, p = compiled().constraints, problem().p
    at = [point(*place) for place in PLACES]
    held = c.held(np.array([a.x for a in at]), p, np.zeros(3), at[0].constants.vector)
    for entries, (x, y, _, _) in zip(held, PLACES, strict=True):
        J = np.zeros((2, 4))
        J[tuple(c.entries)] = entries
        np.testing.assert_allclose(np.abs(columns(J)), np.abs([[2 * x, 2 * y, 0, 0], [0, 0, 2 * x, 2 * y]]))


def test_places():
    c = compiled().constraints
    assert (c.size, c.rows, c.closures) == (2, [(0, 1)], [])
    assert c.states.tolist() == [0, 1, 2, 3]
    level = {(0, "x"), (0, "y"), (1, "u"), (1, "v")}
    assert {(int(r), compiled().states[k]) for r, k in c.entries.T} == level
    assert len(set(c.multipliers)) == 2


@pytest.mark.parametrize("r", [0.7, 1.0, 1.4])
def test_projected_coordinates_are_on_the_circle(r):
    """Along the Jacobian at the nearest point; where y follows, at the same x."""
    at = point(0.6 * r, 0.8 * r, 0.8, -0.6)
    for moves, follows, expected in ((True, "xyuv", (0.6, 0.8)), (False, "yv", (0.6 * r, (1 - 0.36 * r**2) ** 0.5))):
        D = np.array([float(compiled().states[k] in follows) for k in compiled().constraints.entries[1]])
        start = problem().completed(replace(at, constants=replace(at.constants, moves=moves, D=D)))
        found = problem().projected(algebraic(problem(), start))
        np.testing.assert_allclose(plane(found.x)[:2], expected, atol=1e-12)
        assert start.x.tolist() == at.x.tolist()


def test_guesses_of_projected_coordinates_are_what_is_integrated():
    c, at = compiled().constraints, point(3, 4, 5, 6)
    z = c.complete(at.x, at.z, problem().p, 0.0, at.constants.vector)
    found = dict(zip(compiled().algebraic, z, strict=True))
    for name, value in zip("xyuv", (3, 4, 5, 6), strict=True):
        assert found.get(name, value) == value
