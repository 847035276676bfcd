import mpmath
import numpy as np
import pytest
from scipy.integrate import solve_ivp

from tests.reference import pendulum


def test_check_values():
    assert pendulum.period() == pytest.approx(2.367841947576237, abs=1e-14)
    x, y = pendulum.position([0.0, 1.0, 10.0])
    np.testing.assert_allclose(x, [1.0, -0.98629175113, 0.27508746258], atol=1e-11)
    np.testing.assert_allclose(y, [0.0, -0.16501085313, -0.96141920510], atol=1e-11)


@pytest.mark.parametrize("amplitude", [np.pi / 2, -0.3, 3.1])
def test_long_times_with_many_digits(amplitude):
    times = np.array([0.7, 123.456, 1999.9])
    angle, rate = pendulum.motion(times, 0.8, 9.81, amplitude)
    with mpmath.workdps(40):
        k, w0 = mpmath.sin(mpmath.mpf(amplitude) / 2), mpmath.sqrt(mpmath.mpf(9.81) / mpmath.mpf(0.8))
        exact = [2 * mpmath.asin(k * mpmath.ellipfun("cd", w0 * mpmath.mpf(t), m=k**2)) for t in times]
    np.testing.assert_allclose(angle, np.array(exact, dtype=float), atol=1e-10)
    energy = (0.8 * rate) ** 2 / 2 - 9.81 * 0.8 * np.cos(angle)
    np.testing.assert_allclose(energy, -9.81 * 0.8 * np.cos(amplitude), atol=1e-10)


def test_physical_pendulum_against_integration():
    mass, distance, inertia, times = 2.0, 0.3, 0.5, np.linspace(0, 10, 21)

    def derivative(_, state):
        return [state[1], -mass * 9.81 * distance * np.sin(state[0]) / (inertia + mass * distance**2)]

    angle = solve_ivp(derivative, (0, 10), [np.pi / 2, 0], "DOP853", times, rtol=1e-12, atol=1e-13).y[0]
    x, y = pendulum.physical_position(times, mass, distance, inertia)
    np.testing.assert_allclose(x, distance * np.sin(angle), atol=1e-10)
    np.testing.assert_allclose(y, -distance * np.cos(angle), atol=1e-10)
