"""Where polynomials on rows leave their side of zero."""

from __future__ import annotations

from itertools import pairwise

import numpy as np
import pytest

from acausal.solve.events.crossing import Sides, dips, levels, root
from acausal.solve.hermite import coefficients

Polynomial = np.polynomial.Polynomial


def sides(times, *functions: Polynomial) -> Sides:
    t = np.asarray(times, dtype=float)
    value, rate = ([f(t) for f in functions] for functions in (functions, [f.deriv() for f in functions]))
    return Sides(t, np.column_stack(value), np.column_stack(rate))


def least(f: Polynomial, a: float, b: float) -> float:
    turns = [t.real for t in f.deriv().roots() if abs(t.imag) < 1e-12 and a < t.real < b]
    return min(f(t) for t in (a, b, *turns))


@pytest.mark.parametrize("degree", [0, 1, 2, 3])
@pytest.mark.parametrize("seed", range(10))
def test_least_values_of_cubics_are_exact(seed, degree):
    random = np.random.default_rng(seed)
    functions = [Polynomial(random.standard_normal(degree + 1)) for _ in range(3)]
    times = np.cumsum(random.uniform(0.2, 2, 6))
    found, error = dips(sides(times, *functions))
    expected = [[least(f, a, b) for f in functions] for a, b in pairwise(times)]
    size = np.max(np.abs(sides(times, *functions).value))
    np.testing.assert_allclose(found, expected, atol=1e-10 * size)
    np.testing.assert_allclose(error, 0, atol=1e-12 * size)


def test_a_cubic_whose_third_power_all_but_vanishes():
    """The textbook formula of its turning point divides by that coefficient."""
    f = Polynomial([1.0, -4.0, 4.0, 1e-14])
    assert dips(sides([0, 1], f))[0][0, 0] == pytest.approx(0.0, abs=1e-13)


def test_the_error_is_a_quarter_of_that_over_two_intervals_and_no_less_than_the_true_one():
    """Of t^4 a cubic over the length h is off by h^4 / 16, hence h^4 over two."""
    h = 0.25
    error = dips(sides(np.arange(6) * h, Polynomial([0, 0, 0, 0, 1.0])))[1]
    np.testing.assert_allclose(error, h**4 / 4, rtol=1e-10)
    assert np.all(error >= h**4 / 16)


def test_two_times_tell_nothing_of_the_error():
    assert np.isinf(dips(sides([0, 1], Polynomial([1.0])))[1]).all()


def test_levels():
    """From above the side is 0; from below, as after an impact, somewhat less until it has risen."""
    value = np.array([[1.0, -0.1, 0.0], [-1.0, 0.2, -0.3], [2.0, -0.1, -0.1]])
    found = levels(Sides(np.arange(3.0), value, np.zeros((3, 3))), np.array([0.01, 0.02, 0.03]))
    np.testing.assert_allclose(found, [[0, -0.12, -0.03], [0, 0, -0.03], [0, 0, -0.03]])


@pytest.mark.parametrize("place", [1e-9, 0.1, 0.5, 1 - 1e-9])
@pytest.mark.parametrize("other", [-3.0, 4.0])
def test_root_of_a_cubic(place, other):
    a, b = 2.0, 5.0
    f = Polynomial.fromroots([a + place * (b - a), other * (b - a), other * (b - a) + 1])
    f = f * np.sign(f(a))
    found = root((a, b), (f(a), f(b)), (f.deriv()(a), f.deriv()(b)))
    assert found == pytest.approx(a + place * (b - a), rel=1e-13)


@pytest.mark.parametrize("seed", range(200))
def test_a_root_is_one_of_the_cubic(seed):
    """Of values and rates of very different sizes."""
    random = np.random.default_rng(seed)
    a, b = 10.0 ** random.uniform([-9, -12], 3) * [1, -1]
    da, db = random.standard_normal(2) * 10.0 ** random.uniform(-6, 4, 2)
    s = root((0.0, 1.0), (a, b), (da, db))
    c3, c2 = coefficients(a, b, da, db)
    terms = np.array([c3 * s**3, c2 * s**2, da * s, a])
    slope = abs(3 * c3 * s**2) + abs(2 * c2 * s) + abs(da)
    assert 0 < s <= 1
    assert abs(terms.sum()) <= 4e-16 * (np.abs(terms).sum() + slope)


def test_a_value_that_is_still_not_below_leaves_at_the_end():
    assert root((0.0, 2.0), (1.0, 0.0), (-1.0, -1.0)) == 2.0
