import numpy as np
import pytest

from tests.reference.squeezer import START, energy, loops, simulate

PUBLISHED = {
    0: 15.81077119629904,
    1: -15.75637105984298,
    2: 0.04082224013073101,
    3: -0.5347301163226948,
    4: 0.5244099658805304,
    6: 1.048080741042263,
}
TIMES = np.linspace(0, 0.03, 31)


@pytest.fixture(scope="module")
def states():
    return simulate(TIMES)


def test_published_angles(states):
    for k, value in PUBLISHED.items():
        assert states[-1, k] == pytest.approx(value, abs=1e-8)


def test_loops_stay_closed(states):
    assert np.abs(loops(np.array(START), np.zeros(7))[0]).max() < 1e-15
    for state in states:
        g, G, _ = loops(state[:7], state[7:])
        np.testing.assert_allclose(g, 0, atol=1e-12)
        np.testing.assert_allclose(G @ state[7:], 0, atol=1e-9)


def test_energy_grows_by_the_work_of_the_drive(states):
    work = 0.033 * states[-1, 0]
    np.testing.assert_allclose(energy(states), energy(states)[0], atol=1e-10 * work)


def test_jacobian_and_curvature_are_derivatives_of_the_residual():
    rng = np.random.default_rng(1)
    q, v, step = np.array(START) + 0.1 * rng.standard_normal(7), rng.standard_normal(7), 1e-5
    _, G, h = loops(q, v)
    ahead, behind = loops(q + step * v, v)[0], loops(q - step * v, v)[0]
    np.testing.assert_allclose(G @ v, (ahead - behind) / (2 * step), atol=1e-9)
    np.testing.assert_allclose(h, (ahead + behind - 2 * loops(q, v)[0]) / step**2, atol=1e-5)
