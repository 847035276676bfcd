"""Data and functions of time for inputs of the whole model."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.integrate import solve_ivp

import acausal as ac
from acausal import DeclarationError, Model, Scalar, Table, der, input, output, quantity, sin, variable

T = np.linspace(0, 2, 201)
U = np.sin(5 * T)


class Quarter(Model):
    road: Scalar = input("height of the road", unit="m")
    force: Scalar = input("force", unit="N", default=2.0)
    s: Scalar = variable("height", unit="m", fixed=True)
    v: Scalar = variable("speed", unit="m/s", fixed=True)
    y: Scalar = output("height", unit="m")
    stop_time = 2

    def equations(self):
        yield self.y == self.s
        yield der(self.s) == self.v
        yield (
            der(self.v) * quantity(1, "kg")
            == quantity(100, "N/m") * (self.road - self.s) - quantity(1, "N.s/m") * self.v + self.force
        )


def exact(road, force=lambda t: 2.0):
    """Return the height at the end, by scipy."""

    def rates(t, y):
        return [y[1], 100 * (road(t) - y[0]) - y[1] + force(t)]

    return solve_ivp(rates, (0, 2), [0, 0], rtol=1e-11, atol=1e-12, max_step=0.01).y[0, -1]


def line(t):
    return np.interp(t, T, U)


@pytest.mark.parametrize("compiled", [False, True])
@pytest.mark.parametrize(
    ("data", "road"),
    [
        ((T, U), line),
        (([0, 2], [1, 3]), lambda t: 1 + t),
        (lambda t: sin(5 * t), lambda t: np.sin(5 * t)),
        (lambda t: np.sin(5 * t), lambda t: np.sin(5 * t)),
        (Table([0, 1], [0.0, 1.0], extrapolation="periodic"), lambda t: t % 1),
        (([0, 1, 2], [False, True, True]), lambda t: float(t >= 1)),
        ((quantity(T, "s"), quantity(U, "m")), line),
    ],
)
def test_data_and_functions(data, road, compiled):
    model = ac.compile(Quarter()) if compiled else Quarter()
    result = ac.simulate(model, inputs={"road": data}, tolerance=1e-8)
    assert result["y"][-1] == pytest.approx(exact(road), abs=1e-6)
    assert result["road"][100] == pytest.approx(road(0.5))


def test_pandas():
    pandas = pytest.importorskip("pandas")
    result = ac.simulate(Quarter(), inputs={"road": pandas.Series(U, index=T)}, tolerance=1e-8)
    assert result["y"][-1] == pytest.approx(exact(line), abs=1e-6)


def test_several_inputs_and_parameters():
    result = ac.simulate(Quarter(), inputs={"road": (T, U), "force": ([0, 2], [0, 4])}, tolerance=1e-8)
    assert result["y"][-1] == pytest.approx(exact(line, lambda t: 2 * t), abs=1e-6)
    result = ac.simulate(Quarter(), inputs={"road": (T, U)}, parameters={"force": 5.0}, tolerance=1e-8)
    assert result["y"][-1] == pytest.approx(exact(line, lambda t: 5.0), abs=1e-6)


def test_other_data_are_not_compiled():
    compiled = ac.compile(Quarter())
    first = ac.simulate(compiled, inputs={"road": (T, U)})
    second = ac.simulate(compiled, inputs={"road": (T[::2], -U[::2])})
    assert first["road"][100] == -second["road"][100]
    assert len([key for key in compiled.memo if isinstance(key, tuple) and "_driven" in str(key[0])]) == 1
    assert np.all(ac.simulate(compiled)["road"] == 0)


def test_data_have_to_cover_the_run():
    short = (T[:-5], U[:-5])
    with pytest.raises(DeclarationError, match=r"its data cover 0 s to 1\.95 s, the run 0 s to 2 s"):
        ac.simulate(Quarter(), inputs={"road": short})
    result = ac.simulate(Quarter(), inputs={"road": short}, extrapolation="hold")
    assert result["road"][-1] == U[-6]
    with pytest.raises(DeclarationError, match="it must be refuse or hold"):
        ac.simulate(Quarter(), inputs={"road": short}, extrapolation="guess")


@pytest.mark.parametrize(
    ("inputs", "message"),
    [
        ({"rod": (T, U)}, "no input of the whole model; did you mean `road`"),
        ({"road": (T, U[1:])}, r"input `road`: a table has a value for each point"),
        ({"road": 3.0}, r"parameters=\{'road': 1\.0\}"),
        ({"road": (T[::-1], U)}, "input `road`: the points of a table ascend"),
        ({"road": (T, np.where(T > 1, np.nan, U))}, "input `road`: a table has finite numbers"),
        ({"road": (T, quantity(U, "N"))}, r"its data are in \[N\], not in \[m\]"),
        ({"road": lambda t: float(t)}, "symbolic"),
        ({"road": (T, np.stack([U, U], axis=1))}, "it must be a scalar"),
        ({"road": lambda t: t.nothing}, "fails for an expression: AttributeError"),
        ({"force": Table(([0, 1], [0, 1]), np.eye(2))}, "one abscissa"),
    ],
)
@pytest.mark.parametrize("compiled", [False, True])
def test_wrong_inputs_are_refused(inputs, message, compiled):
    with pytest.raises(DeclarationError, match=message):
        ac.simulate(ac.compile(Quarter()) if compiled else Quarter(), inputs=inputs)


def test_an_input_has_one_value():
    with pytest.raises(DeclarationError, match="two values, in inputs and in parameters"):
        ac.simulate(Quarter(), inputs={"road": (T, U)}, parameters={"road": 1.0})


class Rate(Model):
    u: Scalar = input("position")
    v: Scalar = output("its derivative")
    stop_time = 1

    def equations(self):
        yield self.v == der(self.u)


def test_derivatives_of_inputs():
    with pytest.raises(DeclarationError, match=r'inputs=\{"u": Table\(times, values, kind="cubic"\)\}'):
        ac.simulate(Rate())
    smooth = Table(T, U, kind="cubic")
    result = ac.simulate(Rate(), inputs={"u": smooth})
    np.testing.assert_allclose(result["v"], 5 * np.cos(5 * result.time), atol=2e-4)


def test_linearize_at_values_of_inputs():
    model = Quarter()
    found = ac.linearize(model, inputs={"road": (T, U), "force": lambda t: 3 * t}, time=0.5)
    assert found.inputs == ("road", "force")
    np.testing.assert_allclose(found.B, [[0, 0], [100, 1]])


def test_study_and_accuracy_have_inputs():
    result = ac.simulate(Quarter(), inputs={"road": (T, U)}, accuracy=1e-4)
    assert result["y"][-1] == pytest.approx(exact(line), abs=2e-4)
    study = ac.study(Quarter(), inputs={"road": (T, U)}, tolerances=(1e-4,), repeats=1, workers=1)
    assert study.rows[0].error < 1e-3


def test_quantities_of_other_packages():
    units = pytest.importorskip("pint").UnitRegistry()
    data = (1000 * T * units.ms, 100 * np.array(U) * units.cm)
    result = ac.simulate(Quarter(), inputs={"road": data}, parameters={"force": 2.0}, tolerance=1e-8)
    np.testing.assert_allclose(result["y"][-1], exact(line), atol=1e-6)
    with pytest.raises(ac.UnitsError, match=r"input `road`.*cannot be converted to m"):
        ac.simulate(Quarter(), inputs={"road": (T, U * units.kg)})
