import numpy as np
import pytest
from scipy.integrate import cumulative_simpson

from tests.reference.slider_crank import STOP, SliderCrank, torque

MACHINES = [SliderCrank(), SliderCrank(slider_mass=0.05, gravity=9.81), SliderCrank(rod=0.2, gravity=3.0)]


@pytest.mark.parametrize("machine", MACHINES)
def test_energy_grows_by_the_work_of_the_torque(machine):
    times = np.linspace(0, STOP, 2001)
    states = machine.simulate(times)
    power = torque(times) * states[:, 1]
    energy = np.array([machine.energy(*state) for state in states])
    work = cumulative_simpson(power, x=times, initial=0)
    np.testing.assert_allclose(energy - energy[0], work, atol=1e-6 * abs(work).max())


@pytest.mark.parametrize("machine", MACHINES)
def test_energy_is_kept_without_torque(machine):
    states = machine.simulate(np.linspace(0, 1.6, 33))
    energy = np.array([machine.energy(*state) for state in states[14:]])
    np.testing.assert_allclose(energy, energy[0], atol=1e-10)


@pytest.mark.parametrize("th", [0.0, 0.7, 2.0, np.pi, 5.1])
def test_rates_are_derivatives(th):
    machine, h = SliderCrank(rod=0.25), 1e-4
    v, w, curved, z = machine.rates(th)
    x = [machine.slider_position(at) for at in (th - h, th, th + h)]
    angle = [machine.slope(at) for at in (th - h, th, th + h)]
    assert v[2] == pytest.approx((x[2] - x[0]) / (2 * h), abs=1e-8)
    assert curved[2] == pytest.approx((x[0] - 2 * x[1] + x[2]) / h**2, abs=1e-6)
    assert w[1] == pytest.approx((angle[2] - angle[0]) / (2 * h), abs=1e-8)
    assert z[1] == pytest.approx((angle[0] - 2 * angle[1] + angle[2]) / h**2, abs=1e-6)


def test_start_in_line():
    """At rest the slider does not move and the rod turns back: I = m1 l1^2 / 3 + m2 (l1 / 2)^2 + m2 l2^2 / 12 w^2."""
    machine = SliderCrank(gravity=9.81)
    (m1, m2, _), _ = machine.bodies()
    inertia = m1 * 0.152**2 / 3 + m2 * 0.076**2 + m2 * 0.304**2 / 12 * 0.25
    weight = 9.81 * 0.152 / 2 * (m1 + m2)
    assert machine.acceleration(0.0, 0.0, 0.0, True) == pytest.approx(-weight / inertia, rel=1e-12)
