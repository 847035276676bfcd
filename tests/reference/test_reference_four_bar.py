import numpy as np
import pytest
from scipy.integrate import cumulative_simpson

from tests.reference.four_bar import FourBar


def test_published_angles():
    """Published within 1e-3; they lie 3e-5 off."""
    states = FourBar().simulate([0.0, 1.0, 2.0])
    assert states[1:, 0] == pytest.approx([-1.821068, -3.624443], abs=4e-5)


def test_energy_falls_by_the_work_of_the_damper():
    times = np.linspace(0, 5, 2001)
    states = FourBar().simulate(times)
    energy = np.array([FourBar().energy(*state) for state in states])
    lost = 0.1 * cumulative_simpson(states[:, 1] ** 2, x=times, initial=0)
    np.testing.assert_allclose(energy + lost, energy[0], atol=1e-6)


def test_energy_is_kept_without_damper():
    machine = FourBar(damping=0.0)
    states = machine.simulate(np.linspace(0, 5, 51))
    energy = np.array([machine.energy(*state) for state in states])
    np.testing.assert_allclose(energy, energy[0], atol=1e-9)


@pytest.mark.parametrize("phi", np.linspace(-6, 6, 9))
def test_loop_is_closed_and_rates_are_derivatives(phi):
    machine, h = FourBar(), 1e-4
    crank, coupler, rocker = links = machine.turned(phi)
    assert crank + coupler == pytest.approx(machine.ground + rocker, abs=1e-15)
    np.testing.assert_allclose(abs(links), abs(machine.links), atol=1e-14)
    w, z = machine.rates(links)
    ahead, behind = (np.angle(machine.turned(phi + step) / links) for step in (h, -h))
    np.testing.assert_allclose(w, (ahead - behind) / (2 * h), atol=1e-7)
    np.testing.assert_allclose(z, (ahead + behind) / h**2, atol=1e-6)


def test_parallelogram_is_a_pendulum():
    """Crank and rocker alike, coupler only shifted: ((2 / 3) m + M) L^2 phi'' = -(m + M) g L cos phi for thin links."""
    machine = FourBar(crank=1.0, coupler=1j, ground=1j, side=1e-6, damping=0.0, gravity=5.0)
    for phi in (-0.3, 0.2, 0.6):
        assert machine.acceleration(phi, 0.7) == pytest.approx(-6.0 * np.cos(phi), rel=1e-9)
