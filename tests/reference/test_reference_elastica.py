import numpy as np
import pytest
from scipy.integrate import solve_bvp

from tests.reference import cantilever, elastica


@pytest.mark.parametrize(
    ("load", "across", "along"),
    # Mattiasson, Numerical results from large deflection beam and frame problems analysed by means of elliptic integrals,
    # International Journal for Numerical Methods in Engineering 17 (1981).
    [(1.0, 0.30172, 0.05643), (2.0, 0.49346, 0.16064), (3.0, 0.60325, 0.25442), (10.0, 0.81061, 0.55500)],
)
def test_published_deflections(load, across, along):
    x, y, _ = elastica.tip_force(load)
    assert y == pytest.approx(across, abs=6e-6)
    assert 1 - x == pytest.approx(along, abs=6e-6)


@pytest.mark.parametrize("load", [0.25, 0.5, 3.0])
def test_solution_of_the_boundary_value_problem(load):
    def slopes(s, y):
        return np.array([y[1], -load * np.cos(y[0]), np.cos(y[0]), np.sin(y[0])])

    def ends(a, b):
        return np.array([a[0], b[1], a[2], a[3]])

    s = np.linspace(0, 1, 20)
    found = solve_bvp(slopes, ends, s, np.array([s, 1 - s, s, 0 * s]), tol=1e-10)
    np.testing.assert_allclose(elastica.tip_force(load), found.y[[2, 3, 0], -1], atol=1e-9)


def test_a_small_force_bends_as_by_linear_theory():
    x, y, angle = elastica.tip_force(1e-3)
    v, slope = cantilever.tip_force_deflection(1.0, 1.0, 1.0, 1e-3)
    assert (y, angle) == (pytest.approx(v, rel=1e-6), pytest.approx(slope, rel=1e-6))
    # The integral of slope^2 / 2 with the slope x - x^2 / 2.
    assert 1 - x == pytest.approx(1e-6 / 15, rel=1e-4)
