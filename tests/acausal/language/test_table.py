"""Tables: kinds against scipy, extrapolation, jumps, and errors."""

from __future__ import annotations

import pickle

import numpy as np
import pytest
from scipy import interpolate

from acausal import DeclarationError, Table

RANDOM = np.random.default_rng(1)
X, Y = np.cumsum(RANDOM.uniform(0.2, 1.5, 12)), RANDOM.normal(size=12)
U = np.linspace(X[0], X[-1], 500)
KINDS = ("constant", "linear", "akima", "modified_akima", "fritsch_butland", "steffen", "cubic")
SCIPY = {
    "linear": lambda: lambda u: np.interp(u, X, Y),
    "akima": lambda: interpolate.Akima1DInterpolator(X, Y),
    "modified_akima": lambda: interpolate.Akima1DInterpolator(X, Y, method="makima"),
    "cubic": lambda: interpolate.CubicSpline(X, Y, bc_type="natural"),
    "constant": lambda: lambda u: Y[np.searchsorted(X, u, side="right") - 1],
}


@pytest.mark.parametrize("kind", SCIPY)
def test_kinds_are_those_of_scipy(kind):
    np.testing.assert_allclose(Table(X, Y, kind)(U), SCIPY[kind]()(U), atol=1e-14)


def test_clamped_and_periodic_splines_are_those_of_scipy():
    closed = np.append(Y[:-1], Y[0])
    for ends, values in (("clamped", Y), ("periodic", closed)):
        expected = interpolate.CubicSpline(X, values, bc_type=ends)(U)
        np.testing.assert_allclose(Table(X, values, "cubic", ends=ends)(U), expected, atol=1e-14)


def test_fritsch_butland_is_pchip_inside():
    inside = U[(X[1] < U) & (X[-2] > U)]
    expected = interpolate.PchipInterpolator(X, Y)(inside)
    np.testing.assert_allclose(Table(X, Y, "fritsch_butland")(inside), expected, atol=1e-14)


def test_steffen_is_monotone_and_of_order_two():
    """Steffen 1990: no overshoot between points; the slope at a point is that of the parabola where this is monotone."""
    rising = np.cumsum(np.abs(Y))
    values = Table(X, rising, "steffen")(U)
    assert np.all(np.diff(values) >= -1e-14)
    x = np.linspace(1.0, 2.0, 9)
    table, h = Table(x, x**2, "steffen"), 1e-6
    slopes = (table(x[1:-1] + h) - table(x[1:-1] - h)) / (2 * h)
    np.testing.assert_allclose(slopes, 2 * x[1:-1], atol=1e-6)


@pytest.mark.parametrize("kind", KINDS)
def test_columns_are_tables_of_their_own(kind):
    several = Table(X, np.stack([Y, 2 * Y, Y**2], axis=1), kind)(U)
    np.testing.assert_allclose(several[:, 2], Table(X, Y**2, kind)(U), atol=1e-14)


def test_extrapolation():
    x, y = [0, 1, 3], [0, 2, 3]
    assert Table(x, y)([-1, 5]).tolist() == [0, 3]
    assert Table(x, y, extrapolation="linear")([-1, 5]).tolist() == [-2, 4]
    assert Table(x, y, extrapolation="periodic")([-1, 4, 7]).tolist() == Table(x, y)([2, 1, 1]).tolist()
    inside, outside = np.split(Table(x, y, extrapolation="refuse")([0, 3, 3 + 1e-13, -0.1, 3.1]), [3])
    assert np.isfinite(inside).all()
    assert np.isnan(outside).all()
    assert Table(x, y, "constant", "linear")(4) == 3.5
    smooth, h = Table(x, y, "akima", "linear"), 1e-6
    end = (smooth(3) - smooth(3 - h)) / h
    assert smooth(4) - smooth(3) == pytest.approx(end, abs=1e-5)


def test_jumps_hold_from_their_second_value():
    assert Table([0, 1, 1, 2], [0, 1, 5, 6])([0.5, 1, 1.5]).tolist() == [0.5, 5, 5.5]


def test_bilinear_surface_is_that_of_scipy():
    x, y = X[:6], X[:5] ** 2
    z = RANDOM.normal(size=(6, 5))
    a, b = np.meshgrid(np.linspace(x[0], x[-1], 31), np.linspace(y[0], y[-1], 17), indexing="ij")
    expected = interpolate.RegularGridInterpolator((x, y), z)((a, b))
    np.testing.assert_allclose(Table((x, y), z)(a, b), expected, atol=1e-13)
    assert Table((x, y), z)(x[-1] + 1, y[-1] + 1) == pytest.approx(z[-1, -1])


def test_akima_surface():
    """Akima 1974: exact for polynomials of degree 2, and of the curves along the lines of the grid."""
    x, y = np.linspace(0, 3, 7), np.linspace(0, 2, 6)
    a, b = np.meshgrid(np.linspace(0, 3, 40), np.linspace(0, 2, 40), indexing="ij")

    def f(x, y):
        return 1 + 2 * x - 3 * y + x * y + x * x - 2 * y * y

    np.testing.assert_allclose(Table((x, y), f(x[:, None], y), "akima")(a, b), f(a, b), atol=1e-13)
    z = RANDOM.normal(size=(7, 6))
    surface = Table((x, y), z, "akima")
    np.testing.assert_allclose(surface(x[:, None], y), z, atol=1e-14)
    np.testing.assert_allclose(surface(a[:, 0], y[2]), Table(x, z[:, 2], "akima")(a[:, 0]), atol=1e-13)
    np.testing.assert_allclose(surface(x[3], b[0]), Table(y, z[3], "akima")(b[0]), atol=1e-13)


def test_equal_tables():
    table = Table(X, Y, "akima")
    again = pickle.loads(pickle.dumps(table))
    assert again == table
    assert again.number != table.number
    assert table not in (Table(X, Y), Table(X, 2 * Y, "akima"))


@pytest.mark.parametrize(
    ("given", "message"),
    [
        (lambda: Table([0, 2, 1], [0, 1, 2]), "after 2 comes 1, in row 2"),
        (lambda: Table([0, 1, 1, 1], [0, 1, 2, 3]), "three points of a table are 1"),
        (lambda: Table([0, 1], [0, 1, 2]), r"its points have shape \(2,\), its values \(3,\)"),
        (lambda: Table([0, np.nan], [0, 1]), "finite numbers"),
        (lambda: Table([], []), "at least 1"),
        (lambda: Table([0, 1], ["a", 1]), "arrays of numbers"),
        (lambda: Table([0, 1], [0, 1], kind="akma"), "'akma'; it is one of constant, linear, akima"),
        (lambda: Table([0, 1], [0, 1], extrapolation="no"), "one of hold, linear, periodic, refuse"),
        (lambda: Table(([0, 1], [0, 1]), [[0, 1], [1, 2]], kind="cubic"), "one of constant, linear, akima"),
        (lambda: Table([0, 1, 2], [0, 1, 2], "cubic", ends="periodic"), "one value at both ends"),
    ],
)
def test_wrong_points_are_refused(given, message):
    with pytest.raises(DeclarationError, match=message):
        given()
