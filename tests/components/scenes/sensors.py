"""Sensors of frames, each in a scene."""

from __future__ import annotations

from acausal import connect
from components import FixedTranslation
from components import sensors as s
from tests.components.scenes.scene import Plain


class OnSensor(Plain):
    """A sensor at the tip."""

    def graph(self):
        yield from super().graph()
        yield connect(self.it.frame_a, self.tip.frame_a)


class OnAbsolutePosition(OnSensor):
    it = s.AbsolutePosition(resolve_in_frame="world")


class OnAbsoluteVelocity(OnSensor):
    it = s.AbsoluteVelocity()


class OnAbsoluteAngularVelocity(OnSensor):
    it = s.AbsoluteAngularVelocity(resolve_in_frame="world")


class OnAbsoluteAngles(OnSensor):
    it = s.AbsoluteAngles()


class OnAbsoluteSensor(OnSensor):
    it = s.AbsoluteSensor()


class Between(Plain):
    """A sensor between a point of the place and the tip."""

    anchor = FixedTranslation(r=(0.5, -0.6, 0.2))

    def graph(self):
        yield from super().graph()
        first, second = self.through(self.it)
        yield connect(self.place.frame_b, self.anchor.frame_a)
        yield connect(self.anchor.frame_b, first)
        yield connect(second, self.tip.frame_a)


class OnRelativePosition(Between):
    it = s.RelativePosition()


class OnRelativeVelocity(Between):
    it = s.RelativeVelocity(resolve_in_frame="frame_b")


class OnRelativeAngularVelocity(Between):
    it = s.RelativeAngularVelocity(resolve_in_frame="world")


class OnRelativeAngles(Between):
    it = s.RelativeAngles()


class OnRelativeSensor(Between):
    it = s.RelativeSensor()


class OnDistance(Between):
    it = s.Distance()


class Cut(Plain):
    """A sensor between the joint and the tip."""

    def graph(self):
        yield from self.path(self.joint, self.it)


class OnCutForce(Cut):
    it = s.CutForce()


class OnCutTorque(Cut):
    it = s.CutTorque()


class OnCutForceAndTorque(Cut):
    it = s.CutForceAndTorque(resolve_in_frame="world")


class OnPower(Cut):
    it = s.Power()
