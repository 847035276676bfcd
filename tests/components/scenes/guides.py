"""Screws, racks, constant-velocity joints and curves, each in a scene."""

from __future__ import annotations

import numpy as np

from acausal import chain, connect, cos, fixed, part, sin
from components import (
    Body,
    ConstantVelocityJoint,
    FixedTranslation,
    PointOnCurve,
    Prismatic,
    RackAndPinion,
    Revolute,
    ScrewJoint,
)
from tests.components.scenes.drives import OnGearConstraint
from tests.components.scenes.joints import OnCylindrical
from tests.components.scenes.scene import OnSpherical, Scene


class OnScrewJoint(OnCylindrical):
    @part
    def it(self):
        sign = -1 if self.turned else 1
        return ScrewJoint(n=(1, 2, 2), pitch=0.5, phi=fixed(0.4 * sign), w=fixed(3.0 * sign), d=0.02, tau_dry=0.05)


class OnRackAndPinion(OnGearConstraint):
    """A pinion and the tip, which rides on the rack, move in a body that turns."""

    wheel = Body(m=0.5, I=np.diag([0.02, 0.03, 0.04]))
    it = RackAndPinion(radius=0.2, n_a=(1, 2, 0), n_b=(0, 0, 2), r_a=(0.1, 0, 0.2), phi=fixed(0.2), w=fixed(3.0))


class OnConstantVelocityJoint(Scene):
    """The joint drives the tip from a shaft that turns."""

    shaft, arm = Revolute(n=(1, 0, 0), phi=fixed(0.2), w=fixed(6.0)), FixedTranslation(r=(0.2, 0, 0))

    @part
    def it(self):
        sign = -1 if self.turned else 1
        return ConstantVelocityJoint(theta=fixed((0.3 * sign, -0.2 * sign)), w=fixed((1.0 * sign, 2.0 * sign)))

    def graph(self):
        yield from self.path(self.shaft, self.arm, self.it)


class OnPointOnCurve(OnSpherical):
    """A helix on a body that turns guides the tip, which slides on it along three axes."""

    base = Body(m=2.0, I=np.diag([0.1, 0.2, 0.15]))
    x, y, z = Prismatic(n=(1, 0, 0)), Prismatic(n=(0, 1, 0)), Prismatic(n=(0, 0, 1))

    @part
    def it(self):
        sign = -1 if self.turned else 1
        return PointOnCurve(
            curve=lambda u: (sign * 0.2 * cos(u), sign * 0.2 * sin(u), sign * 0.1 * u), u=fixed(0.5), der_u=fixed(3.0)
        )

    def graph(self):
        yield from super().graph()
        yield connect(self.joint.frame_b, self.base.frame_a)
        yield chain(self.base.frame_a, self.x, self.y, self.z, self.tip.frame_a)
