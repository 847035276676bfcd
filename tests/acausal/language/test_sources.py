"""Signals of time agree with their definition, with exact events, and can be differentiated."""

from __future__ import annotations

import numpy as np
import pytest
from scipy import signal

import acausal as ac
from acausal import (
    Model,
    Scalar,
    der,
    output,
    parameter,
    pulse,
    ramp,
    sine,
    step,
    time_table,
    trapezoid,
    variable,
)


class Source(Model):
    """The integral of a signal, and the signal."""

    height: Scalar = parameter("height", unit="N", default=3.0)
    begin: Scalar = parameter("beginning", unit="s", default=0.3)
    y: Scalar = output("signal", unit="N")
    x: Scalar = variable("integral", unit="N.s", start=0, fixed=True)

    def law(self):
        raise NotImplementedError

    def equations(self):
        yield self.y == self.law()
        yield der(self.x) == self.y


def run(law, **settings):
    model = type("Law", (Source,), {"law": lambda self: law(self)})
    return ac.simulate(model(), stop_time=4.0, intervals=160, tolerance=1e-9, **settings)


def away(result, instants):
    """Rows that are no instants of a jump."""
    return np.min(np.abs(result.time[:, None] - np.asarray(instants)[None, :]), axis=1) > 1e-9


def test_sine_begins_at_its_time_with_its_phase():
    result = run(lambda m: sine(m.height, f=1.5, phase=0.4, offset=2, start_time=m.begin))
    t = result.time
    right = 2 + np.where(t < 0.3, 0, 3 * np.sin(2 * np.pi * 1.5 * (t - 0.3) + 0.4))
    rows = away(result, [0.3])
    np.testing.assert_allclose(result["y"][rows], right[rows], atol=1e-12)
    assert result.stats["break_times"] == pytest.approx([0.3])


def test_step_and_ramp():
    result = run(lambda m: step(m.height, offset=-1, start_time=m.begin))
    assert result["x"][-1] == pytest.approx(-4 + 3 * 3.7, abs=1e-9)
    result = run(lambda m: ramp(m.height, duration=2, offset=-1, start_time=m.begin))
    np.testing.assert_allclose(result["y"], -1 + np.interp(result.time, [0.3, 2.3], [0, 3]), atol=1e-12)
    sudden = run(lambda m: ramp(m.height, duration=0, offset=-1, start_time=m.begin))
    assert sudden["x"][-1] == pytest.approx(-4 + 3 * 3.7, abs=1e-9)


@pytest.mark.parametrize(("width", "period", "n"), [(50, 1, -1), (30, 0.7, -1), (80, 0.9, 2), (1, 1.3, 3)])
def test_pulse(width, period, n):
    result = run(lambda m: pulse(m.height, width, period, n, offset=1, start_time=m.begin))
    passed = (result.time - 0.3) / period
    on = (passed >= 0) & (passed % 1 < width / 100) & ((n < 0) | (passed < n))
    edges = 0.3 + period * np.add.outer(np.arange(7), [0, width / 100]).ravel()
    rows = away(result, edges)
    np.testing.assert_allclose(result["y"][rows], 1 + 3 * on[rows], atol=1e-12)
    length = sum(min(4, e) - min(4, b) for b, e in edges.reshape(-1, 2)[: n if n > 0 else None])
    assert result["x"][-1] == pytest.approx(4 + 3 * length, abs=1e-8)


@pytest.mark.parametrize("shape", [(0.2, 0.3, 0.1), (0.0, 0.4, 0.3), (0.5, 0.0, 0.4), (0.9, 0.0, 0.0), (0.1, 0.6, 0.2)])
def test_trapezoid(shape):
    rising, width, falling = shape
    result = run(lambda m: trapezoid(m.height, rising, width, falling, period=1, offset=-2, start_time=m.begin))
    corners = np.cumsum([0, rising, width, falling])
    passed = (result.time - 0.3) % 1
    right = np.where(result.time < 0.3, 0, np.interp(passed, [*corners, 1], [0, 1, 1, 0, 0]))
    rows = away(result, 0.3 + np.add.outer(np.arange(5), corners).ravel())
    np.testing.assert_allclose(result["y"][rows], -2 + 3 * right[rows], atol=1e-9)


def test_a_triangle_is_that_of_scipy():
    result = run(lambda m: trapezoid(2, 0.6, 0, 0.4, period=1, offset=-1))
    np.testing.assert_allclose(result["y"], signal.sawtooth(2 * np.pi * result.time, 0.6), atol=1e-9)


def test_a_pulse_that_begins_at_the_start_holds_there():
    class Edges(Model):
        u: Scalar = variable("pulses")
        n: Scalar = ac.discrete("their edges", start=0)

        def equations(self):
            yield self.u == pulse(width=30, start_time=0.1)
            yield ac.when(self.u > 0.5, ac.reinit(self.n, self.n + 1))

    result = ac.simulate(Edges(), start_time=0.1, stop_time=2.6)
    assert (result["u"][0], result["n"][0], result["n"][-1]) == (1, 0, 2)


def test_time_table_jumps_where_two_times_are_equal_and_goes_on():
    rows = [(0, 1), (1, 2), (1, -1), (2, 0), (3, 4)]
    result = run(lambda m: time_table(rows, offset=0.5, start_time=0.25))
    t = result.time - 0.25
    right = np.select([t < 0, t < 1, t < 2], [0, 1 + t, t - 2], 4 * (t - 2))
    late = away(result, [0.25, 1.25])
    np.testing.assert_allclose(result["y"][late], 0.5 + right[late], atol=1e-12)


@pytest.mark.parametrize("rows", [[], [(1, 0), (0, 1)], [(0, 0), (1, 1), (1, 2), (1, 3)]])
def test_tables_whose_times_do_not_ascend(rows):
    with pytest.raises(ac.DeclarationError, match="ascending times"):
        time_table(rows)


def test_signals_as_arguments_of_a_class_body():
    from components.translational import Mass, Position

    class Driven(Model):
        reach: Scalar = parameter("amplitude", unit="m", default=0.2)
        drive, mass = Position(s_ref=sine(reach, f=2)), Mass(m=2)

        def connections(self):
            yield ac.connect(self.drive.flange, self.mass.flange_a)

    result = ac.simulate(Driven(), stop_time=1)
    w = 4 * np.pi
    np.testing.assert_allclose(result["mass.a"], -0.2 * w**2 * np.sin(w * result.time), atol=1e-9)
