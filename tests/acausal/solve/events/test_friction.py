"""Stiction and sliding, clutches, and switches that find no rest."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from scipy.integrate import solve_ivp

import acausal as ac
from acausal import (
    InitializationError,
    Model,
    Scalar,
    SimulationError,
    chain,
    cos,
    der,
    fixed,
    piecewise,
    reinit,
    sin,
    time,
    variable,
    when,
)
from acausal.core import Back, Run
from components import rotational


class Block(Model):
    """A rotor on which an oscillating torque acts, held by friction."""

    drive = rotational.Torque(tau=3 * sin(2 * time))
    rotor = rotational.Inertia(J=1.0, phi=fixed(0), w=fixed(0))
    brake = rotational.Friction(tau_static=2.0, tau_sliding=1.0)
    wall = rotational.Fixed()

    def connections(self):
        yield chain(self.drive, self.rotor, self.brake, self.wall)


def by_hand(static: float, sliding: float, stop: float) -> tuple[list[float], float]:
    """Times of break-away and of sticking, and the angle at the end."""
    t, phi, w, times = 0.0, 0.0, 0.0, []
    while t < stop:
        grid = np.linspace(t, t + np.pi, 200_001)
        torque = 3 * np.sin(2 * grid)
        k = int(np.argmax(np.abs(torque) > static))
        if k:
            t = float(np.interp(static, np.abs(torque[k - 1 : k + 1]), grid[k - 1 : k + 1]))
            times.append(t)
        if t >= stop:
            return times[:-1], phi
        sense = float(np.sign(np.sin(2 * t + 1e-9)))

        def law(t, y, sense=sense):
            return [y[1], 3 * np.sin(2 * t) - sense * sliding]

        def rests(t, y, sense=sense, begin=t):
            return sense * y[1] + (1.0 if t < begin + 1e-3 else 0.0)

        rests.terminal = True  # type: ignore[attr-defined]
        run: Any = solve_ivp(law, (t, stop), [phi, w], events=rests, rtol=1e-11, atol=1e-12, max_step=0.01)
        t, phi, w = float(run.t[-1]), float(run.y[0, -1]), 0.0
        if t < stop:
            times.append(t)
    return times, phi


@pytest.mark.parametrize(
    ("static", "sliding"),
    [(2.0, 1.0), *(pytest.param(*pair, marks=pytest.mark.slow) for pair in ((2.9, 2.0), (2.5, 2.5)))],
)
def test_stick_and_slip(static, sliding):
    parameters = {"brake.tau_static": static, "brake.tau_sliding": sliding}
    result = ac.simulate(Block(), stop_time=8.0, tolerance=1e-9, parameters=parameters, energy=True)
    times, phi = by_hand(static, sliding, 8.0)
    np.testing.assert_allclose(result.stats["event_times"], times, atol=1e-6)
    assert result["rotor.phi"][-1] == pytest.approx(phi, abs=1e-6)
    stuck = np.abs(result["brake.mode"]) < 0.5
    assert np.max(np.abs(result["rotor.w"][stuck])) < 1e-8
    assert abs(result.stats["energy_method"]) < 1e-4 * result.stats["energy_supplied"]


class Coupled(Model):
    a = rotational.Inertia(J=2.0, phi=fixed(0), w=fixed(10))
    clutch = rotational.Clutch(tau_max=5.0, f_normalized=piecewise((0, time < 1), 1))
    b = rotational.Inertia(J=3.0, phi=fixed(0), w=fixed(0))

    def connections(self):
        yield chain(self.a, self.clutch, self.b)


def test_the_core_decides_what_sticks(monkeypatch):
    """None of the events comes back to Python."""
    backs, go = [], Run.go
    monkeypatch.setattr(Run, "go", lambda *given, **more: (rows := go(*given, **more), backs.append(rows.back))[0])
    run = ac.simulate(Block(), stop_time=10.0)
    assert run.stats["events"] > 5
    assert set(backs) == {Back.END}


def test_clutch_locks_two_rotors():
    result = ac.simulate(Coupled(), stop_time=5.0, energy=True)
    assert result.stats["event_times"] == pytest.approx([3.4], abs=1e-8)
    locked = result.time > 3.4
    np.testing.assert_allclose(result["a.w"][locked], 4.0, atol=1e-7)
    np.testing.assert_allclose(result["b.w"][locked], 4.0, atol=1e-7)
    slipping = (result.time > 1) & ~locked
    np.testing.assert_allclose(result["a.w"][slipping], 10 - 2.5 * (result.time[slipping] - 1), atol=1e-6)
    assert result.stats["energy_dissipated"] == pytest.approx(60.0, abs=1e-5)


class Struck(Coupled):
    """A blow at 2 s turns one of two rotors back that the clutch holds together."""

    a, b = rotational.Inertia(J=2.0, phi=fixed(0), w=fixed(4)), rotational.Inertia(J=3.0, phi=fixed(0), w=fixed(4))
    clutch = rotational.Clutch(tau_max=5.0, f_normalized=1.0)

    def equations(self):
        yield when(time > 2, reinit(self.a.w, -6.0))


@pytest.mark.parametrize("method", ["auto", "idas"])
def test_a_blow_parts_what_stuck(method):
    """The clutch slides until the rotors turn alike, at (-6 2 + 4 3) / 5 = 0, after 4 3 / 5 s."""
    result = ac.simulate(Struck(), stop_time=6.0, method=method)
    after = result.time > 2
    np.testing.assert_allclose(result["b.w"][after], np.maximum(4 - 5 / 3 * (result.time[after] - 2), 0), atol=1e-4)
    np.testing.assert_allclose(result["a.w"][after], np.minimum(2.5 * (result.time[after] - 2) - 6, 0), atol=1e-4)


class Brakes(Model):
    """Two rotors, of which a brake at a wall holds one, and another brake the other at that."""

    a = rotational.Inertia(J=1e-3, phi=fixed(0), w=fixed(10))
    between = rotational.Friction(tau_sliding=5.0)
    b = rotational.Inertia(J=1e-3, phi=fixed(0), w=fixed(-5))
    brake = rotational.Friction(tau_sliding=1.0)
    wall = rotational.Fixed()

    def connections(self):
        yield chain(self.a, self.between, self.b, self.brake, self.wall)


@pytest.mark.filterwarnings("ignore:.*faster than they are checked:acausal.AcausalWarning")
@pytest.mark.parametrize("method", ["auto", "idas"])
def test_brakes_hold_however_long_the_run_is(method):
    """The rotor b stops and turns round, then both turn alike, at `w`, and stop: all within 7 ms."""
    result = ac.simulate(Brakes(), stop_time=100.0, tolerance=1e-9, method=method)
    w = 70 / 27
    assert result["a.phi"][-1] == pytest.approx((10**2 - w**2) / 1e4 + w**2 / 1e3, rel=1e-9)
    assert result["b.phi"][-1] == pytest.approx(-(5**2) / 1.2e4 + w**2 / 8e3 + w**2 / 1e3, rel=1e-9)


def test_clutch_tears_open_above_its_torque():
    class Overload(Model):
        drive = rotational.Torque(tau=4 * time)
        rotor = rotational.Inertia(J=1.0, phi=fixed(0), w=fixed(0))
        clutch = rotational.Clutch(tau_max=2.0, f_normalized=1.0, peak=1.5)
        wall = rotational.Fixed()

        def connections(self):
            yield chain(self.drive, self.rotor, self.clutch, self.wall)

    result = ac.simulate(Overload(), stop_time=1.0)
    assert result.stats["event_times"] == pytest.approx([0.75], abs=1e-7)
    assert result["rotor.w"][-1] == pytest.approx(2 * (1 - 0.75**2) - 2 * 0.25, abs=1e-6)


def test_sign_of_the_speed_alone_is_refused():
    class Relay(Model):
        x: Scalar = variable("x", start=1, fixed=True)

        def equations(self):
            yield der(self.x) == piecewise((-1, self.x > 0), 1)

    with pytest.raises(SimulationError, match="switch back and forth"):
        ac.simulate(Relay(), stop_time=2)


def test_modes_that_fit_no_start():
    class Contradiction(Model):
        x: Scalar = variable("x", start=0, fixed=True)
        y: Scalar = variable("y")

        def equations(self):
            yield der(self.x) == self.y
            yield self.y == cos(self.x) * piecewise((1, self.y < 0.5), 0)

    with pytest.raises(InitializationError, match=r"no consistent positions|contradicts its own"):
        ac.simulate(Contradiction(), stop_time=1)


def test_smooth_condition_needs_no_stop():
    class Smooth(Model):
        x: Scalar = variable("x", start=-1, fixed=True)

        def equations(self):
            yield der(self.x) == 1 + piecewise((self.x**4, self.x > 0), 0, smooth=True)

    stats = ac.simulate(Smooth(), stop_time=1.5).stats
    assert (stats["events"], stats["calls"]) == (0, 1)
