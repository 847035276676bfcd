"""Break times: hit exactly, each law valid up to its end."""

from __future__ import annotations

import numpy as np
import pytest

import acausal as ac
from acausal import Model, Scalar, der, output, parameter, piecewise, time, variable


class Switched(Model):
    """Integral of a rate that switches at two times."""

    first: Scalar = parameter("first switch", unit="s", default=0.3)
    x: Scalar = variable("integral", start=0, fixed=True)
    rate: Scalar = output("rate")

    def equations(self):
        yield self.rate == piecewise((1, time < self.first), (-2, time < 2 * self.first), 5)
        yield der(self.x) == self.rate


def test_switches_are_hit_exactly():
    result = ac.simulate(Switched(), stop_time=1.0, intervals=7, tolerance=1e-10)
    np.testing.assert_allclose(result.stats["break_times"], [0.3, 0.6])
    t = result.time
    exact = np.where(t <= 0.3, t, np.where(t <= 0.6, 0.3 - 2 * (t - 0.3), -0.3 + 5 * (t - 0.6)))
    np.testing.assert_allclose(result["x"], exact, atol=1e-12)


def test_break_times_follow_parameters_of_a_compiled_model():
    compiled = ac.compile(Switched())
    result = ac.simulate(compiled, stop_time=1.0, intervals=10, parameters={"first": 0.4})
    assert result["x"][-1] == pytest.approx(0.4 - 0.8 + 5 * 0.2, abs=1e-9)


class Piston(Model):
    """Decay and input of a linear system."""

    u: Scalar = ac.input("input", unit="1")
    x: Scalar = variable("state", start=0, fixed=True)
    y: Scalar = output("output")

    def equations(self):
        yield der(self.x) == -3 * self.x + 2 * self.u
        yield self.y == 4 * self.x + self.u


def test_linearisation_has_inputs_and_outputs():
    linear = ac.linearize(Piston())
    assert [m.tolist() for m in (linear.A, linear.B, linear.C, linear.D)] == [[[-3]], [[2]], [[4]], [[1]]]
    assert (linear.states, linear.inputs, linear.outputs) == (("x",), ("u",), ("y",))


def test_input_is_a_parameter_at_the_top():
    result = ac.simulate(Piston(), stop_time=10.0, parameters={"u": 3.0})
    assert result["x"][-1] == pytest.approx(2.0, abs=1e-4)
