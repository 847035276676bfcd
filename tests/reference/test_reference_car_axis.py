import numpy as np
import pytest
from scipy.integrate import solve_ivp

from tests.reference.car_axis import L0, OMEGA, START, K, L, R, road, simulate, violation


def test_published_position():
    end = simulate([0.0, 3.0])[1, :4]
    published = (0.0493455784275403, 0.496989460230171, 1.04174252488542, 0.373911027265361)
    assert end == pytest.approx(published, abs=1e-10)


def test_constraints_hold():
    times = np.linspace(0, 3, 61)
    np.testing.assert_allclose(violation(times, simulate(times)), 0, atol=1e-10)


def test_start_is_that_of_the_test_set():
    (x, y), (xd, yd), _ = road(0.0)
    xl, yl, xr, yr, *rates = START
    assert xl * x + yl * y == 0
    assert xl * xd + yl * yd + rates[0] * x + rates[1] * y == 0
    assert np.hypot(xl - xr, yl - yr) == L


def test_against_minimal_coordinates():
    """The axle as a double slider: distance s along the normal of the road line, angle b of the axle."""

    def positions(t, s, b):
        alpha = np.arcsin(R / L * np.sin(OMEGA * t))
        left = s * np.array([-np.sin(alpha), np.cos(alpha)])
        return left, left + L * np.array([np.cos(b), np.sin(b)])

    def derivative(t, state):
        s, b, sd, bd = state
        alpha = np.arcsin(R / L * np.sin(OMEGA * t))
        rate = R / L * OMEGA * np.cos(OMEGA * t) / np.cos(alpha)
        bend = (rate**2 * np.sin(alpha) - R / L * OMEGA**2 * np.sin(OMEGA * t)) / np.cos(alpha)
        e, n = np.array([np.cos(alpha), np.sin(alpha)]), np.array([-np.sin(alpha), np.cos(alpha)])
        u, w = np.array([np.cos(b), np.sin(b)]), np.array([-np.sin(b), np.cos(b)])
        left, right = positions(t, s, b)
        a = -(2 * sd * rate + s * bend) * e - s * rate**2 * n
        forces = []
        for at, foot in ((left, np.zeros(2)), (right, L * e)):
            line = at - foot
            forces.append((L0 / np.linalg.norm(line) - 1) * line - [0, K])
        on_left, on_right = forces[0] - K * a, forces[1] - K * (a - L * bd**2 * u)
        matrix = K * np.array([[2, L * n @ w], [L * n @ w, L**2]])
        return [sd, bd, *np.linalg.solve(matrix, [n @ (on_left + on_right), L * w @ on_right])]

    times = np.linspace(0, 3, 31)
    y = solve_ivp(derivative, (0, 3), [0.5, 0, 0, 0], "DOP853", times, rtol=1e-12, atol=1e-14).y
    expected = np.array([np.concatenate(positions(t, s, b)) for t, s, b in zip(times, y[0], y[1], strict=True)])
    np.testing.assert_allclose(simulate(times)[:, :4], expected, atol=1e-9)
