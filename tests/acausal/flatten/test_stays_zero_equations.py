"""Unknowns that stay 0 for ever: which equations vanish, and which operations and conditions keep an unknown."""

from __future__ import annotations

import numpy as np
import pytest

import acausal as ac
from acausal import (
    PREFER,
    Component,
    Model,
    Scalar,
    atan2,
    cos,
    der,
    discrete,
    exp,
    fixed,
    output,
    parameter,
    piecewise,
    reinit,
    sin,
    soft,
    sqrt,
    time,
    variable,
    when,
)


class Pair(Model):
    """The state z starts at 0; the state x moves."""

    k: Scalar = parameter("rate", default=2.0)
    z: Scalar = variable("may stay 0", select=PREFER, start=0, fixed=True)
    x: Scalar = variable("moves", select=PREFER, start=1, fixed=True)
    y: Scalar = output("both")

    def law(self):
        """Derivative of z."""
        return -self.k * self.z

    def equations(self):
        yield der(self.z) == self.law()
        yield der(self.x) == cos(time) - self.x * self.z
        yield self.y == self.x + self.z


def law_of(law, **fields) -> Model:
    return type("Case", (Pair,), {"law": law, **fields})()


VANISH = {
    "in products with factors that are not 0": lambda s: (1 + s.x * s.x) * s.z * time,
    "in quotients": lambda s: s.z / (2 + sin(s.x)),
    "in odd functions": lambda s: sin(s.z) * s.x - ac.tanh(s.z),
    "in a difference of constants": lambda s: 1 - exp(s.z) + s.z * s.x,
    "in even functions, where the derivative has a term of its own": lambda s: 1 - cos(s.z) - s.z**2,
    "in powers": lambda s: s.z**3 - s.x * s.z,
    "under a root of something else": lambda s: s.z * sqrt(1 + s.z * s.z),
    "in all cases": lambda s: -s.z * piecewise((2.0, s.x > 1.2), 1.0),
}
REMAIN = {
    "a root, whose solution is not unique": lambda s: sqrt(s.z),
    "a root of a square": lambda s: sqrt(s.z * s.z),
    "an absolute value": lambda s: abs(s.z),
    "something beside": lambda s: s.z * 0.1 + s.x,
    "a parameter": lambda s: s.k,
    "the time": lambda s: time - s.z,
    "a constant": lambda s: cos(s.z),
    "an angle": lambda s: atan2(s.z, 1 + s.x),
    "a case": lambda s: piecewise((s.z, s.x > 1.2), 0.1),
}


@pytest.mark.parametrize("law", VANISH.values(), ids=VANISH)
def test_vanishes(law):
    model = law_of(law)
    compiled = ac.compile(model)
    assert compiled.report["stays_zero"] == ["z"]
    assert compiled.states == ("x",)
    full = ac.simulate(ac.compile(model, full=True), stop_time=1.0, tolerance=1e-9)
    np.testing.assert_array_equal(full["z"], 0)
    reduced = ac.simulate(compiled, stop_time=1.0, tolerance=1e-9)
    np.testing.assert_allclose(reduced["y"], full["y"], atol=1e-8)
    np.testing.assert_array_equal(reduced["z"], 0)


@pytest.mark.parametrize("law", REMAIN.values(), ids=REMAIN)
def test_remains(law):
    assert ac.compile(law_of(law)).report["stays_zero"] == []


def test_a_table_is_not_0():
    table = ac.Table([-1, 0, 1], [1, 0, -1])  # like a function of another library
    assert ac.compile(law_of(lambda s: ac.table(s.z, table))).nx == 2


def test_a_free_parameter_is_not_0():
    class Pushed(Pair):
        push: Scalar = parameter("push", default=0.0)

        def law(self):
            return -self.z + self.push

    assert ac.compile(Pushed()).report["stays_zero"] == ["z"]
    free = ac.compile(Pushed(), free=("push",))
    assert free.report["stays_zero"] == []
    assert ac.simulate(free, parameters={"push": 1.0}, stop_time=1)["z"][-1] == pytest.approx(1 - np.exp(-1), rel=1e-3)


def test_a_discrete_variable_is_not_0():
    class Switched(Pair):
        on: Scalar = discrete("push", start=0)

        def law(self):
            return -self.z + self.on

        def equations(self):
            yield from super().equations()
            yield when(time > 0.5, reinit(self.on, 1))

    assert ac.simulate(Switched(), stop_time=1.0)["z"][-1] == pytest.approx(1 - np.exp(-0.5), rel=1e-3)


class Watched(Pair):
    """Conditions on a member, which is 0."""

    above: Scalar = discrete("whether z was large", start=0)
    there: Scalar = discrete("x at an event", start=0)

    def equations(self):
        yield from super().equations()
        yield when(self.z > 0.1, reinit(self.above, 1))
        yield when(self.x + self.z > 1.5, reinit(self.there, self.x))


@pytest.mark.parametrize("full", [False, True])
def test_conditions_read_members_as_0(full: bool):
    result = ac.simulate(ac.compile(Watched(), full=full), stop_time=1.0, tolerance=1e-8)
    assert result["above"][-1] == 0
    assert result["there"][-1] == pytest.approx(1.5, abs=1e-5)


def test_a_case_of_a_member_holds_as_before():
    class Cases(Pair):
        def equations(self):
            yield der(self.z) == self.law()
            yield der(self.x) == piecewise((1.0, self.z <= 0), 5.0) + piecewise((3.0, self.z < 0), 0.0)
            yield self.y == self.x

    for full in (False, True):
        assert ac.simulate(ac.compile(Cases(), full=full), stop_time=1.0)["y"][-1] == pytest.approx(2.0)


def test_targets_of_reinit_remain():
    class Kicked(Pair):
        def equations(self):
            yield from super().equations()
            yield when(time > 0.5, reinit(self.z, -self.z + 1))

    assert ac.compile(Kicked()).nx == 2
    assert ac.simulate(Kicked(), stop_time=0.6)["z"][-1] > 0.5


def test_a_jump_of_0_that_changes_nothing_remains_too():
    class Turned(Pair):
        def equations(self):
            yield from super().equations()
            yield when(time > 0.5, reinit(self.z, -self.z))

    assert ac.compile(Turned()).nx == 2


def test_no_value_at_0_keeps_the_members():
    class Inverse(Pair):
        w: Scalar = variable("quotient", start=1)

        def equations(self):
            yield from super().equations()
            yield self.w * self.z == self.z * 2

    compiled = ac.compile(Inverse())
    assert compiled.report["stays_zero"] == [], "w z = 2 z determines w as long as z is not 0"

    class Pole(Pair):
        w: Scalar = variable("pole", start=1)

        def equations(self):
            yield from super().equations()
            yield self.w == 1 / (self.z + self.z**3)

    assert ac.compile(Pole()).report["stays_zero"] == []


def test_products_of_members_determine_neither():
    class Product(Model):
        a: Scalar = variable("a", select=PREFER, start=0, fixed=True)
        b: Scalar = variable("b")
        y: Scalar = output("y")

        def equations(self):
            yield der(self.a) == self.b
            yield self.a * self.b == 0
            yield self.y == time + self.a

    assert ac.compile(Product()).report["stays_zero"] == []


def test_a_chain_counts_once():
    class Oscillator(Pair):
        v: Scalar = variable("der(z)", select=PREFER, start=0, fixed=True)

        def equations(self):
            yield self.v == der(self.z)
            yield der(self.v) == -self.z * (1 + self.x) - self.v
            yield der(self.x) == cos(time)
            yield self.y == self.x + self.z

    compiled = ac.compile(Oscillator())
    assert compiled.report["stays_zero"] == ["z", "v"]
    assert compiled.report["unknowns_at_zero"] == 3
    assert ac.compile(Oscillator(v=ac.guess(0))).report["stays_zero"] == [], "v is free"
    assert ac.compile(Oscillator(v=fixed(0.1))).report["stays_zero"] == []


class Softly(Pair):
    z: Scalar = variable("may stay 0", select=PREFER)
    at: Scalar = parameter("start", default=0.0)

    def initial_equations(self):
        yield soft(self.z == self.at)


def test_soft_initial_equations_count():
    assert ac.compile(Softly()).report["stays_zero"] == ["z"]
    assert ac.compile(Softly(at=0.1)).report["stays_zero"] == []
    assert ac.compile(Softly(), free=("at",)).report["stays_zero"] == []


def test_a_start_value_by_a_parameter_is_not_0():
    class Started(Pair):
        at: Scalar = parameter("start", default=0.0)
        z: Scalar = variable("may stay 0", select=PREFER, start=at, fixed=True)

    assert ac.compile(Started(), free=("at",)).nx == 2
    assert ac.compile(Started()).nx == 1


def test_an_alias_passes_its_start_value_on():
    class Shifted(Pair):
        shifted: Scalar = variable("z + 1", start=1.0)
        doubled: Scalar = variable("2 z", start=0.5)

        def equations(self):
            yield from super().equations()
            yield self.shifted == self.z + 1
            if self.twice:
                yield self.doubled == 2 * self.z
            else:
                yield self.doubled == self.x * self.x

        twice: bool = ac.structural("whether doubled is an alias", default=False)

    assert ac.compile(Shifted()).report["stays_zero"] == ["z"]
    assert ac.compile(Shifted(twice=True)).report["stays_zero"] == [], "the guess of doubled is that of z"


def test_inside_a_component_names_have_its_path():
    class Part(Component):
        z: Scalar = variable("may stay 0", select=PREFER, start=0, fixed=True)

        def equations(self):
            yield der(self.z) == -self.z

    class Whole(Model):
        parts = [Part(), Part()]  # noqa: RUF012
        y: Scalar = output("y")

        def equations(self):
            yield der(self.y) == 1 + self.parts[0].z

        def initial_equations(self):
            yield self.y == 0

    assert ac.compile(Whole()).report["stays_zero"] == ["parts[0].z", "parts[1].z"]
