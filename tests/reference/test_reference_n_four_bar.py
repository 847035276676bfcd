import numpy as np
import pytest
from scipy.special import ellipj, ellipk

from tests.reference.n_four_bar import inertia_and_moment, motion, upper_end


def test_published_position():
    x, y = upper_end([0.0, 10.0])
    assert (x[1], y[1]) == pytest.approx((0.328458111538, 0.944518538179), abs=1e-11)
    assert (x[0], y[0]) == pytest.approx((0.0, 1.0), abs=1e-15)


@pytest.mark.parametrize("N", [1, 2, 10, 40])
def test_energy_is_that_of_all_rods(N):
    """Summed rod by rod from the velocities of their middle points."""
    th, w = motion(np.linspace(0, 10, 101), N)
    uprights = (N + 1) * ((0.25 + 1 / 12) * w**2 / 2 + 9.81 * np.sin(th) / 2)
    couplers = N * (w**2 / 2 + 9.81 * np.sin(th))
    np.testing.assert_allclose(uprights + couplers, (uprights + couplers)[0], rtol=1e-11)
    assert (np.diff(th) < 0).all()


def test_many_four_bars_swing_alike():
    """Factors over N approach 4/3 and 3/2."""
    inertia, moment = inertia_and_moment(10**6)
    assert inertia / moment == pytest.approx(8 / 9, rel=1e-6)


@pytest.mark.parametrize("N", [1, 2, 5])
def test_against_the_elliptic_amplitude(N):
    """It turns over: half the angle from the lowest position is am(K - Omega t)."""
    inertia, moment = inertia_and_moment(N)
    times = np.linspace(0, 10, 101)
    square = 0.25 + 9.81 * moment / inertia
    m = 1 - 0.25 / square
    *_, half = ellipj(ellipk(m) - np.sqrt(square) * times, m)
    np.testing.assert_allclose(motion(times, N)[0], 2 * half - np.pi / 2, atol=1e-10)
