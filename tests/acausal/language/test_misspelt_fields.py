"""Names similar to fields, parts, settings or methods raise errors."""

from __future__ import annotations

from typing import ClassVar

import numpy as np
import pytest

import acausal as ac
from acausal import DeclarationError, Model, Scalar, der, guess, observed, output, part
from acausal.study.measuring.model_pickling import pack, unpack
from components import Body, Prismatic, Revolute
from tests.acausal.language.test_settings import Swing as Plain


class Swing(Plain):
    times = 1.0

    def equations(self):
        yield self.height == self.times * self.tip.r_0[1]

    def outside(self, value):
        self.kept = value


# On an instance.


@pytest.mark.parametrize(
    ("name", "text"),
    [
        ("laod", "Swing has no field `laod`; did you mean `load`"),
        ("foo", "Swing has no field `foo`; its fields are load, world"),
        ("tolerence", "did you mean `tolerance`"),
        ("equation", "no field `equation`"),
    ],
)
@pytest.mark.parametrize("of", [Swing, lambda: ac.compile(Swing()).tree])
def test_what_no_class_declares_is_not_set(of, name, text):
    with pytest.raises(DeclarationError, match=text):
        setattr(of(), name, 3)


def test_the_same_in_a_part_of_a_built_model_and_in_somebody_elses_function():
    def tune(model):
        model.stifness = 3

    class Meddling(Swing):
        def connections(self):
            self.tip.mass = 3
            yield from super().connections()

    with pytest.raises(DeclarationError, match="Body has no field `mm`; did you mean `m`"):
        ac.compile(Swing()).tree.tip.mm = 3
    with pytest.raises(DeclarationError, match="Swing has no field `stifness`"):
        tune(Swing())
    with pytest.raises(DeclarationError, match=r"misspelt_fields\.py:\d+: Body has no field `mass`; did you mean `m`"):
        ac.compile(Meddling())


class Annotated(Swing):
    note: str

    @property
    def double(self):
        return 2 * self.times

    @double.setter
    def double(self, value):
        self.times = value / 2


def test_what_is_declared_can_be_set():
    model = Annotated()
    model.note, model.times, model.double, model._mine, model.stop_time = "first", 2.0, 6.0, [1], 0.5
    assert (model.times, model.note, model._mine) == (3.0, "first", [1])
    result = ac.simulate(unpack(pack(model)))
    assert result["height"][-1] == pytest.approx(3 * result["tip.r_0"][-1, 1])


class Prepared(Swing):
    """Methods of the component keep what they like."""

    def __init__(self, first, **values):
        self.first = first
        super().__init__(**values)
        self.lengths = [1, 2]
        self._prepare()

    def _prepare(self):
        def fill():
            self.table = [3, 4]

        fill()

    def equations(self):
        self.last = self.first
        yield self.height == self.last * self.tip.r_0[1]


def test_methods_of_the_component_keep_plain_data():
    model = Prepared(2)
    model.outside(5)
    tree = ac.compile(model).tree
    assert (tree.first, tree.lengths, tree.table, tree.last, tree.kept) == (2, [1, 2], [3, 4], 2, 5)


@pytest.mark.parametrize(("name", "near"), [("laod", "load"), ("hieght", "height"), ("stoptime", "stop_time")])
def test_slips_in_a_constructor(name, near):
    class Slip(Swing):
        def __init__(self):
            super().__init__()
            setattr(self, name, 3)

    class Read(Slip):
        def check(self):
            assert getattr(self, "laod", 0) + getattr(self, "hieght", 0) + getattr(self, "stoptime", 0) == 3

    with pytest.raises(
        DeclarationError, match=f"no field `{name}`, and no method of it reads that; did you mean `{near}`"
    ):
        Slip()
    ac.compile(Read())


# In a class body.


@pytest.mark.parametrize(
    ("name", "value", "near"),
    [
        ("loda", 5, "load"),
        ("lode", np.ones(3), "load"),
        ("Load", "heavy", "load"),
        ("hight", guess(3), "height"),
        ("laod", 2 * Swing.load, "load"),
        ("dampr", None, "damper"),
        ("tpi", Body(m=2), "tip"),
        ("hinje", Prismatic, "hinge"),
        ("bra", [Body(m=2)], "bar"),
        ("hinges_", part(lambda self: Prismatic()), None),
        ("tolerence", 1e-8, "tolerance"),
        ("stop_tme", 5, "stop_time"),
        ("conections", lambda self: (), "connections"),
        ("equation", lambda self: (), "equations"),
        ("stored_enrgy", lambda self: 0, "stored_energy"),
        ("RHO", 7850, None),
        ("loads", [1, 2], None),
        ("load_2", 3, None),
        ("hinge_l", Revolute(), None),
        ("unload", 2, None),
        ("mass", 2, None),
        ("_laod", 2, None),
        ("stop_time", 2, None),
        ("Equation", int, None),
        ("heigth", property(lambda self: 3), None),
        ("tipp", observed(lambda self: self.load), None),
    ],
)
def test_slips_in_a_class_body(name, value, near):
    def write(*bases):
        return type("Slip", bases, {name: value})

    if near is None:
        assert hasattr(write(Swing), name)
        return
    with pytest.raises(
        DeclarationError, match=rf"Slip\.{name} is new, and nothing in .* reads it; did you mean `{near}`"
    ):
        write(Swing)
    # A subclass, and a base that is no component, say the same.
    with pytest.raises(DeclarationError, match=f"did you mean `{near}`"):
        write(type("Between", (Swing,), {}))
    if not callable(value) and not isinstance(value, Body | list):
        with pytest.raises(DeclarationError, match=f"did you mean `{near}`"):
            type("Slip", (type("Mixin", (), {name: value}), Swing), {})


def test_a_constant_that_is_read_or_marked_is_meant():
    class InTheBody(Swing):
        lode = 2.0
        tip = Body(m=lode)

    class InAMethod(Swing):
        lode = 2.0

        def equations(self):
            yield self.height == sum(self.lode for _ in range(2))

    class InAPart(Swing):
        lode = 2.0

        @part
        def tip(self):
            return Body(m=self.lode)

    class Marked(Swing):
        lode: ClassVar[float] = 2.0

    for cls in (InTheBody, InAMethod, InAPart, Marked):
        assert ac.compile(cls()).tree.lode == 2.0
    with pytest.raises(DeclarationError, match="did you mean `load`"):

        class Declared(Swing):
            lode: Scalar = 2.0


def test_a_slip_on_a_finished_class():
    class Late(Swing):
        pass

    Late.laod = 3
    with pytest.raises(DeclarationError, match=r"Late\.laod is new, .*did you mean `load`"):
        ac.compile(Late())
    del Late.laod
    Late.times = 2.0
    Late.mass = 3.0
    ac.compile(Late())


class Growth(Model):
    x: Scalar = output("x")

    def equations(self):
        yield der(self.x) == self.x


def test_a_small_model_without_parts():
    with pytest.raises(DeclarationError, match="Growth has no field `y`; its fields are x"):
        Growth().y = 2
    with pytest.raises(DeclarationError, match="did you mean `initial_equations`"):
        type("Slip", (Growth,), {"inital_equations": lambda self: ()})
