"""Quantities of other packages are converted to the unit of their field; masked arrays are errors."""

from __future__ import annotations

import warnings
from math import pi
from typing import ClassVar

import numpy as np
import pint
import pytest

import acausal as ac
from acausal import (
    Model,
    Scalar,
    UnitsError,
    Vector3,
    chain,
    der,
    discrete,
    fixed,
    guess,
    input,
    parameter,
    structural,
    variable,
)
from components import Body, Revolute, World

Q = pint.UnitRegistry().Quantity


class Strict:
    """A quantity as astropy has it: `value`, `unit`, and angles that are no numbers."""

    BASES: ClassVar = {"kg": 2, "m": 3, "s": 5, "rad": 7}  # a product of powers of primes tells the dimension
    UNITS: ClassVar = {
        "g": ("kg", 1e-3),
        "N*m/deg": ("kg*m**2/s**2/rad", 180 / pi),
        "deg": ("rad", pi / 180),
    }

    def __init__(self, value, unit):
        self.value, self.unit = value, unit

    def to(self, unit):
        base, scale = self.UNITS[self.unit]
        if unit == "" or eval(unit, {}, self.BASES) != pytest.approx(eval(base, {}, self.BASES)):
            raise ValueError(f"'{self.unit}' and '{unit}' are not convertible")
        return Strict(np.asarray(self.value) * scale, unit)

    def __str__(self):
        return f"{self.value} {self.unit}"


class Thing(Model):
    size: Vector3 = parameter("size", unit=("m", "m", "rad"), default=(1, 1, 1))
    m: Scalar = parameter("mass", unit="kg", default=Q(5000, "g"))
    k: Scalar = parameter("stiffness", unit="N.m/rad", default=1)
    plain: Scalar = parameter("without a unit", default=1)
    n: int = structural("count", default=3, cls=int)
    axis: Vector3 = structural("axis", default=(0, 0, 1), shape=(3,))
    f: Scalar = input("force", unit="N", start=1)
    x: Scalar = variable("position", unit="m", start=Q(10, "mm"), fixed=True)
    v: Scalar = variable("velocity", unit="m/s", start=0, fixed=True)
    due: Scalar = discrete("instant", unit="s", start=Q(1, "ms"))

    def equations(self):
        yield der(self.x) == self.v
        yield self.m * der(self.v) == self.f


def first(model, path, **settings):
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        return ac.simulate(model, stop_time=0.1, intervals=1, **settings)[path][0]


class Heavier(Thing):
    m = Q(2, "tonne")


class Whole(Model):
    L: Scalar = parameter("length", unit="m", default=Q(2, "km"))
    one = Thing(size=(L, Q(1, "mm"), 0.5), f=Q(1, "kN"))


@pytest.mark.parametrize(
    ("model", "path", "value"),
    [
        (Thing(), "m", 5),
        (Heavier(), "m", 2000),
        (Thing(m=Q("2500 g")), "m", 2.5),
        (Thing(m=Strict(2500, "g")), "m", 2.5),
        (Thing(k=Q(3, "N*m/deg")), "k", 540 / pi),
        (Thing(k=Strict(3, "N*m/deg")), "k", 540 / pi),
        (Thing(size=(Q(1, "mm"), 2, Q(30, "deg"))), "size", [0.001, 2, pi / 6]),
        (Thing(size=[1, 2, Strict(30, "deg")]), "size", [1, 2, pi / 6]),
        (Thing(size=np.array([Q(1, "mm"), 2, 3], dtype=object)), "size", [0.001, 2, 3]),
        (Thing(), "x", 0.01),
        (Thing(x=fixed(Q(3, "cm"), nominal=Q(1, "mm"))), "x", 0.03),
        (Thing(v=fixed(Q(36, "km/hour"))), "v", 10),
        (Thing(), "due", 0.001),
        (Thing(due=guess(Q(1, "min"))), "due", 60),
        (Thing(f=Q(2, "kN")), "f", 2000),
        (Whole(), "one.size", [2000, 0.001, 0.5]),
        (Whole(L=Q(1, "ft")), "one.size[0]", 0.3048),
        (Whole(), "one.f", 1000),
    ],
)
def test_a_quantity_is_converted(model, path, value):
    np.testing.assert_allclose(first(model, path), value, rtol=1e-12)


def test_quantities_by_path():
    compiled, values = ac.compile(Thing()), {"k": Q(3, "N*m/deg"), "f": Q(1, "kN")}
    for model in (compiled, Thing()):
        assert first(model, "k", parameters=values) == pytest.approx(540 / pi)
        assert first(model, "f", parameters=values) == pytest.approx(1000)
    mixed = {"size": [Q(1, "mm"), 1, Strict(180, "deg")]}
    for model in (compiled, Thing()):
        np.testing.assert_allclose(first(model, "size", parameters=mixed), [0.001, 1, pi])
    assert first(compiled, "size[2]", parameters={"size[2]": Q(90, "deg")}) == pytest.approx(pi / 2)
    assert ac.compile(Thing(), parameters=mixed).value("size") == pytest.approx([0.001, 1, pi])


def test_a_pendulum_of_grams_and_degrees_moves_as_one_of_kilograms_and_radians():
    def pendulum(m, r, phi):
        class Pendulum(Model):
            world, joint, bob = World(), Revolute(phi=fixed(phi), w=fixed(0)), Body(m=m, r_CM=r)

            def connections(self):
                yield chain(self.world, self.joint, self.bob)

        return ac.simulate(Pendulum(), stop_time=1)["joint.phi"]

    measured = pendulum(Q(2500, "g"), Q([500, 0, 0], "mm"), Q(30, "deg"))
    np.testing.assert_allclose(measured, pendulum(2.5, (0.5, 0, 0), pi / 6), rtol=1e-9)


@pytest.mark.parametrize(
    ("model", "settings", "says"),
    [
        (Thing(m=Q("2.5 m")), {}, r"`m` of Thing \(.*:\d+\) is 2.5 meter, which cannot be converted to kg\. Give"),
        (Thing(m=Strict(1, "deg")), {}, r"`m` of Thing .* is 1 deg, which cannot be converted to kg"),
        (Thing(size=Q([1, 2, 3], "mm")), {}, r"`size` of Thing .* 3 millimeter, .* converted to a number or an angle"),
        (Thing(x=fixed(Q(3, "s"))), {}, r"start of `x` is 3 second, which cannot be converted to m\."),
        (Thing(f=Q(3, "s")), {}, r"`f` of Thing .* is 3 second, which cannot be converted to N\."),
        (Thing(), {"parameters": {"k": Q(1, "m")}}, r"`k` .*is 1 meter, which cannot be converted to N\.m\."),
        (ac.compile(Thing()), {"parameters": {"size[1]": Q(1, "kg")}}, r"`size\[1\]` is 1 kilogram"),
    ],
)
def test_a_quantity_of_another_dimension_is_refused(model, settings, says):
    with pytest.raises(UnitsError, match=says):
        first(model, "x", **settings)


@pytest.mark.parametrize(
    ("model", "says"),
    [
        (Thing(plain=Q(1, "m")), "`plain` of Thing .* is 1 meter, but the field has no unit"),
        (Thing(n=Q(3, "")), "`n` of Thing .* but the field has no unit"),
        (Thing(axis=Q([0, 0, 1], "m")), "`axis` of Thing .* but the field has no unit"),
        (Thing(m=Q([1, 2], "kg")), "`m` of Thing .* must be one number"),
        (Thing(size=np.ma.array([1.0, 2, 3], mask=[0, 1, 0])), r"`size` of Thing .* a masked array \(1 of 3 entries"),
        (Thing(axis=np.ma.array([0.0, 0, 1], mask=False)), r"`axis` of Thing .* a masked array"),
        (Thing(x=fixed(np.ma.masked)), "start of `x` is a masked array"),
        (Thing(size=[1, 2, np.ma.masked]), "`size` of Thing .* a masked array"),
    ],
)
def test_what_has_no_unit_and_what_is_masked_is_refused(model, says):
    with pytest.raises(ac.DeclarationError, match=says):
        first(model, "x")


@pytest.mark.parametrize(
    "law",
    [
        lambda m: m.m * der(m.v) == Q(1, "kN"),
        lambda m: m.m * der(m.v) == m.f * Q(2, ""),
        lambda m: m.m * der(m.v) - Strict(1, "kg") == 0,
        lambda m: m.size == np.ma.array([1.0, 2, 3], mask=[0, 1, 0]),
    ],
)
def test_an_equation_takes_numbers_and_says_what_to_write(law):
    class Stated(Thing):
        def equations(self):
            yield der(self.x) == self.v
            yield law(self)

    with pytest.raises(ac.DeclarationError, match=r'test_quantities\.py:\d+: .*(quantity\(1\.5, "kg"\)|masked array)'):
        ac.compile(Stated())


def test_arrays_of_a_result_cannot_be_written_to():
    result = ac.simulate(Thing(), stop_time=1, intervals=4)
    series = result.series("x")[0].values
    for array in (result.time, result["time"], result["x"], result["size"], series, result[Thing().x]):
        with pytest.raises(ValueError, match="read-only"):
            array[0] = 5.0


def test_arrays_that_others_made_take_no_quantities():
    with pytest.raises(ac.DeclarationError, match=r"the time is .* a quantity of another package"):
        ac.result_of(Q([0, 1], "s"), {"x": ([0, 1], "m")})
    with pytest.raises(ac.DeclarationError, match="`x` is a masked array"):
        ac.result_of([0, 1], {"x": (np.ma.array([0, 1], mask=[0, 1]), "m")})
