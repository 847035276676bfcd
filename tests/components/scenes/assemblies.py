"""Assemblies of joints, each in a scene."""

from __future__ import annotations

from typing import Any, ClassVar

from acausal import chain, connect, fixed, part, structural
from components import FixedTranslation, Revolute, Spring, translational
from components.assemblies import JointRRP, JointRRR, JointSSP, JointSSR, JointUPS, JointUSP, JointUSR
from tests.components.scenes.scene import Scene


class OnCrank(Scene):
    """A crank carries the tip; the assembly leads from it to the ground."""

    joint, arm = Revolute(phi=fixed(0.4), w=fixed(5.0)), FixedTranslation(r=(0.3, 0, 0))
    ground = FixedTranslation(r=(1, 0, 0))
    it: Any

    def graph(self):
        yield from self.path(self.joint, self.arm)
        yield chain(self.place, self.ground)
        first, second = self.through(self.it)
        yield connect(self.arm.frame_b, first)
        yield connect(self.ground.frame_b, second)


class OnJointUPS(OnCrank):
    """A spring drives the strut."""

    spring = translational.Spring(c=60.0, s_rel0=0.4)

    @part
    def it(self):
        return JointUPS(n_axis_ia=(-1 if self.turned else 1, 0, 0), use_axis_flange=True)

    def graph(self):
        yield from super().graph()
        yield connect(self.spring.flange_a, self.it.support)
        yield connect(self.spring.flange_b, self.it.axis)


class OnJointUSR(OnCrank):
    """A spring loads the joint between rods of one length, which turn round without a change."""

    spring, post = Spring(c=60.0, s_unstretched=0.2), FixedTranslation(r=(0.2, 1.5, 0))

    @part
    def it(self):
        return JointUSR(r_rod1_ia=(0.8, 0, 0), **self.rod2())

    def rod2(self):
        return {"r_rod2_ib": (-0.8, 0, 0), "phi_guess": -2.4 if self.turned else -1.1}

    def graph(self):
        yield from super().graph()
        yield chain(self.place, self.post, self.spring, self.it.frame_im)


class OnJointRRR(OnJointUSR):
    @part
    def it(self):
        return JointRRR(r_rod1_ia=(0.8, 0, 0), **self.rod2())


class OnJointSSR(OnJointUSR):
    @part
    def it(self):
        return JointSSR(rod1_length=0.8, **self.rod2())


class OnJointUSP(OnCrank):
    """Without a load, as turned round, the slide is on the crank."""

    use_axis_flange = structural("whether a spring loads the slide", default=False)
    kind: ClassVar[type] = JointUSP

    @part
    def it(self):
        return self.kind(use_axis_flange=self.use_axis_flange, r_rod2_ib=(0, 0.2, 0), **self.rod1())

    def rod1(self):
        return {"r_rod1_ia": (1.5, 0, 0)}


class OnJointRRP(OnJointUSP):
    kind: ClassVar[type] = JointRRP


class OnJointSSP(OnJointUSP):
    kind: ClassVar[type] = JointSSP

    def rod1(self):
        return {"rod1_length": 1.5, "n_b": (-1, 0, 0)}


class Sprung(OnJointUSP):
    """A spring loads the slide."""

    use_axis_flange = structural("whether a spring loads the slide", default=True)
    spring = translational.Spring(c=60.0, s_rel0=0.4)

    def graph(self):
        yield from super().graph()
        yield connect(self.spring.flange_a, self.it.support)
        yield connect(self.spring.flange_b, self.it.axis)


class OnSprungRRP(Sprung):
    kind: ClassVar[type] = JointRRP


class OnSprungSSP(Sprung, OnJointSSP):
    """The rod has a mass."""

    def rod1(self):
        return super().rod1() | {"rod1_mass": 0.5}
