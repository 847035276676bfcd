"""A result of a model from states that another method has found."""

from __future__ import annotations

import pickle
import re

import numpy as np
import pytest

import acausal as ac
from acausal import (
    Model,
    Scalar,
    Vector3,
    der,
    discrete,
    fixed,
    output,
    parameter,
    piecewise,
    quantity,
    reinit,
    time,
    variable,
    when,
)
from models import SCENES, FourBar


class Cart(Model):
    """Mass between a stop and a spring, pushed by a force that ends, with an implicit law."""

    m: Scalar = parameter("mass", unit="kg", default=2.0)
    x: Scalar = variable("position", unit="m", start=0.0, fixed=True)
    v: Scalar = variable("speed", unit="m/s", start=0.0, fixed=True)
    a: Scalar = variable("acceleration", unit="m/s2")
    same: Scalar = variable("another name of the acceleration", unit="m/s2")
    opposite: Scalar = variable("its opposite", unit="m/s2")
    stop: Scalar = variable("force of the stop", unit="N")
    drag: Scalar = variable("drag, implicitly", unit="N")
    pair: Vector3 = variable("what follows from it", unit="m/s2")
    weight: Scalar = output("force of inertia", unit="N")

    def equations(self):
        push = piecewise((quantity(3, "N"), time < 1.0), quantity(0, "N"))
        gap, c = self.x - quantity(0.5, "m"), quantity(1, "N/m")
        yield from (self.v == der(self.x), self.a == der(self.v))
        yield self.stop == piecewise((-200 * c * gap, self.x > 0.5), quantity(0, "N"))
        yield self.drag + self.drag**3 * quantity(0.1, "1/N2") == -self.v * quantity(1, "N.s/m")
        yield self.m * self.a == push + self.stop + self.drag - c * self.x
        yield from (self.same == self.a, self.opposite == -self.a)
        yield self.pair == (self.a, 2 * self.a, self.v * quantity(1, "1/s"))
        yield self.weight == self.m * self.same


def states(result: ac.Result, compiled: ac.CompiledModel) -> dict:
    return {name: result[name] for name in compiled.states}


def near(found: ac.Result, result: ac.Result, bound: float = 1e-9) -> None:
    for name in result:
        size = np.abs(result[name]).max(initial=0.0)
        np.testing.assert_allclose(found[name], result[name], rtol=0, atol=bound * size)


def test_states_give_everything_of_a_model():
    """Also switches by states and by time, and what is implicit."""
    compiled = ac.compile(Cart())
    result = ac.simulate(compiled, stop_time=4, parameters={"m": 3.0}, intervals=403)
    assert result["x"].max() > 0.5
    found = ac.result_of(result.time, states(result, compiled), model=compiled, parameters={"m": 3.0}, steps=7)
    near(found, result)
    assert found.outputs == ("weight",)
    assert (found.stats.steps, found.stats.states, found.title) == (7, 2, "Cart")
    np.testing.assert_allclose(found[compiled.tree.a - compiled.tree.same], 0, atol=1e-12)
    near(ac.result_of(result.time, states(result, compiled), model=Cart(m=3.0)), result)


@pytest.mark.parametrize("name", ["pendulum", "spin-up", "simple-pendulum", "free-vibration"])
def test_scenes(name):
    compiled = ac.compile(SCENES[name]())
    if compiled.constraints.size:
        pytest.skip("closed loops")
    result = ac.simulate(compiled, stop_time=0.05, intervals=20)
    own = {re.sub(r"\[[\d,]*\]$", "", state) for state in compiled.states}
    values = {path: result[path] for path in result if path in own}
    near(ac.result_of(result.time, values, model=compiled), result)


def test_what_is_given_stays_and_is_propagated():
    compiled = ac.compile(Cart())
    result = ac.simulate(compiled, stop_time=1, intervals=10)
    own = 7 + np.arange(11.0)
    for name, sign in (("a", 1), ("same", 1), ("opposite", -1)):
        values = states(result, compiled) | {name: (own, "m/s2"), "extra.of[1].it": (np.ones((11, 2, 2)), "N")}
        found = ac.result_of(result.time, values, model=compiled)
        np.testing.assert_array_equal(found[name], own)
        np.testing.assert_array_equal(found["a"], sign * own)
        np.testing.assert_array_equal(found["opposite"], -sign * own)
        np.testing.assert_array_equal(found["pair"], np.column_stack([sign * own, 2 * sign * own, result["v"]]))
        np.testing.assert_allclose(found["weight"], 2 * sign * own, rtol=1e-15)
        np.testing.assert_array_equal(found["extra.of[1].it[0,1]"], 1)
        assert "extra.of[1].it" in found
        assert list(found)[-1] == "extra.of[1].it"
        assert list(found.to_dataframe("weight", "extra.of[1].it").columns)[-1] == "extra.of[1].it[1,1]"
        again = pickle.loads(pickle.dumps(found))
        assert list(again) == list(found)
        for path in found:
            np.testing.assert_array_equal(again[path], found[path])
        np.testing.assert_array_equal(found.with_stats(steps=3)["extra.of[1].it"], found["extra.of[1].it"])
    with pytest.raises(ac.DeclarationError, match="extra"):
        found["extra.of[1].is"]
    assert ac.result_of(result.time, values, ["extra.of[1].it"], model=compiled).outputs == ("extra.of[1].it",)


def test_of_no_times():
    empty = ac.result_of([], {"x": ([], "m"), "v": ([], "m/s")}, model=Cart())
    assert empty["weight"].shape == (0,)


class Bounces(Model):
    """A ball on a floor: speeds jump, which its states tell."""

    h: Scalar = variable("height", unit="m", start=1.0, fixed=True)
    v: Scalar = variable("speed", unit="m/s", start=0.0, fixed=True)
    a: Scalar = variable("acceleration", unit="m/s2")

    def equations(self):
        yield self.v == der(self.h)
        yield self.a == der(self.v)
        yield self.a == -quantity(9.81, "m/s2")
        yield when(self.h < 0, reinit(self.v, -0.8 * self.v))


class Counts(Bounces):
    n: Scalar = discrete("bounces", start=0)

    def equations(self):
        yield from super().equations()
        yield when(self.h < 0, reinit(self.n, self.n + 1))


def test_jumps_of_states_are_in_the_states():
    compiled = ac.compile(Bounces())
    result = ac.simulate(compiled, stop_time=1.5)
    near(ac.result_of(result.time, states(result, compiled), model=compiled), result)


GOOD = {"x": ([0.0, 1.0], "m"), "v": ([0.0, 1.0], "m/s")}


@pytest.mark.parametrize(
    ("model", "values", "words"),
    [
        (Cart(), {"x": ([0.0, 1.0], "m")}, "values of 1 of 2 states are missing: `v`"),
        (Cart(), {}, "values of 2 of 2 states are missing: `x`, `v`"),
        (Cart(), GOOD | {"x": ([0.0, 1.0], "mm")}, "mm"),
        (Cart(), GOOD | {"x": ([0.0, 1.0], "s")}, "`x` is in m in the model, and in s in the values"),
        (Cart(), GOOD | {"x": (np.ones((2, 3)), "m")}, r"`x` has shape \(\) in the model, and \(3,\) in the values"),
        (Cart(), GOOD | {"more": [0.0, 1.0]}, "`more` needs an array and its unit"),
        (Cart(), GOOD | {"m": ([2.0, 2.0], "kg")}, "`m` is a parameter of the model: set it by parameters="),
        (
            Cart(),
            GOOD | {"a": ([2.0, 2.0], "m/s2"), "opposite": ([2.0, 2.0], "m/s2")},
            "`a` and `opposite` are one variable",
        ),
        (FourBar(), {}, "closed loops"),
        (Counts(), {"h": ([1.0, 1.0], "m"), "v": ([0.0, 0.0], "m/s")}, "discrete variables, which"),
        (Cart(), GOOD | {"x": [0.0, np.nan]}, "`x` is not finite at t = 1 s"),
        (Cart, GOOD, "give an instance"),
        ("cart", GOOD, "is a text"),
    ],
)
def test_refused(model, values, words):
    with pytest.raises(ac.DeclarationError, match=words):
        ac.result_of([0.0, 1.0], values, model=model)


def test_refused_outputs_and_parameters():
    with pytest.raises(ac.DeclarationError, match="output `y` is not among"):
        ac.result_of([0.0, 1.0], GOOD, ["y"], model=Cart())
    with pytest.raises(ac.DeclarationError, match="give it by model="):
        ac.result_of([0.0, 1.0], GOOD, parameters={"m": 1.0})
    with pytest.raises(ac.DeclarationError, match="mm"):
        ac.result_of([0.0, 1.0], GOOD, model=Cart(), parameters={"mm": 1.0})


class Root(Model):
    """A law without a value from x = 1 on: y^2 = 1 - x."""

    x: Scalar = variable("state", start=0.0, fixed=True)
    y: Scalar = output("root")

    def equations(self):
        yield der(self.x) == quantity(1, "1/s")
        yield self.y**2 + 1e-3 * self.y == 1 - self.x


def test_where_equations_have_no_solution_there_is_no_number():
    found = ac.result_of([0.0, 0.5, 2.0], {"x": [0.0, 0.5, 2.0]}, model=Root())
    with pytest.warns(ac.AcausalWarning, match="no unique solution: "):
        values = found["y"]
    assert np.isfinite(values).tolist() == [True, True, False]


def test_a_step_method_of_a_users_own():
    """Explicit midpoint steps of x'' = -x: the outputs are those of the motion that it found."""

    class Swing(Model):
        x: Scalar = variable("angle", unit="rad", start=1.0, fixed=True)
        w: Scalar = variable("rate", unit="rad/s", start=0.0, fixed=True)
        sum: Scalar = output("square", unit="rad2")

        def equations(self):
            yield self.w == der(self.x)
            yield der(self.w) == -self.x * quantity(1, "1/s2")
            yield self.sum == self.x**2

    h, n = 0.01, 100
    A = np.array([[1 - h * h / 2, h], [-h, 1 - h * h / 2]])
    path = np.array([np.linalg.matrix_power(A, k) @ (1, 0) for k in range(n + 1)])
    found = ac.result_of(h * np.arange(n + 1), {"x": (path[:, 0], "rad"), "w": (path[:, 1], "rad/s")}, model=Swing())
    np.testing.assert_allclose(found["sum"], path[:, 0] ** 2, rtol=1e-14)
    np.testing.assert_allclose(found["sum"], np.cos(found.time) ** 2, atol=1e-4)


def test_fixed_start_is_not_asked():
    """Values of a start that the states do not have are no reason to refuse them."""
    values = {"x": ([5.0, 6.0], "m"), "v": ([0.1, 0.2], "m/s")}
    assert ac.result_of([3.0, 4.0], values, model=Cart(x=fixed(1.0)))["stop"][0] == pytest.approx(-900)
