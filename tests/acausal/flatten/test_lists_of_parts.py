"""Lists of parts, and connections of components outside the model."""
# ruff: noqa: RUF012  (a list in a class body is what is tested)

from __future__ import annotations

import numpy as np
import pytest

import acausal as ac
from acausal import (
    ConnectError,
    Connector,
    DeclarationError,
    Model,
    Record,
    Scalar,
    branch,
    chain,
    connect,
    der,
    fixed,
    flow,
    parameter,
    parts,
    potential_root,
    root,
    variable,
)
from acausal.study.effects.listing import effects_of
from components import BodyShape, FixedTranslation, FlexibleBeam, Frame, Revolute, SubstructuredBeam, World

REST = {"phi": fixed(0.1), "w": fixed(0)}


class Double(Model):
    """The same double pendulum, its parts named or in lists."""

    m: Scalar = parameter("mass", unit="kg", default=2.0)
    world = World()
    joints = [Revolute(**REST), Revolute(**REST)]
    bars = (BodyShape(r=(1, 0, 0), r_CM=(0.5, 0, 0), m=1), BodyShape(r=(1, 0, 0), r_CM=(0.5, 0, 0), m=m))

    def connections(self):
        yield chain(self.world, self.joints[0], self.bars[0], self.joints[1], self.bars[1])


class Named(Model):
    m: Scalar = parameter("mass", unit="kg", default=2.0)
    world = World()
    joint_1, joint_2 = Revolute(**REST), Revolute(**REST)
    bar_1 = BodyShape(r=(1, 0, 0), r_CM=(0.5, 0, 0), m=1)
    bar_2 = BodyShape(r=(1, 0, 0), r_CM=(0.5, 0, 0), m=m)

    def connections(self):
        yield chain(self.world, self.joint_1, self.bar_1, self.joint_2, self.bar_2)


def test_a_plain_list_of_parts_just_works():
    result, named = (ac.simulate(M(), stop_time=1, tolerance=1e-8) for M in (Double, Named))
    np.testing.assert_array_equal(result["joints[1].phi"], named["joint_2.phi"])
    np.testing.assert_array_equal(result["bars[1].frame_b.r_0"], named["bar_2.frame_b.r_0"])
    np.testing.assert_array_equal(result[Double().joints[1].phi], result["joints[1].phi"])
    assert list(result.to_dataframe("joints[0].phi").columns) == ["time", "joints[0].phi"]


def test_parameters_by_path():
    assert ac.simulate(Double(), stop_time=0.1, parameters={"bars[0].m": 3})["bars[0].m"][-1] == 3
    compiled = ac.compile(Double())
    assert ac.simulate(compiled, stop_time=0.1, parameters={"bars[0].m": 3, "m": 5})["bars[1].m"][-1] == 5
    with pytest.raises(DeclarationError, match=r"`joints\[0\].phi` is a variable, not a parameter"):
        ac.compile(Double(), parameters={"joints[0].phi": 3})
    with pytest.raises(
        DeclarationError, match=r"`joints\[0\].phi` cannot be set on a model.*Revolute\(phi=fixed\(3\)\)"
    ):
        Double().joints[0].phi = 3
    with pytest.raises(DeclarationError, match="give its list"):
        Double().joints[0] = Revolute()
    found = [effect.path for effect in effects_of(Double())]
    assert {"joints[0].friction", "joints[1].friction"} <= set(found)
    ac.compile(Double(), parameters={"joints[1].friction": False})


def test_one_template_may_stand_in_a_list_many_times():
    class Row(Model):
        world = World()
        joints = [Revolute(**REST)] * 3
        bars = [BodyShape(r=(1, 0, 0), r_CM=(0.5, 0, 0), m=1)] * 3

        def connections(self):
            yield chain(self.world, *[p for pair in zip(self.joints, self.bars, strict=True) for p in pair])

    compiled = ac.compile(Row())
    assert len({id(joint) for joint in compiled.tree.joints}) == 3
    assert compiled.nx == 6


class Instead(Double):
    bars = [FixedTranslation(r=(0.3, 0, 0)), BodyShape(r=(1, 0, 0), r_CM=(0.5, 0, 0), m=4)]


class OneBecomesMany(Named):
    joint_2 = [Revolute(**REST)]
    bar_2 = []

    def connections(self):
        yield chain(self.world, self.joint_1, self.bar_1, *self.joint_2, *self.bar_2)


BEAM = {"E": 1e7, "rho": 1000, "A": 1e-4, "J": 1e-9}


class TwoParts(SubstructuredBeam):
    volume = [FlexibleBeam(length=0.2, elements=1, **BEAM), FlexibleBeam(length=0.3, elements=2, **BEAM)]


def test_a_list_in_place_of_an_inherited_part_or_list():
    assert ac.compile(Instead()).tree.bars[0].r.shape == (3,)
    given = Double(bars=[FixedTranslation(r=(0.3, 0, 0)), BodyShape(r=(1, 0, 0), r_CM=(0.5, 0, 0), m=4)])
    assert ac.simulate(given, stop_time=0.1)["bars[1].m"][-1] == 4
    with pytest.raises(DeclarationError, match=r"Double.bars is a list of parts; give a list"):
        Double(bars=BodyShape(r=(1, 0, 0), m=1))
    tree = ac.compile(OneBecomesMany(joint_2=[])).tree
    assert (tree.joint_2, tree.bar_2) == ([], [])

    class Beam(Model):
        world = World()
        hinge = Revolute(phi=fixed(0), w=fixed(0))
        beam = TwoParts(length=0.5, volumes=2, **BEAM)

        def connections(self):
            yield chain(self.world, self.hinge, self.beam)

    assert ac.simulate(Beam(), stop_time=0.01)["beam.volume[1].q"].shape[1] > 0


class Wire(Record):
    u: Scalar = variable("potential", unit="V")
    i: Scalar = flow("current", unit="A")


class Cable(Connector):
    wires = [Wire(), Wire()]


class Battery(ac.Component):
    pin = Cable()

    def equations(self):
        yield self.pin.wires[0].u == 5
        yield self.pin.wires[1].u == 1


class Loads(ac.Component):
    R: Scalar = parameter("resistance", unit="V/A", default=2.0)
    pins = [Cable(), Cable()]

    def equations(self):
        for pin in self.pins:
            for wire in pin.wires:
                yield wire.u == self.R * wire.i


class Circuit(Model):
    batteries = [Battery(), Battery()]
    loads = Loads()
    charge: Scalar = variable("charge", unit="A.s", start=0, fixed=True)

    def connections(self):
        for battery, pin in zip(self.batteries, self.loads.pins, strict=True):
            yield connect(battery.pin, pin)

    def equations(self):
        yield der(self.charge) == self.loads.pins[1].wires[0].i


def test_lists_of_ports_and_of_records_in_connectors():
    result = ac.simulate(Circuit(), stop_time=1)
    assert result["charge"][-1] == pytest.approx(2.5)
    assert result["loads.pins[0].wires[1].i"][-1] == pytest.approx(0.5)


# What does not belong to the model.


class Base(Model):
    world = World()
    joint = Revolute(**REST)
    tip = BodyShape(r=(1, 0, 0), m=1)


OTHER = Base()


BUILT = ac.compile(Named()).tree


@pytest.mark.parametrize(
    ("connections", "text"),
    [
        (
            lambda s: chain(s.world, Revolute(), s.tip),
            r"Revolute\(\) is created in connections\(\).*class body, `revolute =",
        ),
        (
            lambda s: iter([connect(s.world.frame_b, Revolute().frame_a)]),
            "`frame_a` belongs to a component that is not",
        ),
        (lambda s: iter([connect(s.world.frame_b, Frame())]), r"Frame\(\) is created in connections"),
        (
            lambda s: iter([connect(s.world.frame_b, OTHER.tip.frame_a)]),
            "`tip.frame_a` belongs to a component that is not",
        ),
        (lambda s: iter([connect(s.world.frame_b, BUILT.bar_1.frame_a)]), "bar_1.frame_a.*belongs to another model"),
        (
            lambda s: chain(s.world, s.joint, BodyShape.frame_a),
            r"`frame_a` is read from a class, not from .*`part = \.\.\.`, and connect self\.part\.frame_a",
        ),
        (lambda s: iter([connect(s.world.frame_b, BodyShape.frame_a)]), "`frame_a` is read from a class"),
        (lambda s: iter([branch(BodyShape.frame_a, s.tip.frame_b)]), "`frame_a` is read from a class"),
        (lambda s: chain(s.world, Revolute, s.tip), r"Revolute is a class, not .*`revolute = Revolute\(\.\.\.\)`"),
        (lambda s: iter([root(OTHER.tip.frame_a)]), "`tip.frame_a` belongs to a component"),
        (lambda s: iter([potential_root(s.tip)]), r"potential_root\(\) takes a port, but tip .* is not a port"),
        (lambda s: iter([branch(s.tip.frame_a, 3)]), r"branch\(\) relates two ports, but 3 is not a port"),
        (lambda s: chain(s.world, [s.joint], s.tip), r"chain\(self.a, \*self.links, self.b\)"),
        (lambda s: iter(OTHER.tip.frame_a), "'Path' object is not iterable"),
        (lambda s: iter(["frame_a"]), "yields 'frame_a'"),
        (lambda s: iter([s.tip.m]), "yields tip.m"),
    ],
)
def test_what_is_not_in_the_model_is_refused_at_its_line(connections, text):
    model = type("M", (Base,), {"connections": connections})
    with pytest.raises((ConnectError, DeclarationError), match=rf"M, .*test_lists_of_parts.py:\d+: .*{text}"):
        ac.compile(model())


def test_fields_and_paths_are_not_gone_through_without_end():
    with pytest.raises(DeclarationError, match="cannot be iterated over in the class body"):
        type("M", (Base,), {"first": list(Named.m)})
    with pytest.raises(TypeError, match="not iterable"):
        list(OTHER.tip)


class Shared(Model):
    @parts
    def bodies(self):
        return [BUILT.bar_1]


def test_a_part_of_a_built_model_is_no_template():
    with pytest.raises(DeclarationError, match=r"bodies\[0\]` must be a part, .*a part of another model"):
        ac.compile(Shared())
