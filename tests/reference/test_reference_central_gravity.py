import numpy as np
import pytest
from scipy.integrate import solve_ivp

from tests.reference.central_gravity import orbit, orbit_period

R0, MU = np.array([1.0, 0.2, -0.1]), 1.7


@pytest.mark.parametrize("velocity", [(0.1, 1.2, 0.3), (-0.5, 0.2, 0.1), (0.3, 0.05, 1.6)])
def test_against_integration(velocity):
    times = np.linspace(0, 10, 21)

    def derivative(_, state):
        return np.concatenate([state[3:], -MU * state[:3] / np.linalg.norm(state[:3]) ** 3])

    y = solve_ivp(derivative, (0, 10), [*R0, *velocity], "DOP853", times, rtol=1e-13, atol=1e-14).y.T
    position, speed = orbit(R0, velocity, MU, times)
    np.testing.assert_allclose(position, y[:, :3], atol=1e-8)
    np.testing.assert_allclose(speed, y[:, 3:], atol=1e-7)


def test_circle():
    times = np.linspace(0, 20, 11)
    position, _ = orbit([2.0, 0, 0], [0, 1.0, 0], 2.0, times)
    exact = 2 * np.column_stack([np.cos(times / 2), np.sin(times / 2), 0 * times])
    np.testing.assert_allclose(position, exact, atol=1e-13)


def test_period_energy_and_angular_momentum():
    v0 = np.array([0.1, 0.2, 0.05])  # a narrow ellipse, eccentricity 0.96
    duration = orbit_period(R0, v0, MU)
    position, velocity = orbit(R0, v0, MU, np.linspace(0, 100.25, 402) * duration)
    np.testing.assert_allclose(position[4], R0, atol=1e-11)
    momentum = np.cross(position, velocity)
    np.testing.assert_allclose(momentum, np.tile(momentum[0], (402, 1)), atol=1e-11)
    energy = (velocity**2).sum(axis=1) / 2 - MU / np.linalg.norm(position, axis=1)
    np.testing.assert_allclose(energy, energy[0], atol=1e-10)


def test_hyperbola_is_refused():
    with pytest.raises(ValueError, match="not an ellipse"):
        orbit(R0, [0, 5.0, 0], MU, [1.0])
