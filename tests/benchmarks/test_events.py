"""The scenes of the benchmark of events are right: closed forms, an engine by hand, energies; no time and no count is tested."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from itertools import pairwise
from math import pi, radians
from typing import Any

import numpy as np
import pytest
from scipy.integrate import solve_ivp

import acausal as ac
from tests.benchmarks.events import engine as e
from tests.benchmarks.events import measure
from tests.benchmarks.events.__main__ import cells, chosen
from tests.benchmarks.events.scenes import Ball, Drive, SampledPendulum, StickSlip

G, R, L = 9.80665, e.PIN_OFFSET, e.ROD
Run = Callable[..., ac.Result]


@pytest.fixture(params=["idas", "rosenbrock"])
def run(request: Any) -> Run:
    def simulated(model: ac.Model, **how: Any) -> ac.Result:
        return ac.simulate(model, method=request.param, energy=True, **how)

    return simulated


def balanced(result: ac.Result, part: float) -> None:
    """Check that the method lost hardly anything of what was supplied or moved."""
    s = result.stats
    assert abs(s["energy_method"]) < part * max(abs(s["energy_supplied"]), abs(s["energy_dissipated"]))


class Cylinder:
    """Motion of the throw, rod and piston of one cylinder over the angle of the crankshaft, and what they weigh."""

    def __init__(self, phi: float, offset: float, bank: float) -> None:
        self.tilt, throw = radians(bank), phi + radians(offset - bank)
        rod = -np.arcsin(R / L * np.sin(throw))
        d_rod = -R * np.cos(throw) / (L * np.cos(rod))
        turn, swing = 1j * np.exp(1j * throw) * R, 1j * np.exp(1j * rod) * L
        self.pin, self.wrist = turn, turn + swing
        d_pin, d_swing = 1j * turn, 1j * swing * d_rod
        arms, m_rod = 2 * e.STEEL * R * 0.02 * 0.05, e.STEEL * L * 0.02 * 0.06
        m_piston = e.STEEL * pi / 4 * e.BORE**2 * e.PISTON
        self.inertia = arms * (R**2 / 3 + 0.05**2 / 12) + e.PIN_MASS * R**2 + m_piston * abs(d_pin + d_swing) ** 2
        self.inertia += m_rod * (abs(d_pin + d_swing / 2) ** 2 + (L**2 + 0.06**2) / 12 * d_rod**2)
        first = arms * turn / 2 + e.PIN_MASS * turn + m_rod * (turn + swing / 2)
        first += m_piston * (turn + swing + 1j * e.PISTON / 2)
        self.potential = G * (first * np.exp(1j * self.tilt)).imag
        self.rate = -(d_pin + d_swing).imag  # of the length of the chamber
        x = 1 - (e.TOP - e.PISTON - self.wrist.imag) / e.CHAMBER
        laws = ([177.4132, -287.2189, 151.8252, -24.9973, 2.4], [145.930, -131.707, 17.3438, 17.9272, 2.4])
        self.torque = [1e5 * np.polyval(law, x) * pi / 4 * e.BORE**2 * self.rate for law in laws]


def engine_by_hand(angles: np.ndarray) -> tuple[np.ndarray, float]:
    """Times of angles from 0 on, and the last speed, from the energy over the angle.

    Between two angles, at most 60 degrees apart and at its multiples or between them, every piston moves one way.
    """

    def cylinders(phi: float) -> list[Cylinder]:
        return [Cylinder(phi, o, b) for o, b in zip(e.OFFSETS, e.BANKS, strict=True)]

    def speed(phi: float, energy: float) -> float:
        parts = cylinders(phi)
        kinetic = energy - sum(c.potential for c in parts)
        return float(np.sqrt(2 * kinetic / (e.LOAD + sum(c.inertia for c in parts))))

    def rate(phi: float, y: np.ndarray, outwards: list[bool]) -> list[float]:
        w = speed(phi, y[1])
        gas = sum(c.torque[int(out)] for c, out in zip(cylinders(phi), outwards, strict=True))
        return [1 / w, gas - e.TAU_NOMINAL * (w / e.W_NOMINAL) ** 2 - e.DRY]

    start = cylinders(0.0)
    energy = (e.LOAD + sum(c.inertia for c in start)) * 10**2 / 2 + sum(c.potential for c in start)
    found = [np.array([0.0, energy])]
    for begin, end in pairwise(angles):
        outwards = [c.rate > 0 for c in cylinders((begin + end) / 2)]
        found.append(solve_ivp(rate, (begin, end), found[-1], args=(outwards,), rtol=1e-10, atol=1e-10).y[:, -1])
    return np.array(found)[:, 0], speed(angles[-1], found[-1][1])


@pytest.mark.parametrize("planar", [False, True])
def test_engine_is_that_derived_by_hand(planar):
    angles = np.array([0, pi / 3, 2 * pi / 3, 2.4])
    times, speed = engine_by_hand(angles)
    how: dict[str, Any] = {"intervals": 70, "tolerance": 1e-7, "method": "rosenbrock", "energy": True}
    result = ac.simulate(e.EngineV6(planar=planar), stop_time=times[-1], **how)
    np.testing.assert_allclose(result.stats["event_times"], times[1:-1], atol=1e-6)
    np.testing.assert_allclose([result["angle"][-1], result["speed"][-1]], [angles[-1], speed], rtol=1e-5)
    balanced(result, 1e-4)


def test_stick_slip_against_the_closed_form(run):
    """Slips on a circle of the phase plane around what sliding holds, and sticks on a line."""
    result = run(StickSlip(), stop_time=4.0, tolerance=1e-8)
    rate, stretch = 10.0, 0.2  # of the spring beyond what sliding holds
    sticks, slips = 2 * stretch, (pi + 2 * np.arctan2(1 / rate, stretch)) / rate
    expected = stretch + np.cumsum([0.0, *[slips, sticks] * 5])
    found = result.stats["event_times"]
    np.testing.assert_allclose(found, expected[expected < 4.0], atol=1e-5)
    stuck = result.time < stretch
    np.testing.assert_allclose(result["angle"][stuck], 0.4 + result.time[stuck], atol=1e-7)
    slip = (result.time > expected[0]) & (result.time < expected[1])
    t = rate * (result.time[slip] - expected[0])
    np.testing.assert_allclose(result["angle"][slip], 0.4 + stretch * np.cos(t) + np.sin(t) / rate, atol=1e-6)
    balanced(result, 1e-5)


def test_ball_against_the_closed_form(run):
    result = run(Ball(), tolerance=1e-7)
    first = np.sqrt(2 / 9.81)
    expected = first + 2 * first * np.cumsum([0.0, *0.9 ** np.arange(1, 30)])
    np.testing.assert_allclose(result.stats["event_times"], expected[expected < 7.8], atol=1e-7)
    balanced(result, 1e-6)


def test_sampled_pendulum_against_a_loop_over_its_samples(run):
    result = run(SampledPendulum(), stop_time=0.1, intervals=100)
    y = np.zeros(2)
    angles = [0.0]
    for _ in range(100):
        torque = 60 * (1 - y[0]) - 12 * y[1]
        rate = lambda t, y, torque=torque: [y[1], torque - 9.81 * np.sin(y[0])]  # noqa: E731
        y = solve_ivp(rate, (0, 1e-3), y, rtol=1e-10, atol=1e-12).y[:, -1]
        angles.append(y[0])
    np.testing.assert_allclose(result["angle"], angles, atol=1e-6)
    np.testing.assert_allclose(result["torque"][-1], 60 * (1 - y[0]) - 12 * y[1], atol=1e-4)
    balanced(result, 1e-5)


def test_drive_slips_locks_and_comes_to_rest(run):
    result = run(Drive(), intervals=2000)
    t, motor, load = result.time, result["motor_speed"], result["load_speed"]
    slips, limited, slow, locked, *_, rest = result.stats["event_times"]  # the open clutch begins to slip first
    assert slips < 1e-3 < limited < 0.5 < slow < locked
    np.testing.assert_allclose(load[(t > 0.5) & (t < locked)], 100 * (t[(t > 0.5) & (t < locked)] - 0.5), atol=1e-4)
    np.testing.assert_allclose(result["hub.w"][(t > locked) & (t < 2.5)], load[(t > locked) & (t < 2.5)], atol=1e-4)
    np.testing.assert_allclose(rest, 2.5 + np.interp(2.5, t, load) / 50, atol=1e-5)
    assert np.abs(load[t > rest]).max() < 1e-6
    assert abs(np.interp(slow, t, motor) - 60) < 0.1
    balanced(result, 1e-4)


def test_rows_of_the_table():
    scene = replace(chosen(["ball"])[0], short=1.0)
    rows = list(measure.measure(scene))
    assert len(rows) == 6
    assert all(isinstance(row.error, float) and row.error < 1e-2 for row in rows)
    assert all(len(cells(row)) == 12 for row in rows)


def test_a_failed_run_says_why():
    scene = measure.Scene("endless", lambda: Ball(e=0.5), 3.0, 100)
    assert all("without end" in row.failure or "hardly any motion" in row.failure for row in measure.measure(scene))
