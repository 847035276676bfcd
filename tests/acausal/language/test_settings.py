"""Settings in a class body take effect; elsewhere they take effect or raise an error with the remedy."""

from __future__ import annotations

import pytest

import acausal as ac
from acausal import (
    DeclarationError,
    Model,
    Scalar,
    chain,
    der,
    fixed,
    guess,
    output,
    parameter,
    structural,
    variable,
)
from acausal.study.measuring.model_pickling import pack, unpack
from components import Body, FixedTranslation, Revolute, World
from components.rotational import Damper
from models import SpinUp


class Swing(Model):
    load: Scalar = parameter("mass at the tip", unit="kg", default=0.5)
    world = World()
    hinge = Revolute(phi=fixed(0), w=fixed(0), use_axis_flange=True)
    damper = Damper(d=0.1)
    bar = FixedTranslation(r=(1, 0, 0))
    tip = Body(m=load)
    height: Scalar = output("height of the tip", unit="m")

    def connections(self):
        yield chain(self.world, self.hinge, self.bar, self.tip)
        if self.damper is not None:
            yield chain(self.hinge.support, self.damper, self.hinge.axis)

    def equations(self):
        yield self.height == self.tip.r_0[1]


class Rate(Model):
    """x grows at a; defaults stand in the wrong order on purpose."""

    a: Scalar = parameter("rate", default=lambda s: 2 * s.b)
    b: Scalar = parameter("half of it", default=lambda s: s.n + 1)
    n: int = structural("number", default=lambda s: s.k)
    k: int = structural("its default", default=3)
    x: Scalar = variable("integral", start=0, fixed=True)

    def equations(self):
        yield der(self.x) == self.a


def value(model: Model, name: str, **values) -> float:
    return ac.simulate(model, stop_time=0.01, **values)[name][-1]


def last(model: Model, **values) -> float:
    return ac.simulate(model, stop_time=1, **values)["x"][-1]


class Heavy(Swing):
    load = 5.0


class Heavier(Heavy):
    spare: Scalar = parameter("half of the load", unit="kg", default=4.0)
    load = 2 * spare


class Again(Heavy):
    load: Scalar = parameter("declared again", unit="kg", default=0.25)


def test_a_number_is_the_new_default_of_an_inherited_parameter():
    assert value(Heavy(), "load") == value(Heavy(), "tip.m") == 5
    assert value(Heavy(load=1), "tip.m") == 1
    assert value(Heavy(), "tip.m", parameters={"load": 3}) == 3
    assert value(ac.compile(Heavy()), "tip.m", parameters={"load": 3}) == 3
    assert value(Heavier(), "tip.m", parameters={"spare": 0.7}) == pytest.approx(1.4)
    assert value(Again(), "tip.m") == 0.25
    assert value(Swing(), "tip.m") == 0.5
    assert str(Heavy().load) == "load"


class Fine(SpinUp):
    volumes = 7
    formulation = "fem"


def test_a_structural_value_and_a_choice():
    tree = ac.compile(Fine()).tree
    assert (tree.volumes, tree.formulation, ac.compile(Fine(volumes=3)).tree.volumes) == (7, "fem", 3)


@pytest.mark.parametrize(
    ("name", "wrong", "text"),
    [
        ("volumes", 7.5, "must be a whole number"),
        ("volumes", 0, "at least 1"),
        ("formulation", "gem", "must be one of"),
        ("omega", "fast", "must be a number"),
        ("omega", None, "must be a number"),
        ("omega", fixed(3), "is not a variable"),
        ("angle", 3, "write angle=fixed"),
        ("world", 5, "is a part; replace it by a component"),
    ],
)
def test_a_wrong_value_is_refused(name, wrong, text):
    with pytest.raises(DeclarationError, match=text):
        ac.compile(type("Wrong", (SpinUp,), {name: wrong})())


class Started(Rate):
    x = fixed(5)


class Guessed(Rate):
    x = guess(7)


class Later(Started):
    first: Scalar = parameter("start", default=2.0)
    x = fixed(first)


def test_start_values():
    assert [
        ac.simulate(m, stop_time=1, initial=i)["x"][0] for m, i in ((Started(), "fixed"), (Guessed(), "guesses"))
    ] == [5, 7]
    assert ac.simulate(Later(), stop_time=1, parameters={"first": 3})["x"][0] == 3
    assert ac.simulate(Started(x=fixed(1)), stop_time=1)["x"][0] == 1


class Driven(Model):
    u: Scalar = ac.input("rate")
    x: Scalar = variable("integral", start=0, fixed=True)

    def equations(self):
        yield der(self.x) == self.u


class Faster(Driven):
    u = 3.0


class Both(Model):
    scale: Scalar = parameter("rate", default=2.0)
    one = Faster()
    two = Faster(u=scale)


def test_inputs():
    assert last(Faster()) == pytest.approx(3)
    assert last(Faster(), parameters={"u": 4}) == pytest.approx(4)
    result = ac.simulate(Both(), stop_time=1)
    assert [result["one.x"][-1], result["two.x"][-1]] == pytest.approx([3, 2])


class FiveMixin:
    k = 5


class OfMixin(FiveMixin, Rate):
    pass


class OneK(Rate):
    k = 7


class OneN(Rate):
    n = 2


class OfTwo(OneK, OneN):
    pass


def test_several_bases():
    assert last(OfMixin()) == pytest.approx(12)
    tree = ac.compile(OfTwo()).tree
    assert (tree.n, tree.k) == (2, 7)


@pytest.mark.parametrize(
    "several",
    [{"a": Body(m=1)}, {Body(m=1)}, (Body(m=1) for _ in range(2)), [[Body(m=1)]], [Body(m=1), None]],
)
def test_other_collections_of_parts_are_refused(several):
    with pytest.raises(DeclarationError, match="list"):
        type("Wrong", (Swing,), {"bodies": several})


class PerLength(Rate):
    a = lambda s: s.per_length * 2  # noqa: E731
    per_length: Scalar = parameter("mass per length", default=lambda s: s.b / 2)


def test_defaults_in_any_order():
    assert last(Rate()) == pytest.approx(8)
    assert last(Rate(b=1)) == pytest.approx(2)
    assert last(PerLength()) == pytest.approx(4)
    assert last(Rate(), parameters={"k": 1}) == pytest.approx(4)


class Circle(Rate):
    b: Scalar = parameter("b", default=lambda s: s.c)
    c: Scalar = parameter("c", default=lambda s: s.a)


class Own(Rate):
    n = lambda s: s.n + 1  # noqa: E731


def test_a_circle_of_defaults_is_named():
    with pytest.raises(DeclarationError, match="Circle depend on each other in a cycle: a -> b -> c -> a"):
        ac.compile(Circle())
    with pytest.raises(DeclarationError, match="n -> n"):
        ac.compile(Own())
    assert last(Circle(c=2)) == pytest.approx(4)
    assert last(Own(n=2)) == pytest.approx(6)


def test_class_values_reach_another_process():
    assert value(unpack(pack(Heavier(spare=0.7))), "tip.m") == pytest.approx(1.4)
