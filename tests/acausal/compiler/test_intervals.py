"""Bounds of functions of time hold every value between, and are the value where the interval is a point."""

from __future__ import annotations

import casadi as ca
import numpy as np
import pytest

from acausal.compiler.intervals import bounded, bounds

T, P = ca.SX.sym("t"), ca.SX.sym("p")
LAWS = [
    (T - P) ** 2 - 1,
    T**3 - P * T,
    ca.sin(3 * T) * ca.cos(T / P),
    ca.tan(T),
    ca.exp(-(T**2)) - ca.log(T**2 + P),
    ca.sqrt(T**2 + 1) / (T + P),
    1 / T,
    T**-2,
    (T**2 + 0.1) ** P,
    ca.fabs(T) - ca.fmin(T, P) + ca.fmax(-T, 1),
    ca.atan2(ca.sin(T), T - P),
    ca.atan(T) + ca.asin(ca.sin(T)) + ca.acos(ca.cos(T)),
    ca.tanh(T) + ca.sinh(T) + ca.cosh(T),
    ca.floor(T) + ca.ceil(P * T) + ca.sign(T),
    ca.if_else(T > P, T, ca.if_else(ca.logic_and(T > 0, T <= 0.5), -1, 2 * T)),
    ca.if_else(ca.logic_or(ca.eq(T, 0), ca.logic_not(T < P)), 3, T),
]


@pytest.mark.parametrize("law", LAWS, ids=str)
def test_bounds_hold_every_value(law):
    function = ca.Function("f", [P, T], [law])
    random, p = np.random.default_rng(0), np.array([1.25])
    assert bounded(function)
    low = random.uniform(-4, 4, 300)
    high = low + 10 ** random.uniform(-6, 0.7, 300)
    least, most = bounds(function, p, low, high)[0]
    for a, b, lower, upper in zip(low, high, least, most, strict=True):
        t = np.linspace(a, b, 50)
        values = np.array(function.map(50)(np.tile(p, (1, 50)), t[None])).ravel()
        assert np.all((values >= lower) & (values <= upper))
    points = bounds(function, p, low, low)[0]
    exact = np.array(function.map(300)(np.tile(p, (1, 300)), low[None])).ravel()
    np.testing.assert_allclose(points[0], exact, rtol=1e-12, atol=1e-12)
    np.testing.assert_array_equal(*points)


def test_short_intervals_have_narrow_bounds():
    function = ca.Function("f", [P, T], [ca.sin(T) * ca.exp(T) - T**2])
    (least, most), _ = bounds(function, np.ones(1), np.array([1.0]), np.array([1 + 1e-9]))
    assert most[0] - least[0] < 2e-8


def test_what_jumps_is_told():
    function = ca.Function("f", [P, T], [ca.floor(T)])
    assert bounds(function, np.ones(1), np.array([0.2, 0.9]), np.array([0.8, 1.1]))[1].tolist() == [False, True]
