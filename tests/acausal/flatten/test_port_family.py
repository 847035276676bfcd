"""Ports of families work like ports with fixed names."""

from __future__ import annotations

import keyword
import pickle
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import acausal as ac
from acausal import (
    Component,
    DeclarationError,
    Model,
    Scalar,
    chain,
    connect,
    fixed,
    observed,
    output,
    parameter,
    parts,
    ports,
    structural,
)
from components import Body, FixedTranslation, Flange, Frame, Revolute, World, rotational

PLACES = (("hinge", (0.0, 0.0, 0.0)), ("tip", (1.0, 0.0, 0.0)))


class Star(Component):
    """A massless body whose frames have places and names; the first carries the others."""

    places: Any = structural("names and places of the frames", default=PLACES)
    scale: Scalar = parameter("factor of the places", unit="1", default=1.0)

    @ports
    def frames(self):
        """A frame at each place."""
        return {name: Frame() for name, _ in self.places}

    @parts
    def arms(self):
        return [FixedTranslation(r=tuple(self.scale * x for x in r)) for _, r in self.places[1:]]

    def connections(self):
        first, *others = self.frames.values()
        for arm, other in zip(self.arms, others, strict=True):
            yield connect(first, arm.frame_a)
            yield connect(arm.frame_b, other)


class Swing(Model):
    """A pendulum: a mass at a frame of the star, which is held at another."""

    star: Any = Star()
    world = World()
    joint = Revolute(phi=fixed(0.1), w=fixed(0))
    body = Body(m=1)
    x: Scalar = output("place of the mass", unit="m")

    def connections(self):
        yield chain(self.world, self.joint, self.star.hinge)
        yield chain(self.star.tip, self.body)

    def equations(self):
        yield self.x == self.star.tip.r_0[0]

    @observed
    def lift(self):
        return self.star.tip.r_0[1]


class Plain(Model):
    """The same without a family."""

    world = World()
    joint = Revolute(phi=fixed(0.1), w=fixed(0))
    arm = FixedTranslation(r=(1, 0, 0))
    body = Body(m=1)

    def connections(self):
        yield chain(self.world, self.joint, self.arm, self.body)


@pytest.fixture(scope="module")
def compiled() -> ac.CompiledModel:
    return ac.compile(Swing())


@pytest.fixture(scope="module")
def plain() -> ac.Result:
    return ac.simulate(Plain(), stop_time=1, tolerance=1e-9)


def test_ports_are_named_in_connections_equations_and_results(compiled, plain):
    result = ac.simulate(compiled, stop_time=1, tolerance=1e-9)
    places = plain["body.frame_a.r_0"]
    np.testing.assert_allclose(result["star.tip.r_0"], places, atol=1e-8)
    np.testing.assert_array_equal(result[Swing().star.tip.r_0], result["star.tip.r_0"])
    np.testing.assert_array_equal(result["x"], result["star.tip.r_0[0]"])
    np.testing.assert_array_equal(result["lift"], result["star.tip.r_0"][:, 1])
    np.testing.assert_array_equal(result["star.hinge.r_0"], 0)
    assert list(result.to_dataframe("star.tip.r_0").columns) == ["time", *(f"star.tip.r_0[{k}]" for k in range(3))]
    with pytest.raises(DeclarationError, match=r"`star.tpi.r_0` in the model; did you mean `star.tip.r_0`"):
        result["star.tpi.r_0"]
    for path in ("star.edge.r_0", "star.edge.R.T"):
        with pytest.raises(
            DeclarationError, match=rf"no `{path}` in the model; star \(Star\) has hinge, tip, arms\[0\]"
        ):
            result[path]
    with pytest.raises(DeclarationError, match=r"`star.tip` is a part \(Frame\); name one of its variables"):
        result["star.tip"]


def test_the_family_is_a_dict_in_an_instance(compiled):
    star = compiled.tree.star
    assert list(star.frames) == ["hinge", "tip"]
    assert star.frames["tip"] is star.tip
    assert [port._path for port in star._ports] == ["star.hinge", "star.tip"]
    assert list(star.fields) == ["places", "scale", "hinge", "tip", "arms"]
    assert list(type(star).fields) == ["places", "scale", "frames", "arms"]
    with pytest.raises(DeclarationError, match=r"`star.tip` cannot be set on a built model"):
        star.tip = Frame()
    with pytest.raises(DeclarationError, match=r"`star.frames` cannot be set on a built model"):
        star.frames = {}


def test_templates_give_paths():
    assert str(Star().tip.r_0[0]) == "tip.r_0[0]"
    assert str(Swing().star.frames) == "star.frames"
    assert not hasattr(Star(), "_private")
    assert not hasattr(Body(m=1), "tip")
    with pytest.raises(ac.ConnectError, match=r"ports are joined in connections\(\), not in the class body"):

        class Wrong(Model):
            star = Star()
            body = Body(m=1)
            connect(star.tip, body.frame_a)


def test_a_property_that_fails_in_a_template_says_so():
    class Failing(Star):
        @property
        def first(self) -> Any:
            return self._nothing

    with pytest.raises(AttributeError, match="_nothing"):
        _ = Failing().first


def test_an_open_port_is_named():
    class Hub(Component):
        @ports
        def flanges(self):
            return {name: Flange() for name in ("left", "right")}

        def equations(self):
            yield self.left.phi == self.right.phi
            yield self.left.tau + self.right.tau == 0

    class Open(Model):
        hub = Hub()
        rotor = rotational.Inertia(J=1, phi=fixed(0), w=fixed(1))

        def connections(self):
            yield connect(self.hub.right, self.rotor.flange_a)

    compiled = ac.compile(Open())
    assert compiled.reduced.flat.unconnected == ("hub.left", "rotor.flange_b")
    assert ac.simulate(compiled, stop_time=1)["hub.left.phi"][-1] == pytest.approx(1)


def test_first_and_second_frame_of_a_chain(plain):
    class Between(Star):
        ends = ("frame_a", "frame_b")

    class Chained(Model):
        world = World()
        joint = Revolute(phi=fixed(0.1), w=fixed(0))
        star = Between(places=(("frame_a", (0.0, 0.0, 0.0)), ("frame_b", (1.0, 0.0, 0.0))))
        body = Body(m=1)

        def connections(self):
            yield chain(self.world, self.joint, self.star, self.body)

    result = ac.simulate(Chained(), stop_time=1, tolerance=1e-9)
    np.testing.assert_allclose(result["star.frame_b.r_0"], plain["body.frame_a.r_0"], atol=1e-8)


def test_pickled_copied_and_written_as_an_open_dae(compiled, plain, tmp_path):
    path = tmp_path / "swing.dae"
    ac.export_dae(compiled, path)
    for other in (pickle.loads(pickle.dumps(compiled)), ac.load_dae(path)):
        result = ac.simulate(other, stop_time=1, tolerance=1e-9)
        np.testing.assert_allclose(result["star.tip.r_0"], plain["body.frame_a.r_0"], atol=1e-8)
        np.testing.assert_allclose(result["lift"], plain["body.frame_a.r_0"][:, 1], atol=1e-8)


def test_families_of_one_class_may_differ(tmp_path):
    """Also in the archive of an open DAE, which keeps the fields of a class once."""

    class Two(Swing):
        other = Star(places=(("base", (0.0, 0.0, 0.0)), ("mast", (0.0, 2.0, 0.0)), ("rail", (3.0, 0.0, 0.0))))

        def connections(self):
            yield from super().connections()
            yield chain(self.world, self.other.base)

    path = tmp_path / "two.dae"
    ac.export_dae(Two(), path)
    for model in (Two(), ac.load_dae(path)):
        result = ac.simulate(model, stop_time=0.1)
        assert result["other.mast.r_0"][0].tolist() == [0, 2, 0]
        assert result["star.tip.r_0"].shape[1:] == (3,)


def test_equal_components_with_families_state_equations_once():
    heard = []

    class Arm(Star):
        def equations(self):
            heard.append(self)
            yield from ()

    class Many(Model):
        world = World()

        @parts
        def stars(self):
            return [Arm(scale=k + 1.0) for k in range(8)]

        def connections(self):
            for star in self.stars:
                yield chain(self.world, star.hinge)

    result = ac.simulate(Many(), stop_time=0.1)
    assert len(heard) == 1
    assert [result[f"stars[{k}].tip.r_0"][0, 0] for k in range(8)] == list(range(1, 9))


def test_a_family_of_the_model_itself():
    class Open(Model):
        count: int = structural("number of ends", default=2)
        world = World()

        @ports
        def tips(self):
            return {f"end_{k}": Frame() for k in range(self.count)}

        def connections(self):
            for end in self.tips.values():
                yield connect(self.world.frame_b, end)

    result = ac.simulate(Open(), stop_time=0.1, intervals=1, parameters={"count": 3})
    assert result["end_2.r_0"].shape == (2, 3)
    assert result[Open().end_2.r_0].shape == (2, 3)


NAMES = st.lists(
    st.from_regex(r"[a-z][a-z0-9_]{0,7}", fullmatch=True).filter(
        lambda name: name not in Star.fields and not hasattr(Star, name) and name.isidentifier()
    ),
    min_size=2,
    max_size=5,
    unique=True,
)


@settings(max_examples=25, deadline=None)
@given(NAMES)
def test_any_name_of_python_that_is_free(names):
    places = tuple((name, (float(k), 0.0, 0.0)) for k, name in enumerate(names))

    class Held(Model):
        world = World()
        star = Star(places=places)

        def connections(self):
            yield chain(self.world, getattr(self.star, names[0]))

    if any(map(keyword.iskeyword, names)):
        with pytest.raises(DeclarationError, match="cannot be the name of a port"):
            ac.compile(Held())
        return
    result = ac.simulate(Held(), stop_time=0.1)
    assert [result[f"star.{name}.r_0"][0, 0] for name in names] == list(range(len(names)))
