import numpy as np
import pytest
from scipy.integrate import cumulative_simpson

from tests.reference.governor import C, energy, simulate, spin_inertia, spring


def test_published_heights():
    s = simulate([0.0, 0.5, 10.0])[:, 0]
    assert s[1] == pytest.approx(0.743249425, abs=1e-9)
    assert s[2] == pytest.approx(0.619623, abs=5e-7)


def test_energy_falls_by_the_work_of_the_dampers():
    """The springs yield within 1e-4 s; later little is lost."""
    times = np.concatenate([np.linspace(0, 0.01, 4001), np.linspace(0.01, 1, 4001)[1:]])
    states = simulate(times)
    rates = [np.dot(spring(s, th)[1:], (s_v, th_v)) for s, th, _, s_v, th_v in states]
    lost = cumulative_simpson(2 * C * np.square(rates), x=times, initial=0)
    total = energy(states)
    np.testing.assert_allclose(total + lost, total[0], atol=1e-7)
    assert 0 < lost[-1] < 0.003


def test_angular_momentum_of_point_masses_and_rods():
    """Rods cut into slices, each a point mass; the section of the rods is thin."""
    states = simulate(np.linspace(0, 10, 51))
    s, th, psi = states[:, :3].T
    slices = (np.arange(1000) + 0.5) / 1000
    rods = 0.3 * np.mean((0.05 + np.outer(np.cos(th), slices)) ** 2, axis=1)
    about_shaft = 2 * rods + 2 * 5 * (0.05 + np.cos(th)) ** 2 + 3 * 0.1**2 / 6
    np.testing.assert_allclose(spin_inertia(th)[0], about_shaft, atol=2e-5)
    assert (np.diff(psi) > 0).all()
    assert s.min() > 0.4999


@pytest.mark.parametrize(("s", "th"), [(0.5, 0.5), (0.7, 0.1), (0.3, -0.4)])
def test_derivatives(s, th):
    h = 1e-6
    slope = (spin_inertia(th + h)[0] - spin_inertia(th - h)[0]) / (2 * h)
    assert spin_inertia(th)[1] == pytest.approx(slope, rel=1e-8)
    _, l_s, l_th = spring(s, th)
    assert l_s == pytest.approx((spring(s + h, th)[0] - spring(s - h, th)[0]) / (2 * h), rel=1e-8)
    assert l_th == pytest.approx((spring(s, th + h)[0] - spring(s, th - h)[0]) / (2 * h), rel=1e-8)
