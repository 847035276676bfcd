"""Machines with signals against integrations of equations derived by hand."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from scipy.linalg import expm

import acausal as ac
from acausal import Table
from models.signals import Crane, MotorDrive, QuarterCar, RectifierDrive, Wiper
from models.signals.crane import LOAD, PERIOD, ROPE, TROLLEY, Controller, G
from models.signals.quarter_car import rough

EXACT = {"rtol": 1e-9, "atol": 1e-10, "dense_output": True}


def close(result, name, expected, part):
    """Assert that an output is the expected one within a part of its range."""
    assert np.max(np.abs(result[name] - expected)) <= part * np.ptp(expected), name


def sample(parts, time):
    """Return the states at some times, from integrations one after another."""
    states = np.full((len(parts[0].y), len(time)), np.nan)
    for part in parts:
        inside = (time >= part.t[0]) & (time <= part.t[-1])
        if inside.any():
            states[:, inside] = part.sol(time[inside])
    return states


def test_quarter_car():
    """The exact solution between rows, where the road is a straight line."""
    m, M, c, d, tyre = 40, 400, 2e4, 1.5e3, 2e5
    A = np.array([[0, 1, 0, 0], [-c / M, -d / M, c / M, d / M], [0, 0, 0, 1], [c / m, d / m, -(c + tyre) / m, -d / m]])
    result = ac.simulate(QuarterCar(), intervals=909, tolerance=1e-8)
    road = rough(200, 10_000).values
    h = result.time[-1] / (len(road) - 1)
    whole = np.zeros((6, 6))  # states, road, and its change from row to row
    whole[:4, :4], whole[3, 4], whole[4, 5] = h * A, h * tyre / m, 1
    F = expm(whole)[:4]
    found = np.zeros((len(road), 4))
    for k, step in enumerate(np.diff(road)):
        found[k + 1] = F @ [*found[k], road[k], step]
    exact = found[::11]
    close(result, "lift", exact[:, 0], 1e-6)
    close(result, "load", tyre * (road[::11] - exact[:, 2]), 1e-6)


def test_motor_drive():
    c = (100 - 0.05 * 100) / (1425 * 2 * np.pi / 60)

    def rates(t, y):
        i, w, xi = y
        error = 60 - w
        free = 8 * (error + xi)
        demand = np.clip(free, -100, 100)
        v = np.clip(2 * (demand - i) + c * 2 * w, -110, 110)
        windup = (demand - free) / (8 * 0.9)
        return [
            (v - 0.05 * i - c * 2 * w) / 1.5e-3,
            (2 * c * i - 60 * (w / 70) ** 2) / (2 + 4 * 0.15),
            (error + windup) / 0.5,
        ]

    result = ac.simulate(MotorDrive(), tolerance=1e-8)
    exact = solve_ivp(rates, (0.2, 4), [0, 0, 0], max_step=5e-3, **EXACT)
    i, w, _ = exact.sol(np.maximum(result.time, 0.2))
    assert np.max(result["current"]) < 100
    close(result, "current", np.where(result.time < 0.2, 0, i), 1e-5)
    close(result, "w", np.where(result.time < 0.2, 0, w), 1e-6)


def test_crane():
    def rates(t, y, force):
        _, v, phi, w = y
        mass = np.array([[TROLLEY + LOAD, LOAD * ROPE * np.cos(phi)], [np.cos(phi), ROPE]])
        a, alpha = np.linalg.solve(mass, [force + LOAD * ROPE * w**2 * np.sin(phi), -G * np.sin(phi)])
        return [v, a, w, alpha]

    controller, y, exact = Controller(target=4, limit=400), np.zeros(4), [0.0]
    for k in range(300):
        force = controller(k * PERIOD, y[[0, 2]])
        y = solve_ivp(rates, (0, PERIOD), y, args=(force,), rtol=1e-10, atol=1e-12).y[:, -1]
        exact.append(y[0])
    result = ac.simulate(Crane(), intervals=300, tolerance=1e-9)
    assert np.max(np.abs(np.diff(result["controller.y"]))) > 50
    close(result, "x", np.array(exact), 1e-6)
    assert exact[-1] == pytest.approx(4, abs=5e-3)
    assert np.max(np.abs(result["pivot.phi"][-20:])) < 1e-3


def wiper_rates(t, y, volts, slides):
    """Rates of current, angle and speed of the crank, while it turns forwards or is stuck."""
    i, phi, w = y
    lever, slope = 0.8 * np.cos(phi), -0.8 * np.sin(phi)
    inertia = 3600 * 1e-4 + 0.05 * lever**2
    torque = 60 * 0.03 * i - 3 * abs(lever) - 0.05 * lever * slope * w**2
    return [(volts - 0.3 * i - 0.03 * 60 * w) / 1e-3, w, slides * torque / inertia]


def margin(t, y, volts, slides):
    """What falls to zero when the crank comes to rest, or is broken away."""
    return y[2] if slides else 1.3 * 3 * 0.8 * abs(np.cos(y[1])) - abs(60 * 0.03 * y[0])


margin.terminal, margin.direction = True, -1


def test_wiper():
    """Stuck until the motor breaks it away, sliding at two speeds, and stuck again."""
    y, t, slides, parts = np.array([0, 0.1 / 60, 0]), 0.0, False, []
    for volts, end in ((0, 0.2), (8, 2.5), (13, 4.5), (0, 6)):
        while t < end:
            options = {"method": "Radau", "max_step": 0.01, **EXACT}
            part = solve_ivp(wiper_rates, (t, end), y, args=(volts, slides), events=margin, **options)
            parts.append(part)
            y, t = part.y[:, -1], part.t[-1]
            if part.status == 1:
                slides, y[2] = not slides, 0
    assert len(parts) == 6
    assert not slides
    result = ac.simulate(Wiper(), tolerance=1e-9)
    i, phi, _ = sample(parts, result.time)
    close(result, "angle", 0.8 * np.sin(phi), 1e-8)
    close(result, "current", i, 1e-7)


RON, GOFF, KNEE = 1e-3, 1e-5, 0.7


def node(v, i, n):
    """Voltage of the node that diodes from the phases feed with a current, if those of the n highest conduct."""
    known = np.sum((v[:n] - KNEE) / RON + GOFF * KNEE) + GOFF * np.sum(v[n:]) - i
    return known / (n / RON + (3 - n) * GOFF)


def overlap(v, i):
    """Voltage above its knee of the diode from the second highest phase, beside one that conducts."""
    v = np.sort(v)[::-1]
    return v[1] - node(v, i, 1) - KNEE


def bridge(v, i):
    """Voltage of the node: near the crossing of two phases both of their diodes conduct."""
    return node(np.sort(v)[::-1], i, 1 if overlap(v, i) <= 0 else 2)


def phases(t):
    return 60 * np.sin(2 * np.pi * (50 * t - np.array([0, 1, -1]) / 3))


def drive_rates(t, y, brake):
    (i, w), v, c = y, phases(t), (100 - 0.05 * 100) / (1425 * 2 * np.pi / 60)
    supply = bridge(v, i) + bridge(-v, i)
    return [(supply - 0.05 * i - c * w) / 6.5e-3, (c * i - 30 * (w / 150) ** 2 - brake) / 0.15]


def change(sign, both):
    """Event where the second diode of the upper or lower three closes, or where one of both opens."""

    def event(t, y, brake):
        return overlap(sign * phases(t), y[0])

    event.terminal, event.direction = True, -1 if both else 1
    return event


def test_rectifier_drive():
    """From one crossing of two phases to the next, with an event where each diode opens or closes."""
    y, t, parts, both = np.array([50.0, 145.0]), 0.0, [], {1: False, -1: False}
    for end in sorted({*(1 / 600 + np.arange(75) / 300), 0.2, 0.25}):
        while t < end:
            options = {"method": "DOP853", "events": [change(sign, both[sign]) for sign in both], **EXACT}
            part = solve_ivp(drive_rates, (t, end), y, args=(20 if t >= 0.2 else 0,), **options)
            parts.append(part)
            y, t = part.y[:, -1], part.t[-1]
            both = {sign: both[sign] != (len(at) > 0) for sign, at in zip(both, part.t_events, strict=True)}
    assert sum(part.status for part in parts) == 150
    result = ac.simulate(RectifierDrive(), stop_time=0.25, tolerance=1e-8)
    i, w = sample(parts, result.time)
    voltage = [bridge(phases(t), i) + bridge(-phases(t), i) for t, i in zip(result.time, i, strict=True)]
    close(result, "current", i, 1e-6)
    close(result, "w", w, 1e-6)
    close(result, "voltage", np.array(voltage), 1e-6)
    assert result.stats.events == 150


@pytest.mark.parametrize("scene", [QuarterCar, MotorDrive, Wiper, RectifierDrive])
def test_as_fmus(scene, tmp_path):
    """Results of FMPy are those of simulate to the end, with the inputs that it gives."""
    fmpy = pytest.importorskip("fmpy")
    path, stop = tmp_path / "machine.fmu", scene.stop_time
    ac.export_fmu(scene(), path, tolerance=1e-8)
    names = list(ac.compile(scene()).outputs)
    given, inputs, at, jumps = {}, {}, np.linspace(0, stop, 1001), dict.fromkeys(names, 0.0)
    if scene is QuarterCar:  # FMPy holds what it interpolates in each step, and reads the load before the next
        data = np.array([(0, 0), (5, 0.0), (7, 0.05), (10, 0.02)], dtype=[("time", float), ("bump", float)])
        bump = np.interp(at, data["time"], data["bump"])
        given, inputs = {"input": data}, {"bump": Table(at, bump, kind="constant")}
        jumps["load"] = 2e5 * np.diff(bump, prepend=0)
    steps = {"stop_time": stop, "output_interval": stop / 1000, "fmi_type": "CoSimulation", "output": names}
    found = fmpy.simulate_fmu(path, **steps, **given)
    own = ac.simulate(scene(), stop_time=stop, intervals=1000, tolerance=1e-8, inputs=inputs)
    np.testing.assert_allclose(found["time"], own.time, atol=1e-9)
    for name in names:
        close(own, name, found[name] + jumps[name], 1e-8)
