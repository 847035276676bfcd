"""Events of joined conditions that are near an output but not at it."""

from __future__ import annotations

import numpy as np
import pytest

import acausal as ac
from acausal import Model, Scalar, der, parameter, piecewise, quantity, variable
from tests.shared import compiled

G, STIFFNESS, DAMPING = 9.81, 1e6, 2000.0


class Drop(Model):
    """A mass falls on a stiff spring-damper that cannot pull."""

    contact: Scalar = parameter("time of contact", unit="s", default=0.7)
    x: Scalar = variable("depth", unit="m")
    v: Scalar = variable("speed", unit="m/s", start=0, fixed=True)
    force: Scalar = variable("force per mass", unit="m/s2")

    def equations(self):
        f = STIFFNESS * self.x + DAMPING * self.v
        yield der(self.x) == self.v
        yield der(self.v) == G - self.force
        yield self.force == piecewise((f, (self.x > 0) & (f > 0)), 0)

    def initial_equations(self):
        yield self.x == -G * self.contact**2 / 2


class Play(Model):
    """A shaft at 1 rad/s meets a stiff gear, whose torque is positive there; the time since then is counted."""

    meets: Scalar = parameter("angle at which it meets", unit="rad", default=0.5)
    phi: Scalar = variable("angle", unit="rad", start=0, fixed=True)
    count: Scalar = variable("time since it met", unit="s", start=0, fixed=True)

    def equations(self):
        torque = 1e7 * (self.phi - self.meets)
        yield der(self.phi) == quantity(1, "rad/s")
        yield der(self.count) == piecewise((1, (self.phi > self.meets) & (torque > -1)), 0)


@pytest.mark.parametrize("tolerance", [1e-6, 1e-8])
def test_a_row_just_before_the_contact_is_of_the_free_fall(tolerance: float) -> None:
    t0 = 0.70004
    result = ac.simulate(compiled(Drop), stop_time=0.75, intervals=150, tolerance=tolerance, parameters={"contact": t0})
    assert result.time[140] == pytest.approx(0.7)
    assert result.stats.event_times[0] == pytest.approx(t0, abs=1e-6)
    assert result["x"][140] == pytest.approx(G * (0.7**2 - t0**2) / 2, abs=1e-6)
    assert result["force"][140] == 0


@pytest.mark.parametrize("tolerance", [1e-6, 1e-8])
def test_a_contact_just_before_a_row_is_not_put_off(tolerance: float) -> None:
    """The mass is 0.26 mm deep by then."""
    t0 = 0.69996
    result = ac.simulate(compiled(Drop), stop_time=0.75, intervals=150, tolerance=tolerance, parameters={"contact": t0})
    assert result.stats.event_times[0] == pytest.approx(t0, abs=1e-6)
    t, half, rest = 0.7 - t0, DAMPING / 2, G / STIFFNESS
    assert half**2 == STIFFNESS  # critical damping
    deep = rest + ((G * t0 - half * rest) * t - rest) * np.exp(-half * t)
    assert result["x"][140] == pytest.approx(deep, abs=2e-6)


@pytest.mark.parametrize("meets", [0.49996, 0.29998])
def test_a_gear_is_met_when_it_is(meets: float) -> None:
    result = ac.simulate(compiled(Play), stop_time=1.0, intervals=200, parameters={"meets": meets})
    assert result.stats.event_times == pytest.approx([meets], abs=1e-7)
    assert result["count"][-1] == pytest.approx(1 - meets, abs=1e-7)
