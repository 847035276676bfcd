"""A wheel on the ground."""

from __future__ import annotations

import numpy as np

from acausal import connect, cos, fixed, part
from components import Body, FreeMotion, Tyre
from tests.components.scenes.scene import SHIFT, Scene


class OnTyre(Scene):
    """A wheel that falls on an uneven ground inclined and turning, slides, rolls and bounces."""

    joint = FreeMotion(
        r_rel_a=fixed((0.1, 0.31, 0.2)),
        v_rel_a=fixed((3.0, -0.5, 0.4)),
        angles_start=(0.1, 0.2, 0.0),
        angles_fixed=True,
        w_rel_a=fixed((0.2, 1.0, -3.0)),
    )
    tip = Body(m=4.0, I=np.diag([0.1, 0.1, 0.2]))

    @part
    def it(self):
        up, n_x = (self.turn.apply(axis) for axis in ((0, 1, 0), (1, 0, 0)))
        x_0, y_0, z_0 = (SHIFT @ axis * self.moved for axis in (n_x, np.cross(up, n_x), up))
        return Tyre(
            R_0=0.3,
            c_z=2e4,
            d_z=60,
            c_kappa=600,
            c_alpha=400,
            mu=0.8,
            up=tuple(up),
            n_x=tuple(n_x),
            height=lambda x, y: z_0 + 0.02 * cos(5 * (x - x_0) + 2 * (y - y_0)),
        )

    def graph(self):
        yield from self.path(self.joint)
        yield connect(self.tip.frame_a, self.it.frame_a)
