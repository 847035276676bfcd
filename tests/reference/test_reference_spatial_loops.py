import numpy as np
import pytest

from tests.reference import bricard, double_pendulum, four_bar_spatial
from tests.reference.four_bar import FourBar
from tests.reference.spatial_loop import Joint, Loop, Rod


@pytest.fixture(scope="module")
def fall():
    return bricard.loop().simulate(np.linspace(0, 10, 21))


def test_bricard_published_positions(fall):
    mechanism = bricard.loop()
    at = {k: mechanism.point(fall[k], 1, bricard.POINTS[2]) for k in (0, 2, 20)}
    assert at[0] == pytest.approx((1, -1, 0), abs=1e-15)
    assert at[2] == pytest.approx((0.274481319, -0.886707939, -0.462330003), abs=1e-9)
    assert at[20] == pytest.approx((0.999730987, -0.999999964, -0.000268976), abs=1e-8)


def test_bricard_stays_closed_and_keeps_its_energy(fall):
    mechanism = bricard.loop()
    energy = [mechanism.energy(state) for state in fall]
    np.testing.assert_allclose(energy, energy[0], atol=1e-8)
    assert max(mechanism.gap(state) for state in fall) < 1e-9


def test_bricard_has_one_freedom_and_one_redundant_constraint():
    mechanism, zero = bricard.loop(), np.zeros(6)
    values = np.linalg.svd(mechanism.dynamics(zero, zero)[2], compute_uv=False)
    assert values[4] > 0.1
    assert values[5] < 1e-15


def test_spatial_four_bar_published_motion():
    """Published within 1e-3; the angle lies 3e-5 off, the angular velocity 1.2e-4."""
    end = four_bar_spatial.simulate([0.0, 1.0])[1]
    assert end == pytest.approx((7.802134, 9.361588), abs=2e-4)


@pytest.mark.slow
def test_spatial_four_bar_stays_closed_and_keeps_its_energy():
    mechanism = four_bar_spatial.loop()
    states = mechanism.simulate(np.linspace(0, 2.5, 11), mechanism.rates(0, 5.235987756))
    energy = [mechanism.energy(state) for state in states]
    np.testing.assert_allclose(energy, energy[0], atol=1e-8)
    assert max(mechanism.gap(state) for state in states) < 1e-9


@pytest.mark.slow
def test_planar_four_bar_as_a_spatial_loop():
    """Three constraints are redundant; the motion is that of one coordinate."""
    machine = FourBar(damping=0.0)
    pins = [0, machine.crank, machine.crank + machine.coupler, machine.ground]
    points = np.array([[np.real(pin), np.imag(pin), 0.0] for pin in pins])
    m, I = machine.masses()
    ends = zip(points[:-1], points[1:], m, I, strict=True)
    rods = [Rod.between(a, b, mass, inertia, inertia) for a, b, mass, inertia in ends]
    loop = Loop([Joint((0, 0, 1), point) for point in points], rods, (0, -machine.gravity, 0))
    times = np.linspace(0, 2, 5)
    expected = machine.simulate(times)
    np.testing.assert_allclose(loop.simulate(times)[:, [0, 4]], expected, atol=1e-8)


def test_open_chain_is_a_double_pendulum():
    """Six more joints without mass behind the second rod leave it free."""
    rods = [Rod.between((0, 0, 0), (1, 0, 0), 1.0, 1 / 12, 0.0), Rod.between((1, 0, 0), (2, 0, 0), 1.0, 1 / 12, 0.0)]
    joints = [Joint((0, 0, 1)), Joint((0, 0, 1), (1, 0, 0))]
    joints += [Joint(axis, slides=True) for axis in np.eye(3)] + [Joint(axis) for axis in np.eye(3)]
    chain = Loop(joints, [*rods, *[Rod()] * 5], (0, -9.81, 0))
    times = np.linspace(0, 0.5, 3)
    q = chain.simulate(times)
    uniform = double_pendulum.Rod.uniform(1.0, 1.0)
    expected = double_pendulum.simulate(uniform, uniform, [0, 0], [0, 0], times)
    np.testing.assert_allclose(np.column_stack([q[:, 0], q[:, 0] + q[:, 1]]), expected[:, :2], atol=1e-8)
