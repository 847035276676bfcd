import numpy as np
import pytest
from scipy.integrate import solve_ivp

from tests.reference import oscillators

TIMES = np.linspace(0, 5, 26)


@pytest.mark.parametrize("damping", [0.0, 1.0, 2 * np.sqrt(2.0 * 50.0), 40.0])
def test_one_mass_against_integration(damping):
    def derivative(_, state):
        return [state[1], (3.0 - damping * state[1] - 50.0 * state[0]) / 2.0]

    y = solve_ivp(derivative, (0, 5), [0.1, -0.4], "DOP853", TIMES, rtol=1e-12, atol=1e-13).y
    np.testing.assert_allclose(oscillators.spring_mass_damper(TIMES, 2, 50, damping, 0.1, -0.4, 3), y, atol=1e-10)


def test_overdamped_at_great_times_is_at_rest():
    x, v = oscillators.spring_mass_damper([1e5], 1.0, 1.0, 1e3, 1.0, 0.0, 2.0)
    assert (x[0], v[0]) == pytest.approx((2.0, 0.0), abs=1e-12)


def test_equal_chain_between_walls_has_its_known_frequencies():
    # w_j = 2 sqrt(k/m) sin(j pi / (2 (n + 1))).
    frequencies, _ = oscillators.chain_frequencies([0.5] * 6, [200.0] * 7)
    expected = 2 * np.sqrt(400) * np.sin(np.arange(1, 7) * np.pi / 14)
    np.testing.assert_allclose(frequencies, expected, rtol=1e-12)


def test_chain_response_is_the_sum_of_modes():
    masses, stiffnesses, x0, v0 = [1.0, 2.0, 0.5], [0.0, 30.0, 50.0, 20.0], [0.1, 0.0, -0.2], [0.0, 1.0, 0.0]
    frequencies, modes = oscillators.chain_frequencies(masses, stiffnesses)
    x_modal, v_modal = modes.T @ (np.array(masses) * x0), modes.T @ (np.array(masses) * v0)
    angle = np.outer(TIMES, frequencies)
    expected = (np.cos(angle) * x_modal + np.sin(angle) * v_modal / frequencies) @ modes.T
    x, _ = oscillators.chain_response(TIMES, masses, stiffnesses, [0.0] * 4, x0, v0)
    np.testing.assert_allclose(x, expected, atol=1e-11)


def test_one_mass_chain_is_the_closed_form():
    chain = oscillators.chain_response(TIMES, [2.0], [20.0, 30.0], [15.0, 5.0], [0.1], [-0.4], [3.0])
    exact = oscillators.spring_mass_damper(TIMES, 2.0, 50.0, 20.0, 0.1, -0.4, 3.0)
    np.testing.assert_allclose([c[:, 0] for c in chain], exact, atol=1e-12)


def test_free_torsional_chain_with_torque():
    inertias, torque = np.array([0.2, 0.1, 0.3]), 0.6
    chain = ([0.0, 50.0, 80.0, 0.0], [0.0, 0.5, 0.2, 0.0])
    _, rates = oscillators.chain_response(TIMES, inertias, *chain, np.zeros(3), np.zeros(3), [torque, 0.0, 0.0])
    # The torque is the only one from outside: momentum = torque t.
    np.testing.assert_allclose(rates @ inertias, torque * TIMES, atol=1e-10)
    # In the long run all turn with the same acceleration, and each spring carries what the rest needs.
    late, _ = oscillators.chain_response([100.0], inertias, *chain, np.zeros(3), np.zeros(3), [torque, 0.0, 0.0])
    acceleration = torque / inertias.sum()
    twist = late[0, :-1] - late[0, 1:]
    np.testing.assert_allclose(twist, acceleration * np.array([0.4 / 50.0, 0.3 / 80.0]), atol=1e-9)
