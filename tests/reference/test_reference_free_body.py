import numpy as np
import pytest
from scipy.integrate import solve_ivp
from scipy.spatial.transform import Rotation

from tests.reference import free_body

INERTIA = np.array([1.0, 2.0, 3.5])
TIMES = np.linspace(0, 30, 61)


def test_rotation_matrix_is_that_of_scipy():
    q = np.array([0.3, -0.5, 0.7, 0.2])
    np.testing.assert_allclose(free_body.rotation_matrix(q), Rotation.from_quat(np.roll(q, -1)).as_matrix(), atol=1e-15)


@pytest.mark.parametrize("start", [(0.5, 2.0), (2.0, 0.5), (-0.5, 2.0), (2.0, -0.5), (-1.0, -3.0), (-3.0, 0.1)])
def test_elliptic_functions_against_integration(start):
    w, _ = free_body.torque_free(INERTIA, [start[0], 0, start[1]], TIMES)
    np.testing.assert_allclose(free_body.torque_free_rate(INERTIA, *start, TIMES), w, atol=2e-9)


def test_momentum_and_energy_are_kept():
    w, q = free_body.torque_free(INERTIA, [0.1, 3.0, 0.1], TIMES, [0.5, 0.5, -0.5, 0.5])
    momenta = np.array([free_body.rotation_matrix(qi) @ (INERTIA * wi) for qi, wi in zip(q, w, strict=True)])
    np.testing.assert_allclose(momenta, np.tile(momenta[0], (len(TIMES), 1)), atol=1e-9)
    np.testing.assert_allclose(w**2 @ INERTIA, w[0] ** 2 @ INERTIA, atol=1e-9)
    np.testing.assert_allclose(np.linalg.norm(q, axis=1), 1, atol=1e-9)


def test_orientation_of_a_symmetric_body():
    # Regular precession: turn about the momentum at L / I1, and about the own axis at w3 (1 - I3 / I1).
    inertia, w0 = np.array([1.0, 1.0, 1.7]), np.array([0.4, 0.3, 2.0])
    _, q = free_body.torque_free(inertia, w0, TIMES)
    for t, qi in zip(TIMES, q, strict=True):
        own = Rotation.from_rotvec([0, 0, w0[2] * (1 - 1.7) * t])
        exact = (Rotation.from_rotvec(inertia * w0 / 1.0 * t) * own).as_matrix()
        np.testing.assert_allclose(free_body.rotation_matrix(qi), exact, atol=1e-9)


TOP = (0.05, 0.02, 1.3)  # transverse, axial, weight moment


def test_heavy_top_against_newton_euler():
    start, spin, times = (0.6, 0.3, 1.2), 60.0, np.linspace(0, 2, 41)
    states = free_body.heavy_top(*TOP, start, spin, times)
    axis = free_body.top_axis(states[:, 0], states[:, 1])
    theta, theta_rate, precession = start
    node = np.array([0.0, 0.0, -1.0])  # turning about it increases theta at precession 0
    w0 = np.array([0, precession, 0]) + theta_rate * node
    w0 += (spin - precession * np.cos(theta)) * axis[0]

    def derivative(_, state):
        # Inertial axes: momentum L = transverse w + (axial - transverse) spin e, e' = w x e, L' = e x (0, -mgd, 0).
        e, L = state[:3], state[3:]
        w = (L - (TOP[1] - TOP[0]) * (L @ e) / TOP[1] * e) / TOP[0]
        return np.concatenate([np.cross(w, e), np.cross(e, [0, -TOP[2], 0])])

    first = np.concatenate([axis[0], TOP[0] * w0 + (TOP[1] - TOP[0]) * spin * axis[0]])
    y = solve_ivp(derivative, (0, 2), first, "DOP853", times, rtol=1e-12, atol=1e-13).y
    np.testing.assert_allclose(axis, y[:3].T, atol=1e-9)


def test_heavy_top_keeps_its_energy():
    states = free_body.heavy_top(*TOP, (0.6, 0.3, 1.2), 60.0, np.linspace(0, 2, 41))
    theta, _, _, theta_rate, precession, rotation = states.T
    spin = rotation + precession * np.cos(theta)
    np.testing.assert_allclose(spin, 60.0, atol=1e-9)
    transverse = theta_rate**2 + (precession * np.sin(theta)) ** 2
    energy = (TOP[0] * transverse + TOP[1] * spin**2) / 2 + TOP[2] * np.cos(theta)
    np.testing.assert_allclose(energy, energy[0], rtol=1e-10)


@pytest.mark.parametrize("fast", [False, True])
@pytest.mark.parametrize("spin", [60.0, -60.0])
def test_steady_precession_has_no_nutation(fast, spin):
    rate = free_body.steady_precession(*TOP, 0.6, spin)[fast]
    times = np.linspace(0, 1, 11)
    states = free_body.heavy_top(*TOP, (0.6, 0.0, rate), spin, times)
    np.testing.assert_allclose(states[:, 0], 0.6, atol=1e-10)
    np.testing.assert_allclose(states[:, 1], rate * times, atol=1e-8)


def test_slow_precession_of_a_fast_top():
    assert free_body.steady_precession(*TOP, 0.6, 1e4)[0] == pytest.approx(TOP[2] / (TOP[1] * 1e4), rel=1e-5)
