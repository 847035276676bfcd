"""Springs, dampers and loads, each in a scene."""

from __future__ import annotations

from typing import Any

import numpy as np

from acausal import connect, cos, fixed, part, sin, time
from components import (
    Body,
    Damper,
    FixedTranslation,
    Force,
    ForceAndTorque,
    LineForceWithMass,
    LineForceWithTwoMasses,
    Prismatic,
    Revolute,
    Spherical,
    Spring,
    SpringDamperParallel,
    SpringDamperSeries,
    Torque,
    WorldForce,
    WorldForceAndTorque,
    WorldTorque,
    translational,
)
from tests.components.scenes.scene import SPIN, OnSpherical, Plain, Scene


class Line(Scene):
    """A force between a point of the place and a body on an arm."""

    joint = Spherical(angles_fixed=True, w_rel_a=fixed(tuple(SPIN)))
    arm = FixedTranslation(r=(0.3, 0.2, 0.1))
    anchor = FixedTranslation(r=(0.5, -0.6, 0.2))

    def graph(self):
        yield from self.path(self.joint, self.arm)
        first, second = self.through(self.it)
        yield connect(self.place.frame_b, self.anchor.frame_a)
        yield connect(self.anchor.frame_b, first)
        yield connect(second, self.tip.frame_a)


class OnSpring(Line):
    @part
    def it(self):
        return Spring(c=70.0, s_unstretched=0.4, m=0.6, length_fraction=0.8 if self.turned else 0.2)


class OnDamper(Line):
    it = Damper(d=2.0)


class OnSpringDamper(Line):
    it = SpringDamperParallel(c=70.0, d=2.0, s_unstretched=0.4)


class OnLineForceWithMass(Line):
    """A spring and a damper of one-dimensional translation, and a mass on the line."""

    spring, damper = translational.Spring(c=70.0, s_rel0=0.4), translational.Damper(d=2.0)

    @part
    def it(self):
        return LineForceWithMass(m=0.7, length_fraction=0.7 if self.turned else 0.3)

    def graph(self):
        yield from super().graph()
        for member in (self.spring, self.damper):
            yield connect(self.it.flange_a, member.flange_a)
            yield connect(member.flange_b, self.it.flange_b)


class OnLineForceWithTwoMasses(OnLineForceWithMass):
    @part
    def it(self):
        m_a, m_b, L_a, L_b = (0.5, 0.7, 0.2, 0.1) if self.turned else (0.7, 0.5, 0.1, 0.2)
        return LineForceWithTwoMasses(m_a=m_a, m_b=m_b, L_a=L_a, L_b=L_b)


class OnSpringDamperSeries(Line):
    """From the damper to the spring; turned round, from the spring to the damper, which is the same force."""

    it = SpringDamperSeries(c=70.0, d=8.0, s_unstretched=0.4, s_damper=fixed(0.1))


PUSH = np.array([3.0, -2.0, 4.0])


class Between(OnSpherical):
    """A load between a body that turns and a tip that slides or turns on it."""

    base = Body(m=2.0, I=np.diag([0.1, 0.2, 0.15]))

    def load(self, kind: Any, name: str) -> Any:
        sign, frame = (-1, "frame_a") if self.turned else (1, "frame_b")
        value = tuple(sign * c * (1 + cos(6 * time)) for c in PUSH)
        return kind(resolve_in_frame=frame, **{name: value})

    def graph(self):
        yield from self.path(self.joint, self.mobile)
        yield connect(self.joint.frame_b, self.base.frame_a)
        first, second = self.through(self.it)
        yield connect(self.base.frame_a, first)
        yield connect(self.tip.frame_a, second)


class OnForce(Between):
    mobile = Prismatic(n=(1, 2, 2), s=fixed(0.3), v=fixed(0.5))

    @part
    def it(self):
        return self.load(Force, "force")


class OnTorque(Between):
    mobile = Revolute(n=(1, 2, 2), phi=fixed(0.3), w=fixed(0.5))

    @part
    def it(self):
        return self.load(Torque, "torque")


class OnForceAndTorque(Between):
    """Both at once, resolved in a frame of its own, which turns with the place."""

    mobile = Spherical(angles_fixed=True, w_rel_a=fixed((0.5, -0.3, 0.2)))

    @part
    def it(self):
        sign = -1 if self.turned else 1
        force, torque = (tuple(sign * c * (1 + cos(6 * time)) for c in v) for v in (PUSH, 0.1 * PUSH[::-1]))
        return ForceAndTorque(force=force, torque=torque, resolve_in_frame="frame_resolve")

    def graph(self):
        yield from super().graph()
        yield connect(self.it.frame_resolve, self.place.frame_b)


class Outside(Plain):
    """A load from outside, in one scene resolved in the world, added to one resolved in frame_b."""

    arm = FixedTranslation(r=(0.3, 0.2, 0.1))
    kind: Any = None
    what = ""

    @part
    def it(self):
        return self.kind(**{self.what: tuple(c * (1 + cos(6 * time)) for c in self.turn.apply(PUSH))})

    @part
    def own(self):
        return self.kind(resolve_in_frame="frame_b", **{self.what: tuple(c * sin(4 * time) for c in PUSH[::-1])})

    def graph(self):
        yield from self.path(self.joint, self.arm)
        yield connect(self.it.frame_b, self.tip.frame_a)
        yield connect(self.own.frame_b, self.tip.frame_a)


class OnWorldForce(Outside):
    kind, what = WorldForce, "force"


class OnWorldTorque(Outside):
    kind, what = WorldTorque, "torque"


class OnWorldForceAndTorque(OnWorldForce):
    @part
    def it(self):
        force, torque = (tuple(c * (1 + cos(6 * time)) for c in self.turn.apply(v)) for v in (PUSH, 0.1 * PUSH[::-1]))
        return WorldForceAndTorque(force=force, torque=torque)
