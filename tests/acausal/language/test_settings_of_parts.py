"""Parts in a class body: removed, replaced, added."""

from __future__ import annotations

import pytest

import acausal as ac
from acausal import (
    DeclarationError,
    Model,
    Scalar,
    chain,
    fixed,
    parameter,
    part,
    parts,
    structural,
)
from components import Body, Prismatic, Revolute, World
from tests.acausal.language.test_settings import Rate, Swing, last, value


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


class Several(Model):
    @parts
    def bodies(self):
        return None

    @part
    def one(self):
        return 5


def test_parts_must_be_parts():
    with pytest.raises(DeclarationError, match="@parts decorates a method that returns a list of parts, not None"):
        ac.compile(Several())
    with pytest.raises(DeclarationError, match="`one` must be a part"):
        ac.compile(Several(bodies=[]))
