import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from tests.reference import cantilever, floating_beam

LENGTH, RHO_A, TORSION = 1.4, 3.1, 0.07
BEAM = (LENGTH, RHO_A)


def smooth_motion(elements, root_moves, seed=3):
    """Frame velocities v(t), w(t) and nodal q(t), on frame axes, each with its derivatives."""
    rng = np.random.default_rng(seed)
    n = 6 * (elements + 1)
    amplitude, rate, phase = rng.normal(size=n) * 0.2, rng.uniform(1, 3, n), rng.uniform(0, 6, n)
    if not root_moves:
        amplitude[:6] = 0
    frame = rng.normal(size=(3, 6)), rng.uniform(1, 3, 6)

    def velocities(t):
        phases = frame[1] * t
        return (frame[0][0] * np.sin(phases) + frame[0][1] * np.cos(phases) + frame[0][2]).reshape(2, 3)

    def rates(t):
        phases = frame[1] * t
        return (frame[1] * (frame[0][0] * np.cos(phases) - frame[0][1] * np.sin(phases))).reshape(2, 3)

    def nodal(t):
        s, c = np.sin(rate * t + phase), np.cos(rate * t + phase)
        return amplitude * s, amplitude * rate * c, -amplitude * rate**2 * s

    return velocities, rates, nodal


def slope(function, t, step=1e-3):
    """Derivative by central differences of sixth order."""
    values = [np.asarray(function(t + i * step)) for i in (-3, -2, -1, 1, 2, 3)]
    return np.tensordot([-1, 9, -45, 45, -9, 1], values, 1) / (60 * step)


@pytest.mark.parametrize("elements", [1, 2, 5])
@pytest.mark.parametrize("root_moves", [False, True])
@pytest.mark.parametrize("t", [0.3, 1.1])
def test_power_momentum_and_angular_momentum_along_a_motion(elements, root_moves, t):
    velocities, rates, nodal = smooth_motion(elements, root_moves)
    (v, w), (v_rate, z), (q, qd, qdd) = velocities(t), rates(t), nodal(t)
    a = v_rate + np.cross(w, v)  # v on turning axes
    force, moment, forces = floating_beam.inertia_forces(*BEAM, elements, q, qd, qdd, a, z, w, np.zeros(3), TORSION)

    def state(s):
        return (*BEAM, elements, *nodal(s)[:2], *velocities(s), TORSION)

    power = slope(lambda s: floating_beam.kinetic_energy(*state(s)), t)
    assert force @ v + moment @ w + forces @ qd == pytest.approx(power, rel=1e-8)
    momentum, angular = floating_beam.momenta(*state(t))
    p_rate, L_rate = (slope(lambda s, i=i: floating_beam.momenta(*state(s))[i], t) for i in (0, 1))
    np.testing.assert_allclose(force, p_rate + np.cross(w, momentum), rtol=1e-8)
    np.testing.assert_allclose(moment, L_rate + np.cross(w, angular) + np.cross(v, momentum), rtol=1e-8)


def test_nodal_forces_are_those_of_lagrange():
    elements, t = 3, 0.7
    velocities, rates, nodal = smooth_motion(elements, root_moves=True)
    (v, w), (v_rate, z), (q, qd, qdd) = velocities(t), rates(t), nodal(t)

    def energy(q, qd, s):
        return floating_beam.kinetic_energy(*BEAM, elements, q, qd, *velocities(s), TORSION)

    expected = [
        slope(lambda s, d=d: slope(lambda e: energy(nodal(s)[0], nodal(s)[1] + e * d, s), 0.0), t)
        - slope(lambda e, d=d: energy(q + e * d, qd, t), 0.0)
        for d in np.eye(len(q))
    ]
    a = v_rate + np.cross(w, v)
    _, _, forces = floating_beam.inertia_forces(*BEAM, elements, q, qd, qdd, a, z, w, np.zeros(3), TORSION)
    np.testing.assert_allclose(forces, expected, atol=1e-7)


def test_point_accelerations_against_positions_in_space():
    """Force on the whole beam from second differences of inertial positions, no formula of relative motion."""
    elements, spin, step = 2, np.array([0.5, -1.2, 0.8]), 1e-3
    rng = np.random.default_rng(5)
    c0, c1, c2 = rng.normal(size=(3, 18)) * 0.1
    origin = rng.normal(size=3)

    def centre(t):
        # R(t) = R(spin t): constant angular velocity; the origin runs along a parabola.
        q, turn = c0 + c1 * t + c2 * t**2 / 2, Rotation.from_rotvec(spin * t)
        momentum, _ = floating_beam.momenta(*BEAM, elements, np.zeros(18), q, np.zeros(3), np.zeros(3))
        rest, _ = floating_beam.momenta(*BEAM, elements, np.zeros(18), np.zeros(18), [0.5, 0, 0], np.zeros(3))
        mass_position = momentum + rest * LENGTH  # sum of dm u: S q stands for u in the momentum of qd = q
        return turn.apply(mass_position) + BEAM[0] * BEAM[1] * origin * t**2 / 2

    second = (centre(step) - 2 * centre(0.0) + centre(-step)) / step**2
    force, _, _ = floating_beam.inertia_forces(*BEAM, elements, c0, c1, c2, origin, np.zeros(3), spin, np.zeros(3))
    np.testing.assert_allclose(force, second, rtol=1e-4, atol=1e-5)


def test_rigid_limit_is_newton_euler_of_a_rod():
    rng = np.random.default_rng(1)
    a, z, w, g = rng.normal(size=(4, 3))
    mass, centre, still = RHO_A * LENGTH, np.array([LENGTH / 2, 0, 0]), np.zeros(24)
    inertia = np.diag([TORSION, mass * LENGTH**2 / 3, mass * LENGTH**2 / 3])
    force, moment, _ = floating_beam.inertia_forces(*BEAM, 3, still, still, still, a, z, w, g, TORSION)
    np.testing.assert_allclose(force, mass * (a - g + np.cross(z, centre) + np.cross(w, np.cross(w, centre))))
    expected = inertia @ z + np.cross(w, inertia @ w) + mass * np.cross(centre, a - g)
    np.testing.assert_allclose(moment, expected, atol=1e-14)
    v, w = rng.normal(size=(2, 3))
    energy = floating_beam.kinetic_energy(*BEAM, 3, still, still, v, w, TORSION)
    assert energy == pytest.approx(mass * v @ v / 2 + mass * v @ np.cross(w, centre) + w @ inertia @ w / 2)


STIFFNESS = 700.0, 40.0, 90.0, 15.0  # EA, EJ_z, EJ_y, GJ_t


@pytest.mark.parametrize("elements", [1, 4])
def test_frame_fixed_beam_has_the_textbook_matrices(elements):
    n = 6 * (elements + 1)
    zero, still = np.zeros(3), np.zeros(n)
    M = [
        floating_beam.inertia_forces(*BEAM, elements, still, still, e, *[zero] * 4, torsional_inertia=TORSION)[2]
        for e in np.eye(n)
    ]
    M, K = np.array(M), np.array([floating_beam.stiffness_forces(LENGTH, STIFFNESS, elements, e) for e in np.eye(n)])
    groups = [[i for i in range(6, n) if i % 6 in kinds] for kinds in ((0,), (1, 2), (3, 4), (5,))]
    for group, EJ in zip(groups[1:3], STIFFNESS[1:3], strict=True):
        mass, stiffness = cantilever.bending_matrices(LENGTH, RHO_A, EJ, elements)
        np.testing.assert_allclose(M[np.ix_(group, group)], mass, atol=1e-13)
        np.testing.assert_allclose(K[np.ix_(group, group)], stiffness, atol=1e-9)
    h = LENGTH / elements
    for k, per_length, stiff in ((0, RHO_A, STIFFNESS[0]), (5, TORSION / LENGTH, STIFFNESS[3])):
        np.testing.assert_allclose(K[k, [k, 6 + k]], [stiff / h, -stiff / h])
        np.testing.assert_allclose(M[k, [k, 6 + k]], [per_length * h / 3, per_length * h / 6])
    for one in groups:
        rest = [i for i in range(6, n) if i not in one]
        assert np.abs(K[np.ix_(one, rest)]).max() == np.abs(M[np.ix_(one, rest)]).max() == 0


@pytest.mark.parametrize("elements", [1, 4])
def test_micro_energy_is_half_of_lumped_less_consistent(elements):
    n = 6 * (elements + 1)
    qd, still, zero = np.random.default_rng(7).normal(size=n), np.zeros(n), np.zeros(3)
    qd[[i for i in range(n) if i % 6 not in (0, 5)]] = 0
    consistent = floating_beam.kinetic_energy(*BEAM, elements, still, qd, zero, zero, TORSION)
    ends = np.ones(elements + 1)
    ends[[0, -1]] = 1 / 2
    rates = qd.reshape(-1, 6)
    lumped = ends @ (RHO_A * LENGTH * rates[:, 0] ** 2 + TORSION * rates[:, 5] ** 2) / (2 * elements)
    found = floating_beam.micro_energy(*BEAM, elements, qd, TORSION)
    assert found == pytest.approx((lumped - consistent) / 2)


def test_rigid_displacements_cost_no_elastic_energy_and_stiffness_is_its_gradient():
    elements = 3
    nodes, one = np.linspace(0, LENGTH, 4), np.ones(4)
    rigid = np.column_stack([0.2 * one, 0.1 + 0.3 * nodes, 0.3 * one, 0.4 - 0.5 * nodes, -0.5 * one, 0.6 * one]).ravel()
    np.testing.assert_allclose(floating_beam.stiffness_forces(LENGTH, STIFFNESS, elements, rigid), 0, atol=1e-11)
    q = np.random.default_rng(2).normal(size=24)
    gradient = [
        slope(lambda e, d=d: floating_beam.elastic_energy(LENGTH, STIFFNESS, elements, q + e * d), 0.0)
        for d in np.eye(24)
    ]
    np.testing.assert_allclose(floating_beam.stiffness_forces(LENGTH, STIFFNESS, elements, q), gradient, rtol=1e-7)


def test_shape_interpolates_the_nodes():
    q = np.random.default_rng(4).normal(size=24)
    for i, x in enumerate(np.linspace(0, LENGTH, 4)):
        np.testing.assert_allclose(floating_beam.shape(LENGTH, 3, x) @ q, q[6 * i + np.array([0, 1, 3])], atol=1e-12)
    rotation = slope(lambda x: floating_beam.shape(LENGTH, 3, x, 0) @ q, 0.0)[1:]
    assert rotation == pytest.approx(q[[2, 4]])
    rows = np.random.default_rng(5).normal(size=(2, 3, 6))
    np.testing.assert_array_equal(
        floating_beam.nodal(rows)[1, 6:12], rows[1, 1, [0, 1, 5, 2, 4, 3]] * [1, 1, 1, 1, -1, 1]
    )


def test_gravity_is_an_acceleration_upwards():
    rng = np.random.default_rng(6)
    q, qd, qdd = rng.normal(size=(3, 18))
    a, z, w, g = rng.normal(size=(4, 3))
    weighed = floating_beam.inertia_forces(*BEAM, 2, q, qd, qdd, a, z, w, g)
    lifted = floating_beam.inertia_forces(*BEAM, 2, q, qd, qdd, a - g, z, w, np.zeros(3))
    for one, other in zip(weighed, lifted, strict=True):
        np.testing.assert_allclose(one, other, atol=1e-13)
