"""The cubic between two points."""

from __future__ import annotations

import numpy as np
import pytest

from acausal.solve.hermite import coefficients, cubic


@pytest.mark.parametrize("seed", range(10))
def test_a_polynomial_of_degree_three_is_its_own_cubic(seed):
    random = np.random.default_rng(seed)
    p = np.polynomial.Polynomial(random.standard_normal(4))
    a, h = random.uniform(-2, 2), random.uniform(0.1, 3)
    ends, s = np.array([a, a + h]), np.linspace(0, 1, 7)
    value, slope = cubic(s, h, p(ends), p.deriv()(ends))
    np.testing.assert_allclose(value, p(a + h * s), atol=1e-11)
    np.testing.assert_allclose(slope, p.deriv()(a + h * s), atol=1e-11)
    c3, c2 = coefficients(*p(ends), *(h * p.deriv()(ends)))
    np.testing.assert_allclose([c3, c2], [p.coef[3] * h**3, p.deriv(2)(a) / 2 * h**2], atol=1e-11)


def test_the_error_falls_with_the_fourth_power_of_the_length_and_that_of_the_slope_with_the_third():
    def errors(h):
        ends, s = 0.7 + np.array([0.0, h]), np.linspace(0, 1, 41)
        value, slope = cubic(s, h, np.sin(ends), np.cos(ends))
        return np.abs(value - np.sin(0.7 + h * s)).max(), np.abs(slope - np.cos(0.7 + h * s)).max()

    order = np.log2(np.array(errors(0.2)) / np.array(errors(0.1)))
    np.testing.assert_allclose(order, [4, 3], atol=0.15)


def test_several_functions_at_several_times():
    s = np.array([[0.0], [0.5], [1.0]])
    value, slope = cubic(s, 2.0, np.array([[0.0, 1.0], [2.0, 5.0]]), np.array([[1.0, 2.0], [1.0, 2.0]]))
    np.testing.assert_allclose(value, [[0, 1], [1, 3], [2, 5]])
    np.testing.assert_allclose(slope, [[1, 2]] * 3)
