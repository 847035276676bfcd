"""Generators that do not end, and components that contain themselves: bounded work, then component and line."""

from __future__ import annotations

import pytest

import acausal as ac
from acausal import (
    Component,
    DeclarationError,
    Model,
    Scalar,
    chain,
    connect,
    der,
    parameter,
    part,
    parts,
    reinit,
    require,
    root,
    structural,
    time,
    variable,
    when,
)
from components import Body, Fixed, Revolute, World


class Base(Model):
    x: Scalar = variable("x", start=0, fixed=True)
    world = World()
    joint = Revolute()
    tip = Body(m=1, r_CM=(1, 0, 0))

    def connections(self):
        yield chain(self.world, self.joint, self.tip)

    def equations(self):
        yield der(self.x) == 1


class SameEquation(Base):
    def equations(self):
        while True:
            yield der(self.x) == 1


class SameWhen(Base):
    def equations(self):
        while True:
            yield when(time > 1, reinit(self.x, 0))


class SameStart(Base):
    def initial_equations(self):
        while True:
            yield self.x == 1


class SameConnection(Base):
    def connections(self):
        while True:
            yield connect(self.joint.frame_b, self.tip.frame_a)


class SameChain(Base):
    def connections(self):
        while True:
            yield chain(self.world, self.joint, self.tip)


class SameRoot(Base):
    def connections(self):
        while True:
            yield root(self.tip.frame_a)


class NestedGenerators(Base):
    def connections(self):
        yield self.connections()


class EmptyLists(Base):
    def connections(self):
        while True:
            yield []


class SameRequirement(Base):
    def requirements(self):
        while True:
            yield require(self.x < 1, "x is too large")


class EndlessParts(Base):
    @parts
    def bodies(self):
        while True:
            yield Body(m=1)


class Deep(Model):
    inner = SameEquation()


@pytest.mark.parametrize(
    ("model", "what"),
    [
        (SameEquation, r"SameEquation, .*: equations\(\) has"),
        (NestedGenerators, r"NestedGenerators, .*: connections\(\) has"),
        (EndlessParts, r"EndlessParts, .*: bodies: the list of parts has"),
        *(
            pytest.param(*case, marks=pytest.mark.slow)
            for case in [
                (Deep, r"inner \(SameEquation\), .*: equations\(\) has"),
                (SameWhen, r"SameWhen, .*: equations\(\) has"),
                (SameStart, r"SameStart, .*: initial_equations\(\) has"),
                (SameConnection, r"SameConnection, .*: connections\(\) has"),
                (SameChain, r"SameChain, .*: connections\(\) has"),
                (SameRoot, r"SameRoot, .*: connections\(\) has"),
                (SameRequirement, r"SameRequirement, .*: requirements\(\) has"),
                (EmptyLists, r"EmptyLists, .*: connections\(\) has"),
            ]
        ),
    ],
)
def test_a_generator_that_does_not_end_is_named_with_its_line(model, what):
    with pytest.raises(DeclarationError, match=rf"{what} [\d,]+ entries and continues") as caught:
        ac.compile(model())
    assert "test_endless.py:" in str(caught.value)


class Calls(Base):
    def equations(self):
        yield from self.equations()


class Default(Base):
    a: Scalar = parameter("a", default=lambda s: s.again())

    def again(self):
        return self.again()


@pytest.mark.parametrize("model", [Calls, Default])
def test_calls_without_end(model):
    with pytest.raises(DeclarationError, match=rf"{model.__name__}, .*test_endless.py:\d+.*: infinite recursion"):
        ac.compile(model())


class Inner(Component):
    @part
    def outer(self):
        return Outer()


class Outer(Component):
    @parts
    def inner(self):
        return [Inner(), Inner()]


class Mutual(Model):
    top = Outer()


class Itself(Model):
    @part
    def me(self):
        return Itself()


def test_components_that_contain_themselves():
    with pytest.raises(DeclarationError, match=r"test_endless.py:\d+: parts are nested more than 100 deep \(Itself"):
        ac.compile(Itself())
    with pytest.raises(DeclarationError, match=r"\((Inner in Outer|Outer in Inner), repeatedly.*`top.inner\[0\]"):
        ac.compile(Mutual())


class Row(Component):
    """A row of n bodies, made of a body and a row of one less."""

    n: int = structural("number of bodies", default=1)
    first = Fixed()

    @part
    def rest(self):
        return Row(n=self.n - 1) if self.n > 1 else None


class Rows(Model):
    world = World()
    row = Row(n=40)


def test_recursion_that_ends_is_no_mistake():
    assert ".".join(["row", *["rest"] * 39]) + ".first" in [c._path for c in _walk(ac.compile(Rows()).tree)]


def _walk(component):
    from acausal.flatten.component_tree import walk

    return walk(component)


class Long(Model):
    """Many statements of one generator, all meant."""

    n: int = structural("number of variables", default=3000)
    x: Scalar = variable("x", shape=lambda s: (s.n,))
    t: Scalar = variable("t", start=0, fixed=True)

    def equations(self):
        yield der(self.t) == 1
        for k in range(self.n):
            yield self.x[k] == k


def test_many_statements_are_no_mistake():
    assert ac.compile(Long()).reduced.flat.counts["equations_flat"] == 3001
