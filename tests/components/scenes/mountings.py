"""Elastic mountings and force laws, each in a scene."""

from __future__ import annotations

import numpy as np

from acausal import connect, part
from components import Bushing, Drag, FixedTranslation, LineForceLaw, Rope, TriaxialSpring
from tests.components.scenes.forces import Line
from tests.components.scenes.scene import Plain


class OnBushing(Line):
    """Its force lies on the line between the frames, so that it is the same turned round."""

    @part
    def it(self):
        coupling, damping, sign = np.zeros((6, 6)), np.zeros((6, 6)), -1 if self.turned else 1
        coupling[3:, 3:] = [[3.0, 1.0, 0.0], [1.0, 2.0, -0.5], [0.0, -0.5, 1.0]]
        damping[3:, 3:] = 0.05 * np.eye(3)
        return Bushing(
            c=(70, 70, 70),
            c_phi=(1, 5, 20),
            d_phi=(0.1, 0.1, 0.1),
            stiffness=coupling,
            damping=damping,
            t_0=(0.3 * sign, 0, 0.1 * sign),
        )


class OnTriaxialSpring(Line):
    it = TriaxialSpring(c=(70, 70, 70))


class OnLineForceLaw(Line):
    """A spring that stiffens, with its energy, a damper with the square of the speed and a preload."""

    @part
    def it(self):
        return LineForceLaw(
            force=lambda s, v: 60 * (s - 0.4) + 300 * (s - 0.4) ** 3 + 3 * v * abs(v),
            energy=lambda s: 30 * (s - 0.4) ** 2 + 75 * (s - 0.4) ** 4,
            f_0=2.0,
        )


class OnRope(Line):
    """Over a point of the place and one of the tip, slack at first."""

    above, beside = FixedTranslation(r=(0.2, 0.8, 0.1)), FixedTranslation(r=(0.1, 0.1, -0.1))
    it = Rope(points=2, c=60.0, d=2.0, length=2.48)

    def graph(self):
        yield from super().graph()
        near, far = ("frame_2", "frame_1") if self.turned else ("frame_1", "frame_2")
        yield connect(self.place.frame_b, self.above.frame_a)
        yield connect(self.above.frame_b, getattr(self.it, near))
        yield connect(self.joint.frame_b, self.beside.frame_a)
        yield connect(self.beside.frame_b, getattr(self.it, far))


class OnDrag(Plain):
    """A wind across the tip, which turns with the place."""

    arm = FixedTranslation(r=(0.3, 0.2, 0.1))

    @part
    def it(self):
        return Drag(c_d=1.1, A=0.5, v_wind=tuple(self.turn.apply((4.0, 1.0, -2.0))))

    def graph(self):
        yield from self.path(self.joint, self.arm)
        yield connect(self.it.frame_b, self.tip.frame_a)
