"""Blocks: transfer functions against scipy, nonlinear blocks against their formulas, sampled ones against loops."""

from __future__ import annotations

import numpy as np
import pytest
from scipy import signal
from scipy.integrate import solve_ivp

import acausal as ac
from acausal import DeclarationError, Model, Scalar, Table, connect, input, output, sin
from acausal import time as now
from components import blocks

W = np.logspace(-1, 2, 30)


def response(block):
    """Return the frequency response of a block of one input and one output."""

    class Alone(Model):
        v: Scalar = input("input")
        part = block
        w: Scalar = output("output")

        def equations(self):
            yield self.part.u == self.v
            yield self.w == self.part.y

    found = ac.linearize(Alone())
    return signal.freqresp((found.A, found.B, found.C, found.D), W)[1] if len(found.A) else found.D[0, 0] + 0 * W


S = 1j * W
LINEAR = {
    "Gain": (blocks.Gain(k=3), 3 + 0 * S),
    "Integrator": (blocks.Integrator(k=2), 2 / S),
    "Derivative": (blocks.Derivative(k=2, T=0.1), 2 * S / (0.1 * S + 1)),
    "FirstOrder": (blocks.FirstOrder(k=2, T=0.3), 2 / (0.3 * S + 1)),
    "SecondOrder": (blocks.SecondOrder(k=2, w=5, D=0.2), 2 / ((S / 5) ** 2 + 0.4 * S / 5 + 1)),
    "PI": (blocks.PI(k=2, T=0.3), 2 * (1 + 1 / (0.3 * S))),
    "PID": (blocks.PID(k=2, Ti=0.3, Td=0.2, Nd=5), 2 * (1 + 1 / (0.3 * S) + 0.2 * S / (0.04 * S + 1))),
    "TransferFunction": (
        blocks.TransferFunction(b=(1, 2, 3), a=(2, 4, 6, 8)),
        (S**2 + 2 * S + 3) / (2 * S**3 + 4 * S**2 + 6 * S + 8),
    ),
    "feedthrough": (blocks.TransferFunction(b=(2, 1), a=(1, 3)), (2 * S + 1) / (S + 3)),
    "constant": (blocks.TransferFunction(b=(2,), a=(4,)), 0.5 + 0 * S),
    "CriticalDamping": (blocks.CriticalDamping(n=3, f=2, normalized=False), 1 / (S / (4 * np.pi) + 1) ** 3),
    **{
        f"LowpassButterworth {n}": (
            blocks.LowpassButterworth(n=n, f=1.5),
            signal.freqs(*signal.butter(n, 3 * np.pi, analog=True), W)[1],
        )
        for n in (1, 2, 3, 4, 5)
    },
}


@pytest.mark.parametrize("name", LINEAR)
def test_transfer_functions(name):
    block, expected = LINEAR[name]
    np.testing.assert_allclose(response(block), expected, rtol=1e-10)


def test_critical_damping_is_normalized():
    block = blocks.CriticalDamping(n=4, f=W[10] / (2 * np.pi))
    assert abs(response(block)[10]) == pytest.approx(2**-0.5)


def run(block, stop_time=3.0, tolerance=1e-8, **inputs):
    """Return the times and outputs of a block whose inputs are expressions, or functions that return them."""

    class Alone(Model):
        part = block
        y: Scalar = output("output")

        def equations(self):
            for name, value in inputs.items():
                yield getattr(self.part, name) == (value() if callable(value) else value)
            yield self.y == self.part.y

    result = ac.simulate(Alone(), stop_time=stop_time, tolerance=tolerance)
    return result.time, result["y"], result


def wave(t, phase=0.0):
    return 1.5 * np.sin(3 * t + phase)


U, V = 1.5 * sin(3 * now), 1.5 * sin(3 * now + 1)
ONE = {
    "Limiter": (blocks.Limiter(u_max=1, u_min=-0.5), lambda u: np.clip(u, -0.5, 1)),
    "DeadZone": (blocks.DeadZone(u_max=0.5), lambda u: np.where(abs(u) > 0.5, u - 0.5 * np.sign(u), 0)),
    "Abs": (blocks.Abs(), np.abs),
    "WrapAngle": (blocks.WrapAngle(u=4 * U), lambda u: (4 * u + np.pi) % (2 * np.pi) - np.pi),
    "positive WrapAngle": (blocks.WrapAngle(u=4 * U, positive_range=True), lambda u: (4 * u) % (2 * np.pi)),
    "CombiTable1D": (
        blocks.CombiTable1D(data=Table([-2, 0, 2], [1, 2, 0])),
        lambda u: np.interp(u, [-2, 0, 2], [1, 2, 0]),
    ),
    "GreaterThreshold": (blocks.GreaterThreshold(threshold=0.3), lambda u: u > 0.3),
    "Not": (blocks.Not(), lambda u: u <= 0.5),
}
TWO = {
    "Add": (blocks.Add(k1=2, k2=-1), lambda u, v: 2 * u - v),
    "Feedback": (blocks.Feedback(), lambda u, v: u - v),
    "Product": (blocks.Product(), np.multiply),
    "Min": (blocks.Min(), np.minimum),
    "Max": (blocks.Max(), np.maximum),
    "And": (blocks.And(), lambda u, v: (u > 0.5) & (v > 0.5)),
    "Or": (blocks.Or(), lambda u, v: (u > 0.5) | (v > 0.5)),
    "Xor": (blocks.Xor(), lambda u, v: (u > 0.5) ^ (v > 0.5)),
    "Greater": (blocks.Greater(), np.greater),
}


@pytest.mark.parametrize("name", [*ONE, *TWO])
def test_formulas(name):
    block, formula = (ONE | TWO)[name]
    if name in ONE:
        t, y, _ = run(block, **({} if "Wrap" in name else {"u": U}))
        expected = formula(wave(t))
    else:
        t, y, _ = run(block, u1=U, u2=V)
        expected = formula(wave(t), wave(t, 1.0))
    assert np.mean(np.abs(y - expected) > 1e-6) < 0.01  # rows at jumps may have either value


def test_switch_and_hysteresis():
    t, y, _ = run(blocks.Switch(), u1=1.0, u2=lambda: ac.piecewise((1, U > 0.5), 0), u3=V)
    assert np.mean(np.abs(y - np.where(wave(t) > 0.5, 1.0, wave(t, 1.0))) > 1e-6) < 0.01
    t, y, _ = run(blocks.Hysteresis(u_low=-1, u_high=1), u=U)
    on, expected = False, []
    for u in wave(t):
        on = u > 1 or (on and u >= -1)
        expected.append(on)
    assert np.mean(np.abs(y - expected) > 1e-6) < 0.01


def test_slew_rate():
    t, y, _ = run(blocks.SlewRateLimiter(rising=2, falling=-1, Td=1e-3), u=U)

    def rate(t, y):
        return np.clip((wave(t) - y) / 1e-3, -1, 2)

    exact = solve_ivp(rate, (0, 3), [0], method="LSODA", t_eval=t, rtol=1e-9, atol=1e-10, max_step=1e-3)
    np.testing.assert_allclose(y, exact.y[0], atol=1e-5)


def test_limited_integrator_does_not_wind_up():
    t, y, _ = run(blocks.LimIntegrator(k=2, out_max=0.6, out_min=-0.2), u=U)
    value, expected, fine = 0.0, [], np.linspace(0, 3, 300001)
    for u in wave(fine):
        expected.append(value)
        value = min(max(value + 2 * u * 1e-5, -0.2), 0.6)
    np.testing.assert_allclose(y, np.interp(t, fine, expected), atol=1e-4)


def test_integrator_resets():
    t, y, result = run(
        blocks.Integrator(use_reset=True, y_start=0.5), u=1.0, reset=lambda: ac.piecewise((1, sin(4 * now) > 0.5), 0)
    )
    assert result.stats.events >= 2
    at = (np.arcsin(0.5) + 2 * np.pi * np.arange(2)) / 4
    expected = 0.5 + t - np.where(t > at[0], at[0], 0) - np.where(t > at[1], at[1] - at[0], 0)
    np.testing.assert_allclose(y, expected, atol=1e-6)


@pytest.mark.parametrize("kind", ["P", "PI", "PD", "PID"])
def test_limited_pid_in_a_loop(kind):
    """A plant x' = 5 u - x follows a step; the equations of Astrom and Hagglund 1995, 3.5, by scipy."""
    given = {"k": 3.0, "Ti": 0.4, "Td": 0.05, "y_max": 1.0, "wp": 0.8, "wd": 0.1, "Ni": 0.9, "Nd": 10.0}

    class Loop(Model):
        pid = blocks.LimPID(controller_type=kind, u_s=2.0, **given)
        plant = blocks.FirstOrder(k=5, T=1)
        y: Scalar = output("controlled")

        def connections(self):
            yield connect(self.pid.y, self.plant.u)
            yield connect(self.plant.y, self.pid.u_m)

        def equations(self):
            yield self.y == self.plant.y

    result = ac.simulate(Loop(), stop_time=4, tolerance=1e-8)

    def rates(t, s):
        x, i, d = s
        lag = given["Td"] / given["Nd"]
        slope = (given["wd"] * 2 - x - d) / lag
        free = given["k"] * (given["wp"] * 2 - x + ("I" in kind) * i + ("D" in kind) * given["Td"] * slope)
        out = np.clip(free, -1, 1)
        return [5 * out - x, (2 - x + (out - free) / (given["k"] * given["Ni"])) / given["Ti"], slope]

    exact = solve_ivp(
        rates, (0, 4), [0, 0, 0], method="Radau", t_eval=result.time, rtol=1e-8, atol=1e-10, max_step=0.01
    )
    np.testing.assert_allclose(result["y"], exact.y[0], atol=1e-5)


def test_state_spaces_of_others():
    control = pytest.importorskip("control")
    A, B, C, D = np.array([[0, 1], [-4, -1]]), [[0], [1]], [[1, 0], [0, 1]], [[0], [2]]

    class Alone(Model):
        v: Scalar = input("input")
        part = blocks.StateSpace(system=control.StateSpace(A, B, C, D), x_start=[1, 2])
        y = output("outputs", shape=(2,))

        def equations(self):
            yield self.part.u[0] == self.v
            yield self.y == self.part.y

    found = ac.linearize(Alone())
    for system in (found.to_control(), found.to_scipy()):
        assert [np.asarray(getattr(system, name)).tolist() for name in "ABCD"] == [A.tolist(), B, C, D]
    assert found.to_control().output_labels == ["y[0]", "y[1]"]
    assert ac.simulate(Alone(), stop_time=1)["part.x"][0].tolist() == [1, 2]
    with pytest.raises(DeclarationError, match=r"sampled, with a period of 0\.1 s"):
        ac.compile(blocks.StateSpace(system=control.StateSpace(A, B, C, D, 0.1), u=[0.0]))
    with pytest.raises(DeclarationError, match=r"matrix B of a state space has shape"):
        ac.compile(blocks.StateSpace(A=A, B=[[1]], C=C, u=[0.0]))


T = 0.1


def samples(t):
    """Return the number of the last sample before each time."""
    return np.floor(t / T + 1e-9).astype(int)


def test_samplers():
    for cls in (blocks.Sampler, blocks.ZeroOrderHold):
        t, y, _ = run(cls(sample_period=T), u=U)
        np.testing.assert_allclose(y[1:], wave(samples(t) * T)[1:], atol=1e-9)

    class Delayed(Model):
        first = blocks.Sampler(sample_period=T, u=U)
        then = blocks.UnitDelay(sample_period=T, y_start=7)
        stop_time = 3

        def connections(self):
            yield connect(self.first.y, self.then.u)

    result = ac.simulate(Delayed())
    t, y = result.time, result["then.y"]
    expected = np.where(samples(t) < 1, 0, wave((samples(t) - 1) * T))
    np.testing.assert_allclose(y[1:], expected[1:], atol=1e-9)
    t, y, _ = run(blocks.FirstOrderHold(sample_period=T), u=U)
    k = samples(t)
    slope = np.where(k < 1, 0, (wave(k * T) - wave((k - 1) * T)) / T)
    np.testing.assert_allclose(y[1:], (wave(k * T) + slope * (t - k * T))[1:], atol=1e-8)


def test_sampled_controllers():
    k = np.arange(31)
    u = wave(k * T)
    t, y, _ = run(blocks.DiscretePID(sample_period=T, k=2, Ti=0.5, Td=0.05), u=U)
    pid = 2 * (u + T / 0.5 * np.cumsum(u) + 0.05 / T * np.diff(u, prepend=0))
    np.testing.assert_allclose(y[1:], pid[samples(t)][1:], atol=1e-8)
    b, a = (0.2, 0.1, 0.3), (1, -0.5, 0.2)
    t, y, _ = run(blocks.DiscreteTransferFunction(sample_period=T, b=b, a=a), u=U)
    np.testing.assert_allclose(y[1:], signal.lfilter(b, a, u)[samples(t)][1:], atol=1e-8)


def test_triggered_sampler_and_timer():
    t, y, _ = run(blocks.TriggeredSampler(y_start=9), u=now, trigger=lambda: ac.piecewise((1, U < 0), 0))
    assert y[0] == pytest.approx(9)
    assert y[-1] == pytest.approx(np.pi / 3, abs=1e-6)
    t, y, _ = run(blocks.Timer(), u=lambda: ac.piecewise((1, U > 0), 0))
    phase = t % (2 * np.pi / 3)
    inside = (phase > 1e-3) & (abs(phase - np.pi / 3) > 1e-3)
    np.testing.assert_allclose(y[inside], np.where(phase < np.pi / 3, phase, 0)[inside], atol=1e-6)


def test_point_to_point():
    class Robot(Model):
        way = blocks.KinematicPTP2(nout=2, q_end=[1, -3], qd_max=[0.5, 1], qdd_max=[1, 2], start_time=0.2)
        rate = blocks.KinematicPTP(nout=2, deltaq=[1, -3], qd_max=[0.5, 1], qdd_max=[1, 2], start_time=0.2)
        stop_time = 5

    result = ac.simulate(Robot())
    q, qd, qdd = (result[f"way.{name}"] for name in ("q", "qd", "qdd"))
    # The second coordinate is the slowest: 0.5 s to its speed, 2.5 s at it.
    for t, expected in ((0.2, 0), (0.7, -0.25), (3.2, -2.75), (3.7, -3), (5, -3)):
        assert np.interp(t, result.time, q[:, 1]) == pytest.approx(expected, abs=1e-9)
    np.testing.assert_allclose(q[:, 0], -q[:, 1] / 3, atol=1e-12)
    assert np.max(np.abs(qd[:, 1])) == pytest.approx(1)
    np.testing.assert_array_equal(qdd, result["rate.y"])


def test_noise_has_its_seed():
    def values(**given):
        return run(blocks.NormalNoise(sample_period=0.01, **given), stop_time=10)[1]

    first = values(seed=3)
    np.testing.assert_array_equal(first, values(seed=3))
    assert not np.allclose(first, values(seed=4))
    assert abs(np.std(first) - 1) < 0.2
