"""Laws of many pieces: a measured signal, a characteristic, a smooth table; the work grows as the number of pieces."""

from __future__ import annotations

import casadi as ca
import numpy as np
import pytest
from scipy.integrate import solve_ivp

import acausal as ac
from acausal import Model, Scalar, der, piecewise, structural, time, variable
from acausal.compiler.compile import compile as compiled_model
from acausal.symbols import Distinct

N = 60
TIMES = np.linspace(0, 10, N + 1)
HEIGHTS = np.cumsum(np.random.default_rng(0).normal(0, 0.02 / np.sqrt(N), N + 1))
PLACES = np.linspace(-4, 4, N + 1)
FORCES = PLACES**3


def pieces(at, places, values):
    slopes = np.diff(values) / np.diff(places)
    return [(values[i] + slopes[i] * (at - places[i]), at < places[i + 1]) for i in range(len(slopes))]


class Oscillator(Model):
    x: Scalar = variable("x", start=0, fixed=True)
    v: Scalar = variable("v", start=0, fixed=True)

    def equations(self):
        yield der(self.x) == self.v
        yield der(self.v) == self.force()


class Road(Oscillator):
    """A measured road under a wheel."""

    def force(self):
        return 100 * (piecewise(*pieces(time, TIMES, HEIGHTS), HEIGHTS[-1]) - self.x) - 2 * self.v


class Smooth(Oscillator):
    """The same, with the promise that no kink is to be resolved."""

    def force(self):
        return 100 * (piecewise(*pieces(time, TIMES, HEIGHTS), HEIGHTS[-1], smooth=True) - self.x) - 2 * self.v


class Spring(Oscillator):
    """A measured characteristic, which the motion passes over."""

    def force(self):
        return 3 * ac.sin(time) - piecewise(*pieces(self.x, PLACES, FORCES), FORCES[-1])


def road(t, y):
    return [y[1], 100 * (np.interp(t, TIMES, HEIGHTS) - y[0]) - 2 * y[1]]


def spring(t, y):
    return [y[1], 3 * np.sin(t) - np.interp(y[0], PLACES, FORCES)]


@pytest.mark.parametrize(("model", "rates"), [(Road, road), (Smooth, road), (Spring, spring)])
def test_motion_agrees_with_that_of_a_table(model, rates):
    result = ac.simulate(model(), stop_time=10, tolerance=1e-8)
    exact = solve_ivp(rates, (0, 10), [0, 0], t_eval=result.time, rtol=1e-9, atol=1e-11, max_step=0.02)
    np.testing.assert_allclose(result["x"], exact.y[0], atol=2e-6 * np.ptp(exact.y[0]))


class Long(Model):
    """A law of n pieces."""

    n: int = structural("number of pieces", cls=int)
    of_time: bool = structural("a law of time, or of the state", default=True)
    x: Scalar = variable("x", start=0, fixed=True)

    def equations(self):
        at = time if self.of_time else self.x
        places = np.linspace(0.1, 1, self.n + 1)
        yield der(self.x) == 1 - piecewise(*pieces(at, places, places**2), 1)


@pytest.mark.parametrize("of_time", [True, False])
def test_equal_conditions_are_searched_among_few(of_time, monkeypatch):
    counts = []
    compare = ca.is_equal
    monkeypatch.setattr(ca, "is_equal", lambda *of: counts.append(1) or compare(*of))
    compiled_model(Long(n=200, of_time=of_time))
    assert len(counts) < 200


@pytest.mark.parametrize("of_time", [True, False])
def test_reverse_derivatives_take_as_many_operations_as_there_are_pieces(of_time):
    def operations(n):
        equations = compiled_model(Long(n=n, of_time=of_time)).reduced.flat.equations
        symbols = ca.vertcat(*ca.symvar(equations.residuals))
        return ca.n_nodes(ca.jtimes(equations.residuals, symbols, 1, True))

    assert operations(400) < 5 * operations(100)


def test_distinct_expressions_are_those_that_casadi_tells_apart():
    x, y = ca.SX.sym("x"), ca.SX.sym("y")
    distinct = Distinct()
    assert [distinct.number(e, "<") for e in (x - 1, x - 2, x * y, y * x, x - 1, ca.SX(0), ca.SX(1, 1))] == [
        *(0, 1, 2, 2, 0),
        *(3, 3),
    ]
    assert distinct.number(x - 1, "<=") == 4
    deep = [ca.sin(ca.cos(ca.sin(ca.cos(ca.sin(x - k))))) for k in (1, 2, 1)]
    assert [distinct.number(e, "<") for e in deep] == [5, 6, 5]
