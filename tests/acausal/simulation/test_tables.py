"""Tables in equations: values, derivatives, jumps, kinks, and changes without compiling."""

from __future__ import annotations

import gc

import numpy as np
import pytest
from scipy.interpolate import Akima1DInterpolator, CubicSpline

import acausal as ac
from acausal import (
    DeclarationError,
    Model,
    Scalar,
    SimulationError,
    Table,
    der,
    output,
    parameter,
    structural,
    table,
    variable,
)
from acausal import time as now
from acausal.core.columns import COLUMNS
from tests.acausal.language.test_table import KINDS, X, Y


class Integral(Model):
    data: Table = structural("points", cls=Table)
    t0: Scalar = parameter("shift", unit="s", default=0.29)
    s: Scalar = variable("integral", fixed=True)
    u: Scalar = output("value")
    stop_time = 10

    def equations(self):
        yield self.u == table(now - self.t0, self.data)
        yield der(self.s) == self.u


def integrals(data, times):
    """Return the integral of a table from -0.29 on, by the trapezoidal rule between its points."""
    inside = (data.x[:, None] + 3 * np.arange(-1, 4)).ravel()
    inside = inside[(inside > -0.29) & (inside < times[-1])]
    fine = np.unique(np.concatenate([np.linspace(-0.29, times[-1], 200001), inside, inside - 1e-12]))
    values = data(fine)
    steps = np.concatenate([[0.0], np.cumsum((values[1:] + values[:-1]) / 2 * np.diff(fine))])
    return np.interp(times, fine, steps)


@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.parametrize("extrapolation", ["hold", "linear", "periodic"])
@pytest.mark.parametrize("jumps", [False, True])
def test_tables_of_time(kind, extrapolation, jumps):
    x = np.array([0, 0.7, 1, 1 if jumps else 1.2, 1.9, 3])
    data = Table(x, [0, 1, 3, 2, -1, 0.5], kind, extrapolation)
    result = ac.simulate(Integral(data=data), tolerance=1e-8, intervals=100)
    np.testing.assert_allclose(result["u"], data(result.time - 0.29), atol=1e-13)
    np.testing.assert_allclose(result["s"], integrals(data, result.time - 0.29), atol=2e-6)


@pytest.mark.parametrize(("method", "most", "error"), [("rosenbrock", 101, 1e-12), ("idas", 1000, 5e-3)])
def test_steps_end_at_the_points_of_a_line_without_a_restart(method, most, error):
    data = Table(np.arange(101) / 10, np.random.default_rng(0).normal(size=101))
    result = ac.simulate(Integral(data=data, t0=0), tolerance=1e-4, method=method)
    assert 100 <= result.stats.steps <= most
    assert result.stats.events == 0
    assert result["s"][-1] == pytest.approx(np.sum(data.values[1:] + data.values[:-1]) / 20, abs=error)


class Derived(Model):
    data: Table = structural("points", cls=Table)
    x: Scalar = variable("argument", fixed=True, start=X[0])
    v: Scalar = output("first derivative")
    w: Scalar = output("second derivative")
    stop_time = X[-1] - X[0]

    def equations(self):
        yield der(self.x) == 1
        yield self.v == der(table(self.x, self.data))
        yield self.w == der(self.v)


@pytest.mark.parametrize(
    ("kind", "exact"), [("akima", Akima1DInterpolator(X, Y)), ("cubic", CubicSpline(X, Y, bc_type="natural"))]
)
def test_derivatives_are_exact(kind, exact):
    result = ac.simulate(Derived(data=Table(X, Y, kind)), tolerance=1e-9)
    x = result["x"]
    inside = np.min(np.abs(x[:, None] - X), axis=1) > 1e-6
    for name, order in (("v", 1), ("w", 2)):
        np.testing.assert_allclose(result[name][inside], exact(x[inside], order), atol=1e-6)


class Prescribed(Model):
    data: Table = structural("points", cls=Table)
    x: Scalar = variable("position")
    v: Scalar = variable("speed")
    a: Scalar = output("acceleration")
    stop_time = 1

    def equations(self):
        yield self.x == table(now, self.data)
        yield der(self.x) == self.v
        yield der(self.v) == self.a


def test_jumps_of_accelerations_are_told():
    for kind, is_told in (("akima", True), ("cubic", False)):
        assert ("data: accelerations jump" in ac.compile(Prescribed(data=Table(X, Y, kind))).summary()) == is_told


def test_a_line_has_no_second_derivative():
    with pytest.raises(DeclarationError, match=r'second derivative of `data` is needed, a linear table.*kind="akima"'):
        ac.compile(Prescribed(data=Table([0, 1, 2], [0, 1, 3])))
    with pytest.raises(DeclarationError, match="is infinite at its points"):
        ac.compile(Twice(data=Table([0, 1, 2], [0, 1, 3])))
    result = ac.simulate(Prescribed(data=Table([0, 0.5, 1], [0, 1, 3], "akima")), intervals=10)
    assert result["a"] == pytest.approx(4.0)


class Twice(Model):
    data: Table = structural("points", cls=Table)
    a: Scalar = output("acceleration")
    stop_time = 1

    def equations(self):
        yield self.a == der(der(table(now, self.data)))


class Inverse(Model):
    data: Table = structural("points", cls=Table)
    y: Scalar = variable("argument", start=0.1)
    stop_time = 1

    def equations(self):
        yield table(self.y, self.data) == 1 + now


@pytest.mark.parametrize("kind", ["linear", "akima", "steffen", "cubic"])
def test_equations_are_solved_for_arguments(kind):
    data = Table([0, 1, 2, 4], [0, 0.7, 1.3, 4], kind)
    result = ac.simulate(Inverse(data=data))
    np.testing.assert_allclose(data(result["y"]), 1 + result.time, atol=1e-8)


class Surface(Model):
    data: Table = structural("points", cls=Table)
    x: Scalar = variable("argument", fixed=True)
    z: Scalar = output("height")
    slope: Scalar = output("slope")
    stop_time = 1

    def equations(self):
        yield der(self.x) == 2
        yield self.z == table((self.x, now), self.data)
        yield self.slope == der(self.z)


@pytest.mark.parametrize("kind", ["constant", "linear", "akima"])
def test_surfaces(kind):
    grid = np.linspace(0, 2, 9)
    data = Table((grid, grid), np.sin(grid)[:, None] * np.exp(grid), kind)
    result = ac.simulate(Surface(data=data), tolerance=1e-9, intervals=37)
    np.testing.assert_allclose(result["z"], data(result["x"], result.time), atol=1e-12)
    x, t, h = result["x"][1:-1], result.time[1:-1], 1e-6
    by_difference = (data(x + 2 * h, t + h) - data(x - 2 * h, t - h)) / (2 * h)
    np.testing.assert_allclose(result["slope"][1:-1], by_difference, atol=1e-4)


class Vectors(Model):
    data: Table = structural("points", cls=Table)
    u = output("values", shape=(2,))
    stop_time = 1

    def equations(self):
        yield self.u == table(now, self.data)


def test_vectors():
    result = ac.simulate(Vectors(data=Table([0, 1], [[0, 5], [1, 3]])), intervals=2)
    assert result["u"].tolist() == [[0, 5], [0.5, 4], [1, 3]]


def test_values_are_changed_without_compiling():
    first, second = Table(X, Y, "akima"), Table(X[:7], 2 * Y[:7], "akima")
    compiled = ac.compile(Integral(data=first))
    before = ac.simulate(compiled)
    changed = ac.simulate(compiled, parameters={"data": second})
    np.testing.assert_array_equal(changed["s"], ac.simulate(Integral(data=second))["s"])
    np.testing.assert_array_equal(ac.simulate(compiled)["s"], before["s"])
    for wrong, why in ((Table(X, Y), "are fixed when compiled"), ([[0, 1]], "it must be a Table")):
        with pytest.raises(DeclarationError, match=why):
            ac.simulate(compiled, parameters={"data": wrong})


def test_numbers_last_as_long_as_their_table():
    number = Table(X, Y).number
    gc.collect()
    assert not COLUMNS._places[-1][number]


def test_what_lies_beyond_is_refused():
    data = Table([0, 5], [0, 1], extrapolation="refuse")
    assert np.isfinite(ac.simulate(Integral(data=data, t0=0), stop_time=5)["s"]).all()
    with pytest.raises(SimulationError, match=r"looks up .* in a table that ends before, and refuses to extrapolate"):
        ac.simulate(Integral(data=data, t0=0), stop_time=6)


class Jumping(Model):
    x: Scalar = variable("argument", fixed=True)
    y: Scalar = output("value")
    stop_time = 1

    def equations(self):
        yield der(self.x) == 1
        yield self.y == table(self.x, Table([0, 1, 1, 2], [0, 1, 2, 3]))


def test_jumps_are_for_time_alone():
    with pytest.raises(DeclarationError, match=r"test_tables\.py:\d+: <Table of 4 points.* jumps"):
        ac.compile(Jumping())


@pytest.mark.parametrize("version", [2, 3])
@pytest.mark.parametrize(
    "data",
    [Table([0, 1, 1, 4], [0, 1, 3, -1]), Table([0, 1, 2], [0, 1, 5], "constant", "periodic"), Table(X, Y, "akima")],
)
def test_fmus_have_tables(version, data, tmp_path):
    fmpy = pytest.importorskip("fmpy")
    path = tmp_path / "table.fmu"
    ac.export_fmu(Integral(data=data), path, fmi_version=version)
    own = ac.simulate(Integral(data=data), intervals=100)
    described = fmpy.read_model_description(path)
    assert "data" not in {v.name for v in described.modelVariables}
    for kind, atol in (("CoSimulation", 1e-5), ("ModelExchange", 1e-3)):
        found = fmpy.simulate_fmu(
            path, fmi_type=kind, stop_time=10, output_interval=0.1, output=["s"], relative_tolerance=1e-6
        )
        np.testing.assert_allclose(np.interp(own.time, found["time"], found["s"]), own["s"], atol=atol)


def test_an_open_dae_has_tables(tmp_path):
    compiled = ac.compile(Integral(data=Table([0, 1, 1, 4], [0, 1, 3, -1])))
    ac.export_dae(compiled, tmp_path / "table.dae")
    loaded, other = ac.load_dae(tmp_path / "table.dae"), Table([0, 1, 1, 4], [5, 1, 3, -1])
    for parameters in ({}, {"data": other}):
        a, b = (ac.simulate(c, parameters=parameters)["s"] for c in (compiled, loaded))
        np.testing.assert_array_equal(a, b)


class Watched(Model):
    """An argument that swings to and fro over a table, and jumps once."""

    rule: Table = structural("table", cls=Table)
    events: bool = structural("whether its points are events", default=True)
    x: Scalar = variable("argument", start=0.9, fixed=True)
    v: Scalar = variable("its rate", unit="1/s", start=0, fixed=True)
    y: Scalar = output("value")
    jumped: Scalar = ac.discrete("whether it has jumped", start=0)

    def equations(self):
        yield der(self.x) == self.v
        yield ac.quantity(1, "s2") * der(self.v) == -10 * self.y
        yield self.y == table(self.x, self.rule, events=self.events)
        yield ac.when(now >= 1, ac.reinit(self.x, self.x - 0.5), ac.reinit(self.jumped, 1))


@pytest.mark.parametrize("extrapolation", ["linear", "periodic"])
def test_points_are_events_on_request(extrapolation):
    x = np.linspace(-1, 1, 9) if extrapolation == "linear" else np.linspace(-0.3, 0.7, 5)
    rule = Table(x, np.sin(3 * x) if extrapolation == "linear" else [0, 0.5, 0.2, -0.7, 0], extrapolation=extrapolation)
    found, plain = (ac.simulate(Watched(rule=rule, events=e), stop_time=2, tolerance=1e-7) for e in (True, False))
    exact = ac.simulate(Watched(rule=rule), stop_time=2, tolerance=1e-11)
    np.testing.assert_allclose(found["y"], rule(found["x"]), atol=1e-9)
    np.testing.assert_allclose(found["x"], exact["x"], atol=3e-6)
    np.testing.assert_allclose(plain["x"], exact["x"], atol=1e-3)
    at = np.array([np.interp(t, exact.time, exact["x"]) for t in exact.stats["event_times"]])
    if extrapolation == "linear":
        np.testing.assert_allclose(at, x[-2:-9:-1], atol=1e-2)
