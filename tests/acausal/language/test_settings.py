"""Nothing that is set is ignored: in a class body it works, elsewhere it works or is refused with the way that works."""

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
    part,
    parts,
    structural,
    variable,
)
from acausal.study.measuring.shipping import pack, unpack
from components import Body, FixedTranslation, Prismatic, Revolute, World
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


# In a class body.


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
        ("world", 5, "is a part; put a component in its place"),
    ],
)
def test_a_wrong_value_is_refused(name, wrong, text):
    with pytest.raises(DeclarationError, match=text):
        ac.compile(type("Wrong", (SpinUp,), {name: wrong})())


class Undamped(Swing):
    damper = None


class Free(Swing):
    damper = None
    hinge = Prismatic


def test_none_leaves_a_part_out_and_a_class_stands_for_an_instance():
    tree = ac.compile(Undamped()).tree
    assert tree.damper is None
    free = ac.compile(Free()).tree
    assert isinstance(free.hinge, Prismatic)
    assert str(Free().hinge.s) == "hinge.s"
    assert value(Swing(damper=None, hinge=Prismatic), "hinge.s", initial="guesses") == 0


class Plain(Model):
    world = World
    tip = Body(m=1, r_CM=(1, 0, 0))
    hinge = Revolute

    class Inner(Revolute):
        """A class that is defined here is no part."""

    Joint = Revolute
    kind: type = Revolute
    made_of = None

    def connections(self):
        yield chain(self.world, self.hinge, self.tip)


class Data(Plain):
    made_of = Revolute


class Early(Plain):
    early: Scalar = parameter("needs what is not there yet", default=lambda s: s.tip.m)


def test_a_class_as_a_new_part():
    tree = ac.compile(Plain()).tree
    assert [c._path for c in (tree.world, tree.hinge)] == ["world", "hinge"]
    assert not {"Inner", "Joint", "kind", "made_of"} & set(Data.fields)
    assert (Data.kind, Data().made_of) == (Revolute, Revolute)


class Twice(Plain):
    left = right = Body(m=2, r_0=fixed((0, 0, 0)))
    third = Plain.hinge


def test_one_template_under_two_names():
    model = Twice()
    paths = [str(p) for p in (model.left.m, model.right.m, model.hinge.phi, model.third.phi)]
    assert paths == ["left.m", "right.m", "hinge.phi", "third.phi"]


def test_a_default_of_a_part_is_refused():
    with pytest.raises(DeclarationError, match=r"Early.* does not have its `tip` yet: it exists in connections"):
        ac.compile(Early())


class Method(Rate):
    def a(self):
        return 3 * self.b


class Chosen(Swing):
    heavy: bool = structural("two kilograms", default=True)

    def tip(self):
        return Body(m=2 if self.heavy else 1)


def test_functions_in_place_of_values_and_parts():
    assert last(Method()) == pytest.approx(12)
    assert (value(Chosen(), "tip.m"), value(Chosen(heavy=False), "tip.m")) == (2, 1)


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


# Defaults.


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
    with pytest.raises(DeclarationError, match="Circle depend on each other in a circle: a -> b -> c -> a"):
        ac.compile(Circle())
    with pytest.raises(DeclarationError, match="n -> n"):
        ac.compile(Own())
    assert last(Circle(c=2)) == pytest.approx(4)
    assert last(Own(n=2)) == pytest.approx(6)


# On an instance, a built tree, or a class that is made.


@pytest.mark.parametrize(
    ("change", "text"),
    [
        (lambda s: setattr(s, "load", 2), r"`Swing\(load=2\)`.*parameters=\{'load': 2\}"),
        (lambda s: setattr(s, "tip", Body(m=2)), r"`Swing\(tip=Body\(m=2\)\)`"),
        (lambda s: setattr(s, "damper", None), r"`Swing\(damper=None\)`"),
        (lambda s: setattr(s, "height", 2), r"`Swing\(height=fixed\(2\)\)`"),
        (lambda s: setattr(s.tip, "m", 2), r"parameters=\{'tip.m': 2\}.*`tip = Body\(m=2\)`"),
        (lambda s: setattr(s.tip, "mass", 2), "Body has no field `mass`; did you mean `m`"),
        (lambda s: setattr(s.hinge, "phi", 0.3), r"`hinge = Revolute\(phi=fixed\(0.3\)\)`"),
        (lambda s: s.tip.r_CM.__setitem__(0, 2), "give the whole array"),
        (lambda s: setattr(s, "laod", 2), "did you mean `load`"),
        (lambda s: setattr(s, "second", Body(m=2)), r"class body, `second = Body\(m=2\)`"),
        (lambda s: setattr(s, "others", [Body(m=2)]), "class body"),
    ],
)
def test_setting_on_an_instance_is_refused_with_the_mend(change, text):
    with pytest.raises(DeclarationError, match=text):
        change(Swing())


@pytest.mark.parametrize(
    ("change", "text"),
    [
        (lambda t: setattr(t, "load", 5), r"ac.simulate\(compiled, ..., parameters=\{'load': 5\}\)"),
        (lambda t: setattr(t.bar, "r", (2, 0, 0)), r"`bar.r` cannot be set on a built model.*parameters=\{'bar.r'"),
        (
            lambda t: setattr(t.hinge, "use_axis_flange", False),
            r"ac.compile\(model, parameters=\{'hinge.use_axis_flange'",
        ),
        (lambda t: setattr(t, "tip", None), "Parts are given in the class body"),
        (lambda t: setattr(t.hinge, "phi", 1), "start value is given in the model"),
    ],
)
def test_setting_on_a_built_tree_is_refused_with_the_mend(change, text):
    with pytest.raises(DeclarationError, match=text):
        change(ac.compile(Swing()).tree)


@pytest.mark.parametrize(
    ("name", "new", "text"),
    [
        ("load", 3, r"class MySwing\(Swing\): load = 3.*Swing\(load=3\)"),
        ("tip", Body(m=2), r"class MySwing\(Swing\): tip = Body\(m=2\)"),
        ("second", Body(m=2), "write it in the class body"),
        ("several", [Body(m=2)], "write it in the class body"),
    ],
)
def test_setting_on_a_class_is_refused_with_the_mend(monkeypatch, name, new, text):
    derived = type("Derived", (Swing,), {})
    monkeypatch.setattr(Swing, name, new, raising=False)
    for model in (Swing(), derived()):
        with pytest.raises(DeclarationError, match=text):
            ac.compile(model)


class OwnConstructor(Swing):
    """A constructor of its own may keep plain values."""

    def __init__(self, times, **values):
        super().__init__(load=times * 2.0, **values)
        self.times = times

    def equations(self):
        yield self.height == self.times * self.tip.r_0[1]


def test_a_constructor_of_the_users_own():
    model = OwnConstructor(3)
    result = ac.simulate(model, stop_time=1)
    assert (result["load"][-1], result["height"][-1]) == pytest.approx((6, 3 * result["tip.r_0"][-1, 1]))
    assert model._origin.startswith(__file__)


@pytest.mark.parametrize(
    ("name", "new", "text"),
    [
        ("tip", Body(m=3), r"super\(\).__init__\(tip=Body\(m=3\)\)"),
        ("extra", Body(m=3), "@part"),
        ("load", 3, r"load=3"),
    ],
)
def test_parts_and_values_set_in_a_constructor_are_refused_with_the_mend(name, new, text):
    class Set(Swing):
        def __init__(self):
            super().__init__()
            setattr(self, name, new)

    with pytest.raises(DeclarationError, match=text):
        Set()


def test_what_is_found_or_computed_takes_no_value():
    with pytest.raises(DeclarationError, match="found automatically"):
        Body(m=1, world=World())


class Several(Model):
    @parts
    def bodies(self):
        return None

    @part
    def one(self):
        return 5


def test_parts_must_be_parts():
    with pytest.raises(DeclarationError, match="bodies: it must be a list of parts, not None"):
        ac.compile(Several())
    with pytest.raises(DeclarationError, match="one must be a component"):
        ac.compile(Several(bodies=[]))


def test_class_values_reach_another_process():
    assert value(unpack(pack(Heavier(spare=0.7))), "tip.m") == pytest.approx(1.4)
