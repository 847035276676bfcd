"""Machines with signals against integrations of equations derived by hand."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from scipy.signal import cont2discrete

import acausal as ac
from acausal import Table
from models.signals import Crane, MotorDrive, QuarterCar, RectifierDrive, Wiper
from models.signals.crane import LOAD, PERIOD, ROPE, TROLLEY, Controller, G

EXACT = {"rtol": 1e-9, "atol": 1e-10, "dense_output": True}


def close(result, name, expected, part):
    """Assert that an output is the expected one within a part of its range."""
    assert np.max(np.abs(result[name] - expected)) <= part * np.ptp(expected), name


def test_quarter_car():
    """The exact solution between rows, where the road is a straight line."""
    m, M, c, d, tyre = 40, 400, 2e4, 1.5e3, 2e5
    A = np.array([[0, 1, 0, 0], [-c / M, -d / M, c / M, d / M], [0, 0, 0, 1], [c / m, d / m, -(c + tyre) / m, -d / m]])
    B, C, D = np.array([[0], [0], [0], [tyre / m]]), np.eye(4), np.zeros((4, 1))
    model = QuarterCar()
    result = ac.simulate(model, intervals=909, tolerance=1e-8)
    road = QuarterCar.profile.default(model).values
    F, G0, C, D, _ = cont2discrete((A, B, C, D), result.time[-1] / (len(road) - 1), "foh")
    x, found = np.zeros(4), []
    for u in road:
        found.append(C @ x + D[:, 0] * u)
        x = F @ x + G0[:, 0] * u
    exact = np.array(found)[::11]
    close(result, "lift", exact[:, 0], 1e-6)
    close(result, "load", tyre * (road[::11] - exact[:, 2]), 1e-5)


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


def wiper_rates(volts):
    """Rates of current, angle and speed of the crank, while it turns forwards or backwards."""

    def rates(t, y, way):
        i, phi, w = y
        lever, slope = 0.8 * np.cos(phi), -0.8 * np.sin(phi)
        inertia = 3600 * 1e-4 + 0.05 * lever**2
        torque = 60 * 0.03 * i - way * 3 * abs(lever) - 0.05 * lever * slope * w**2
        return [(volts - 0.3 * i - 0.03 * 60 * w) / 1e-3, w, torque / inertia]

    return rates


def stops(t, y, way):
    """The crank comes to rest, after it has begun to turn."""
    return y[2] if t > 0.21 else 1.0


stops.terminal, stops.direction = True, -1


def test_wiper():
    """Stuck until the motor breaks it away, sliding forwards, and stuck again after a turn backwards or none."""
    lever, found = 0.8 * np.cos(0.1 / 60), []
    needed = 1.3 * 3 * lever / (60 * 0.03)
    away = 0.2 - 1e-3 / 0.3 * np.log(1 - needed * 0.3 / 8)
    y, t = [needed, 0.1 / 60, 0.0], away
    for volts, end in ((8, 2.5), (13, 4.5), (0, 6)):
        part = solve_ivp(
            wiper_rates(volts), (t, end), y, args=(1,), events=stops, method="Radau", max_step=0.01, **EXACT
        )
        found.append(part)
        y, t = part.y[:, -1], part.t[-1]
    result = ac.simulate(Wiper(), tolerance=1e-9)
    exact = np.full(len(result.time), y[1])
    exact[result.time < away] = 0.1 / 60
    for part in found:
        inside = (result.time >= part.t[0]) & (result.time <= part.t[-1])
        exact[inside] = part.sol(result.time[inside])[1]
    assert t < 6
    assert abs(60 * 0.03 * y[0]) < 1.3 * 3 * 0.8 * abs(np.cos(y[1]))
    close(result, "angle", 0.8 * np.sin(exact), 1e-5)


def bridge(v, i):
    """Voltage of the node that diodes from the phases feed with a current."""
    v, Ron, Goff, Vknee = np.sort(v)[::-1], 1e-3, 1e-5, 0.7
    for n in (1, 2, 3):
        known = np.sum((v[:n] - Vknee) / Ron + Goff * Vknee) + Goff * np.sum(v[n:]) - i
        node = known / (n / Ron + (3 - n) * Goff)
        if n == 3 or v[n] - node <= Vknee:
            return node
    raise AssertionError


def test_rectifier_drive():
    c = (100 - 0.05 * 100) / (1425 * 2 * np.pi / 60)
    phases = -2 * np.pi / 3 * np.array([0, 1, -1])

    def rates(t, y, brake):
        i, w = y
        v = 60 * np.sin(2 * np.pi * 50 * t + phases)
        supply = bridge(v, i) + bridge(-v, i)
        return [(supply - 0.05 * i - c * w) / 6.5e-3, (c * i - 30 * (w / 150) ** 2 - brake) / 0.15]

    result = ac.simulate(RectifierDrive(), stop_time=0.25, tolerance=1e-8)
    first = solve_ivp(rates, (0, 0.2), [50, 145], args=(0,), max_step=1e-4, **EXACT)
    second = solve_ivp(rates, (0.2, 0.25), first.y[:, -1], args=(20,), max_step=1e-4, **EXACT)
    i, w = np.where(
        result.time < 0.2, first.sol(np.minimum(result.time, 0.2)), second.sol(np.maximum(result.time, 0.2))
    )
    close(result, "current", i, 1e-5)
    close(result, "w", w, 1e-5)
    assert result.stats.events >= 150


@pytest.mark.parametrize("scene", [QuarterCar, MotorDrive, Wiper, RectifierDrive])
def test_as_fmus(scene, tmp_path):
    """Results of FMPy are those of simulate, with the inputs that it gives."""
    fmpy = pytest.importorskip("fmpy")
    path, stop = tmp_path / "machine.fmu", 0.1 if scene is RectifierDrive else 1.0
    ac.export_fmu(scene(), path, tolerance=1e-8)
    given, inputs, at = {}, {}, np.linspace(0, stop, 1001)
    if scene is QuarterCar:  # FMPy holds what it interpolates in each step
        data = np.array([(0, 0), (0.5, 0.0), (0.7, 0.05), (1.0, 0.02)], dtype=[("time", float), ("bump", float)])
        given = {"input": data}
        inputs = {"bump": Table(at, np.interp(at, data["time"], data["bump"]), kind="constant")}
    names = ac.compile(scene()).outputs
    steps = {"stop_time": stop, "output_interval": stop / 1000, "fmi_type": "CoSimulation", "output": list(names)}
    found = fmpy.simulate_fmu(path, **steps, **given)
    own = ac.simulate(scene(), stop_time=stop, intervals=1000, tolerance=1e-8, inputs=inputs)
    for name in set(names) - {"voltage", "load"}:  # which jump
        error = np.interp(own.time, found["time"], found[name]) - own[name]
        assert np.max(np.abs(error)) <= 1e-4 * np.ptp(own[name]), name
