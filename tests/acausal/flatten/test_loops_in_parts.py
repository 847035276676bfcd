"""Closed loops inside sub-assemblies are cut there; the motion equals that of the flat machine."""
# ruff: noqa: RUF012  (lists of parts in a class body)

from __future__ import annotations

import numpy as np
import pytest

import acausal as ac
from acausal import Component, Model, Scalar, chain, connect, fixed, guess, parameter, port
from components import Body, BodyRod, FixedTranslation, FlexibleBeam, Frame, Prismatic, Revolute, World


class Linkage(Component):
    """A planar four-bar with the frame of its ground and that of its coupler."""

    ends = ("base", "tip")
    angle: Scalar = parameter("angle of the crank at the start", unit="rad", default=1.0)
    speed: Scalar = parameter("speed of the crank at the start", unit="rad/s", default=0.0)
    base: Frame = port(Frame, "ground")
    tip: Frame = port(Frame, "end of the coupler")
    j1, j2 = Revolute(phi=fixed(angle), w=fixed(speed)), Revolute(phi=guess(-0.8))
    j3, j4 = Revolute(phi=guess(-1.5)), Revolute()
    b1, b2, b3 = BodyRod(r=(0.3, 0, 0), m=1), BodyRod(r=(1, 0, 0), m=1), BodyRod(r=(0.8, 0, 0), m=1)
    g = FixedTranslation(r=(1.1, 0, 0))

    def connections(self):
        yield connect(self.base, self.j1.frame_a)
        yield chain(self.j1, self.b1, self.j2, self.b2, self.j3, self.b3, self.j4)
        yield chain(self.base, self.g, self.j4.frame_b)
        yield connect(self.b2.frame_b, self.tip)


class Leg(Component):
    """A linkage in an assembly of its own, with a load on its coupler."""

    ends = ("base", "base")
    angle: Scalar = parameter("angle of the crank at the start", unit="rad", default=1.0)
    speed: Scalar = parameter("speed of the crank at the start", unit="rad/s", default=0.0)
    base: Frame = port(Frame, "where the leg is fixed")
    offset = FixedTranslation(r=(0, 0.5, 0))
    linkage = Linkage(angle=angle, speed=speed)
    load = BodyRod(r=(0.2, 0, 0), m=0.5)

    def connections(self):
        yield chain(self.base, self.offset, self.linkage, self.load)


class Flat(Model):
    """One leg, written in the model."""

    world, offset, g = World(), FixedTranslation(r=(0, 0.5, 0)), FixedTranslation(r=(1.1, 0, 0))
    j1, j2 = Revolute(phi=fixed(1), w=fixed(0)), Revolute(phi=guess(-0.8))
    j3, j4 = Revolute(phi=guess(-1.5)), Revolute()
    b1, b2, b3 = BodyRod(r=(0.3, 0, 0), m=1), BodyRod(r=(1, 0, 0), m=1), BodyRod(r=(0.8, 0, 0), m=1)
    load = BodyRod(r=(0.2, 0, 0), m=0.5)

    def connections(self):
        yield chain(self.world, self.offset, self.j1, self.b1, self.j2, self.b2, self.j3, self.b3, self.j4)
        yield chain(self.offset, self.g, self.j4.frame_b)
        yield chain(self.b2, self.load)


class OneLinkage(Model):
    world, arm = World(), Linkage()

    def connections(self):
        yield connect(self.world.frame_b, self.arm.base)


class OneLeg(Model):
    world, leg = World(), Leg()

    def connections(self):
        yield connect(self.world.frame_b, self.leg.base)


class TwoLegs(Model):
    """Two legs that start differently."""

    world = World()
    one, two = Leg(), Leg(angle=0.7, speed=2)

    def connections(self):
        yield connect(self.world.frame_b, self.one.base)
        yield connect(self.world.frame_b, self.two.base)


class Cart(Model):
    """A free cart that carries two legs."""

    world, rail, mass = World(), Prismatic(s=fixed(0), v=fixed(0)), Body(m=3)
    leg = [Leg(), Leg(angle=0.7, speed=2)]

    def connections(self):
        yield chain(self.world, self.rail, self.mass)
        yield from (chain(self.rail, leg) for leg in self.leg)


class FlatCart(Model):
    world, rail, mass = World(), Prismatic(s=fixed(0), v=fixed(0)), Body(m=3)
    offset, g = [FixedTranslation(r=(0, 0.5, 0)) for _ in "12"], [FixedTranslation(r=(1.1, 0, 0)) for _ in "12"]
    j1 = [Revolute(phi=fixed(1), w=fixed(0)), Revolute(phi=fixed(0.7), w=fixed(2))]
    j2, j3 = [Revolute(phi=guess(-0.8)) for _ in "12"], [Revolute(phi=guess(-1.5)) for _ in "12"]
    j4, load = [Revolute() for _ in "12"], [BodyRod(r=(0.2, 0, 0), m=0.5) for _ in "12"]
    b1, b2 = [BodyRod(r=(0.3, 0, 0), m=1) for _ in "12"], [BodyRod(r=(1, 0, 0), m=1) for _ in "12"]
    b3 = [BodyRod(r=(0.8, 0, 0), m=1) for _ in "12"]

    def connections(self):
        yield chain(self.world, self.rail, self.mass)
        for k in range(2):
            yield chain(self.rail, self.offset[k], self.j1[k], self.b1[k], self.j2[k], self.b2[k])
            yield chain(self.b2[k], self.j3[k], self.b3[k], self.j4[k])
            yield chain(self.offset[k], self.g[k], self.j4[k].frame_b)
            yield chain(self.b2[k], self.load[k])


def run(model: Model, **given: object) -> ac.Result:
    return ac.simulate(model, stop_time=1, tolerance=1e-8, **given)  # type: ignore[arg-type]


def test_a_linkage_in_a_part_moves_as_the_flat_one() -> None:
    assert run(OneLinkage())["arm.j1.phi"][-1] == pytest.approx(-4.51099, abs=1e-5)


def test_a_loop_in_an_assembly_of_assemblies_moves_as_the_flat_one() -> None:
    packed, flat = run(OneLeg()), run(Flat())
    for name in ("j1.phi", "j2.phi", "j3.phi", "j4.phi"):
        np.testing.assert_allclose(packed[f"leg.linkage.{name}"], flat[name], atol=1e-7)


def test_an_assembly_used_twice_starts_where_its_parent_says() -> None:
    result = run(TwoLegs())
    other = run(Flat(j1=Revolute(phi=fixed(0.7), w=fixed(2))))  # type: ignore[call-arg]
    np.testing.assert_allclose(result["one.linkage.j1.phi"], run(Flat())["j1.phi"], atol=1e-7)
    np.testing.assert_allclose(result["two.linkage.j1.phi"], other["j1.phi"], atol=1e-7)


def test_loops_of_two_assemblies_act_on_one_another_through_what_carries_them() -> None:
    packed, flat = run(Cart()), run(FlatCart())
    np.testing.assert_allclose(packed["rail.s"], flat["rail.s"], atol=1e-7)
    for k in range(2):
        np.testing.assert_allclose(packed[f"leg[{k}].linkage.j3.phi"], flat[f"j3[{k}].phi"], atol=1e-6)


class Half(Component):
    """A parallelogram; with its twin and a bar between their couplers it closes another loop."""

    base: Frame = port(Frame, "ground")
    tip: Frame = port(Frame, "end of the coupler")
    near, far = Revolute(phi=guess(1)), Revolute(phi=guess(1))
    pin, other = Revolute(phi=guess(-1)), Revolute(phi=guess(-1))
    crank, rocker = BodyRod(r=(0.3, 0, 0), m=1), BodyRod(r=(0.3, 0, 0), m=1)
    coupler, ground = BodyRod(r=(0.4, 0, 0), m=1), FixedTranslation(r=(0.4, 0, 0))

    def connections(self):
        yield chain(self.base, self.near, self.crank, self.pin, self.coupler, self.tip)
        yield chain(self.base, self.ground, self.far, self.rocker, self.other, self.coupler.frame_b)


class Ring(Model):
    """Two parallelograms side by side, pushed and pulled by a bar: all cranks stay parallel."""

    world, apart = World(), FixedTranslation(r=(1, 0, 0))
    left, right = Half(near=Revolute(phi=fixed(1), w=fixed(0.5))), Half()  # type: ignore[call-arg]
    bar, first, last = BodyRod(r=(1, 0, 0), m=1), Revolute(), Revolute()

    def connections(self):
        yield chain(self.world, self.left.base)
        yield chain(self.world, self.apart, self.right.base)
        yield chain(self.left.tip, self.first, self.bar, self.last, self.right.tip)


def test_a_loop_through_two_parts_is_cut_between_them() -> None:
    cuts = ac.compile(Ring()).reduced.flat.loops.cuts
    assert sorted(len(cut.parts) for cut in cuts) == [4, 4, 6]
    outer = max(cuts, key=lambda cut: len(cut.parts))
    assert {outer.a, outer.b} & {"bar.frame_a", "bar.frame_b", "left.tip", "right.tip"}
    result = run(Ring())
    angle, speed = result["left.near.phi"], result["left.near.w"]
    np.testing.assert_allclose(result["right.far.phi"], angle, atol=1e-7)
    # All couplers and the bar translate on a circle of 0.3 m; each of the four cranks turns about its end.
    energy = (3 * 0.3**2 + 4 * 0.3**2 / 3) * speed**2 / 2 + (3 + 4 / 2) * 9.80665 * 0.3 * np.sin(angle)
    np.testing.assert_allclose(energy, energy[0], rtol=1e-6)


class Flexible(Linkage):
    """The linkage with an elastic coupler."""

    b2 = FlexibleBeam(length=1, E=2e9, rho=1000, A=1e-4, J=1e-9, elements=2, geometric_stiffness=True)


class FlexibleFlat(Model):
    world, g = World(), FixedTranslation(r=(1.1, 0, 0))
    j1, j2 = Revolute(phi=fixed(1), w=fixed(0)), Revolute(phi=guess(-0.8))
    j3, j4 = Revolute(phi=guess(-1.5)), Revolute()
    b1, b3 = BodyRod(r=(0.3, 0, 0), m=1), BodyRod(r=(0.8, 0, 0), m=1)
    b2 = FlexibleBeam(length=1, E=2e9, rho=1000, A=1e-4, J=1e-9, elements=2, geometric_stiffness=True)

    def connections(self):
        yield chain(self.world, self.j1, self.b1, self.j2, self.b2, self.j3, self.b3, self.j4)
        yield chain(self.world, self.g, self.j4.frame_b)


class OneFlexible(Model):
    world, arm = World(), Flexible()

    def connections(self):
        yield connect(self.world.frame_b, self.arm.base)


def test_a_loop_in_a_part_with_an_elastic_body() -> None:
    packed, flat = (ac.simulate(m, stop_time=0.3, tolerance=1e-6) for m in (OneFlexible(), FlexibleFlat()))
    np.testing.assert_allclose(packed["arm.j1.phi"], flat["j1.phi"], atol=1e-5)
