"""Assemblies of joints: published machines, and the plain loops that they stand for."""

from __future__ import annotations

import numpy as np
import pytest

import acausal as ac
from acausal import Model, chain, connect, fixed, guess, part, structural
from components import (
    Body,
    BodyBox,
    BodyCylinder,
    Fixed,
    FixedTranslation,
    Prismatic,
    Revolute,
    RevolutePlanarLoopConstraint,
    Universal,
    World,
)
from components.assemblies import JointRRP, JointRRR, JointSSP, JointSSR, JointUPS, JointUSP, JointUSR
from components.sensors import RelativePosition
from components.translational import Spring
from tests.reference.msl.published import compare


class Strut(Model):
    world, rod = World(), FixedTranslation(r=(2, 0, 0))
    universal = Universal(n_a=(0, 0, 1), phi_a=fixed(0), phi_b=fixed(0), w_a=fixed(2), w_b=fixed(2))
    box = BodyBox(r=(-1.4141, 0, 0))
    strut, body, spring = JointUPS(use_axis_flange=True), Body(m=10), Spring(c=10, s_rel0=0.5)

    def connections(self):
        yield chain(self.world, self.rod, self.universal, self.box, self.strut.frame_b)
        yield connect(self.world.frame_b, self.strut.frame_a)
        yield connect(self.strut.axis, self.spring.flange_b)
        yield connect(self.strut.support, self.spring.flange_a)
        yield connect(self.strut.frame_ib, self.body.frame_a)


def test_ups():
    compare("ModelicaTest.MultiBody.Joints.JointUPS2", Strut())


class Crank(Model):
    """A crank turns about z, and moves a mass at the joint in the middle through rod 1; rod 2 ends at the ground."""

    world, ground = World(), FixedTranslation(r=(1, 0, 0))
    j1, crank = Revolute(phi=fixed(1.5), w=fixed(2)), BodyCylinder(r=(0.3, 0, 0), diameter=0.05)
    mass = Body(m=1, I=np.eye(3) * 0.01)

    def connections(self):
        yield chain(self.world, self.j1, self.crank)
        yield connect(self.world.frame_b, self.ground.frame_a)
        yield from self.loop()


class Assembled(Crank):
    kind = structural("class of the assembly", cls=type)
    settings = structural("its parameters", cls=dict)

    @part
    def joint(self):
        return self.kind(**self.settings)

    def loop(self):
        yield connect(self.crank.frame_b, self.joint.frame_a)
        yield connect(self.ground.frame_b, self.joint.frame_b)
        yield connect(self.joint.frame_im, self.mass.frame_a)


class Plain(Crank):
    """The same loop of joints."""

    start = structural("guess of the last joint", default=0.0)
    rod1, j3 = FixedTranslation(r=(1, 0, 0)), RevolutePlanarLoopConstraint()
    rod2 = FixedTranslation(r=(-0.6, 0, 0))

    @part
    def j2(self):
        return Revolute(phi=guess(-2.4 if self.start > 0 else -0.9))

    @part
    def j4(self):
        return Revolute(phi=guess(self.start))

    def loop(self):
        yield chain(self.crank, self.j2, self.rod1, self.j3)
        yield chain(self.ground, self.j4, self.rod2)
        yield connect(self.rod2.frame_b, self.j3.frame_b)
        yield connect(self.rod2.frame_b, self.mass.frame_a)


@pytest.mark.parametrize(("start", "offset"), [(-1.0, 0.2), (1.0, 0.0)])
@pytest.mark.parametrize("kind", [JointUSR, JointRRR, JointSSR])
def test_assembly_moves_as_its_joints(kind, start, offset):
    """In both positions of the loop, whatever the zero of the last joint."""
    rod1 = {"rod1_length": 1} if kind is JointSSR else {"r_rod1_ia": (1, 0, 0)}
    settings = {"r_rod2_ib": (-0.6, 0, 0), "phi_guess": start - offset, "phi_offset": offset, **rod1}
    run = {"stop_time": 2.0, "tolerance": 1e-8, "intervals": 40}
    found = ac.simulate(Assembled(kind=kind, settings=settings), **run)
    plain = ac.simulate(Plain(start=start), **run)
    assert np.sign(plain["j4.phi"][0]) == np.sign(start)
    assert found["j1.phi"] == pytest.approx(plain["j1.phi"], abs=1e-5)
    assert found["joint.revolute.phi"] + offset == pytest.approx(plain["j4.phi"], abs=1e-5)
    assert found["mass.frame_a.f"] == pytest.approx(plain["mass.frame_a.f"], abs=1e-3)


class Slider(Plain):
    """The loop of joints with a slide, whose axis is 0.1 m above the ground."""

    rod2 = FixedTranslation(r=(-0.2, 0.1, 0))

    @part
    def j2(self):
        return Revolute(phi=guess(-1.6 if self.start < 0 else -4.6))

    @part
    def j4(self):
        return Prismatic(n=(-1, 0, 0), s=guess(self.start))


@pytest.mark.parametrize(("start", "offset"), [(-0.1, 0.2), (1.8, 0.0)])
@pytest.mark.parametrize("kind", [JointUSP, JointRRP, JointSSP])
def test_assembly_with_a_slide_moves_as_its_joints(kind, start, offset):
    """In both positions of the loop, whatever the zero of the slide."""
    rod1 = {"rod1_length": 1} if kind is JointSSP else {"r_rod1_ia": (1, 0, 0)}
    settings = {"n_b": (-1, 0, 0), "r_rod2_ib": (-0.2, 0.1, 0), "s_guess": start - offset, "s_offset": offset, **rod1}
    run = {"stop_time": 2.0, "tolerance": 1e-8, "intervals": 40}
    found = ac.simulate(Assembled(kind=kind, settings=settings), **run)
    plain = ac.simulate(Slider(start=start), **run)
    assert np.sign(plain["j4.s"][0] - 0.8) == np.sign(start - 0.8)
    assert found["j1.phi"] == pytest.approx(plain["j1.phi"], abs=1e-5)
    assert found["joint.prismatic.s"] + offset == pytest.approx(plain["j4.s"], abs=1e-5)
    assert found["mass.frame_a.f"] == pytest.approx(plain["mass.frame_a.f"], abs=1e-3)


class Held(Model):
    """Between two fixed points."""

    guessed = structural("guess of the slide", default=0.0)
    world, Fixed1, relativePosition = World(), Fixed(r=(1.7, 0.1, 0)), RelativePosition()

    @part
    def jointUSP(self):
        return JointUSP(r_rod1_ia=(1, 0.3, 0), r_rod2_ib=(-0.5, 0.2, 0), s_guess=self.guessed)

    def connections(self):
        yield connect(self.world.frame_b, self.jointUSP.frame_a)
        yield connect(self.Fixed1.frame_b, self.jointUSP.frame_b)
        yield chain(self.Fixed1, self.relativePosition, self.jointUSP.frame_a)


@pytest.mark.parametrize("guessed", [-3, 1.1, 1.3, 20])
def test_guess_of_the_slide_selects_the_nearer_position(guessed):
    """(1.2 - s)^2 + 0.3^2 = 1 + 0.3^2: s is 0.2 or 2.2."""
    result = ac.simulate(Held(guessed=guessed), stop_time=0.1)
    assert result["jointUSP.prismatic.s"] == pytest.approx(0.2 if guessed < 1.2 else 2.2, abs=1e-9)


def test_usp():
    """All forces and torques are 0."""
    names = {}
    for place in ("jointUSP.relativePosition.", "jointUSP.relativePosition.relativePosition."):
        ends = [f"frame_b.{v}[{k}]" for v in ("r_0", "f", "t") for k in (1, 2, 3)]
        names |= {place + end: "relativePosition." + end for end in ends}
    for k, (one, two) in enumerate(zip((1, 0.3, 0), (-0.5, 0.2, 0), strict=True), 1):
        names[f"rRod1_ia[{k}]"] = lambda r, x=one: np.full(len(r.time), x)
        names[f"rRod2_ib[{k}]"] = names[f"jointUSP.position_b[{k}].y"] = lambda r, x=two: np.full(len(r.time), x)
    compare("ModelicaTest.MultiBody.Joints.JointUSP", Held(), names, tolerance=1e-6)


def test_strut_of_negative_length_is_refused():
    class Backwards(Strut):
        strut = JointUPS(use_axis_flange=True, n_axis_ia=(-1, 0, 0))

    with pytest.raises(ac.AcausalError, match="initial length of the strut is negative; give n_axis_ia"):
        ac.simulate(Backwards(), stop_time=0.1)


class AtRest(Model):
    world, ground, joint = World(), Fixed(r=(1.5, 0.1, 0)), JointSSR(rod1_length=1)

    def connections(self):
        yield chain(self.world, self.joint, self.ground.frame_b)


def test_rod_of_an_assembly_by_default():
    result = ac.simulate(AtRest(), stop_time=0.1)
    rod2 = result["joint.frame_im.r_0"] - result["joint.frame_ib.r_0"]
    along = np.einsum("tij,tj->ti", result["joint.frame_ib.R.T"], rod2)
    np.testing.assert_allclose(along, np.tile((1, 0, 0), (len(along), 1)), atol=1e-9)
