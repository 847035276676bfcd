import numpy as np
import pytest
from scipy.integrate import solve_ivp
from scipy.linalg import eigh

from tests.reference import pendulum
from tests.reference.double_pendulum import Rod, ends, energy, simulate

FIRST, SECOND = Rod(1.3, 0.8, 0.3, 0.11), Rod(0.7, 1.1, 0.75, 0.05)


def newton_euler(first, second, start, times, gravity=9.81):
    """The same motion in x, y, angle of each rod, with the forces in both joints as unknowns."""
    mass = np.diag([first.mass, first.mass, first.inertia, second.mass, second.mass, second.inertia])
    weight = -gravity * np.array([0, first.mass, 0, 0, second.mass, 0])

    def derivative(_, state):
        a1, a2, w1, w2 = state[[2, 5, 8, 11]]
        e1, e2 = np.array([np.cos(a1), np.sin(a1)]), np.array([np.cos(a2), np.sin(a2)])
        n1, n2 = np.array([-e1[1], e1[0]]), np.array([-e2[1], e2[0]])
        beyond = first.length - first.centre
        jacobian, curvature = np.zeros((4, 6)), np.zeros(4)
        jacobian[:2, :2], jacobian[:2, 2], curvature[:2] = np.eye(2), -first.centre * n1, first.centre * w1**2 * e1
        jacobian[2:, :2], jacobian[2:, 2] = np.eye(2), beyond * n1
        jacobian[2:, 3:5], jacobian[2:, 5] = -np.eye(2), second.centre * n2
        curvature[2:] = -beyond * w1**2 * e1 - second.centre * w2**2 * e2
        matrix = np.block([[mass, jacobian.T], [jacobian, np.zeros((4, 4))]])
        return np.concatenate([state[6:], np.linalg.solve(matrix, [*weight, *-curvature])[:6]])

    a1, a2, w1, w2 = start
    e1, e2 = np.array([np.cos(a1), np.sin(a1)]), np.array([np.cos(a2), np.sin(a2)])
    n1, n2 = np.array([-e1[1], e1[0]]), np.array([-e2[1], e2[0]])
    c1, c2 = first.centre * e1, first.length * e1 + second.centre * e2
    v1, v2 = first.centre * w1 * n1, first.length * w1 * n1 + second.centre * w2 * n2
    state = np.concatenate([c1, [a1], c2, [a2], v1, [w1], v2, [w2]])
    y = solve_ivp(derivative, times[[0, -1]], state, "DOP853", times, rtol=1e-12, atol=1e-13).y
    return y[[2, 5, 8, 11]].T


def test_against_newton_euler_with_joint_forces():
    times = np.linspace(0, 3, 13)
    start = [0.2, -0.9, 1.0, -2.0]
    states = simulate(FIRST, SECOND, start[:2], start[2:], times)
    np.testing.assert_allclose(states, newton_euler(FIRST, SECOND, start, times), atol=1e-8)


def test_energy_is_kept():
    states = simulate(FIRST, SECOND, [0.0, 0.5], [0.0, 0.0], np.linspace(0, 20, 101))
    np.testing.assert_allclose(energy(FIRST, SECOND, states), energy(FIRST, SECOND, states[:1])[0], atol=1e-9)


def test_without_second_mass_it_is_the_pendulum():
    first = Rod.uniform(2.0, 1.0)
    times = np.linspace(0, 5, 11)
    states = simulate(first, Rod(1e-14, 1.0, 0.0, 1e-14), [0, -np.pi / 2], [0, 0], times)
    x, y = pendulum.physical_position(times, 2.0, first.centre, first.inertia)
    elbow, _ = ends(first, SECOND, states)
    np.testing.assert_allclose(elbow / 2, np.column_stack([x, y]), atol=1e-9)


def test_small_oscillation_of_uniform_rods():
    # Equal uniform rods: mass matrix m L^2 [[4/3, 1/2], [1/2, 1/3]], stiffness m g L [[3/2, 0], [0, 1/2]].
    rod, size = Rod.uniform(1.0, 1.0), 1e-5
    squares, modes = eigh(9.81 * np.diag([1.5, 0.5]), np.array([[4 / 3, 0.5], [0.5, 1 / 3]]))
    times = np.linspace(0, 3, 7)
    states = simulate(rod, rod, -np.pi / 2 + size * modes[:, 0], [0, 0], times)
    expected = np.outer(np.cos(np.sqrt(squares[0]) * times), modes[:, 0])
    assert (states[:, :2] + np.pi / 2) / size == pytest.approx(expected, abs=1e-6)
