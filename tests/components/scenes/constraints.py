"""Joints as constraints, each in a scene."""

from __future__ import annotations

from typing import Any

import numpy as np

from acausal import connect, dot, fixed, part, quantity
from components import Body, FreeMotion, constraints
from components.orientation import unit_vector
from tests.components.scenes.scene import SPIN, OnSpherical

SPEED = quantity(3.0, "rad/s")


class OnConstraint(OnSpherical):
    """The tip moves freely from a body that turns, but for the constraint."""

    base, free = Body(m=2.0, I=np.diag([0.1, 0.2, 0.15])), FreeMotion()
    it: Any

    def graph(self):
        yield from super().graph()
        yield connect(self.joint.frame_b, self.base.frame_a)
        yield connect(self.base.frame_a, self.free.frame_a)
        yield connect(self.free.frame_b, self.tip.frame_a)


class OnSphericalConstraint(OnConstraint):
    it, free = constraints.Spherical(), FreeMotion(angles_fixed=True, w_rel_a=fixed(tuple(SPIN)))


class OnRevoluteConstraint(OnConstraint):
    it = constraints.Revolute(n=(1, 2, 2))

    def initial_equations(self):
        yield dot(unit_vector(self.it.n), self.free.w_rel_a) == SPEED
        yield self.free.Q[0] == 0.1


class OnUniversalConstraint(OnConstraint):
    axes = (1, 2, 0), (0, 1, 1)

    @part
    def it(self):
        n_a, n_b = self.axes[::-1] if self.turned else self.axes
        return constraints.Universal(n_a=n_a, n_b=n_b)

    def initial_equations(self):
        for k, n in enumerate(self.axes):
            yield dot(unit_vector(n), self.free.w_rel_a) == SPEED
            yield self.free.Q[2 * k] == 0.1


class OnPrismaticConstraint(OnConstraint):
    it = constraints.Prismatic(y_locked=False)

    def initial_equations(self):
        yield self.free.r_rel_a[1] == quantity(0.1, "m")
        yield self.free.v_rel_a[1] == quantity(1.0, "m/s")
