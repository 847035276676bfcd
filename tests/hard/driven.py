"""A planar four-bar whose crank a torque drives."""

from __future__ import annotations

from acausal import Model, chain, connect, fixed, guess
from components import BodyRod, FixedTranslation, Revolute, World
from components.rotational import Torque


class DrivenFourBar(Model):
    """What drives it says `torque.tau == ...`."""

    world = World()
    hinge = Revolute(phi=fixed(1.0), w=fixed(1.3), use_axis_flange=True)
    torque = Torque()
    crank = BodyRod(r=(0.5, 0, 0), m=1.0)
    pin = Revolute(phi=guess(-0.8))
    coupler = BodyRod(r=(1.5, 0, 0), m=2.0)
    joint = Revolute(phi=guess(-1.5))
    rocker = BodyRod(r=(-1.0, 0, 0), m=1.5)
    last = Revolute(phi=guess(0))
    base = FixedTranslation(r=(1.4, 0.1, 0))

    def connections(self):
        yield chain(self.world, self.hinge, self.crank, self.pin, self.coupler, self.joint, self.rocker, self.last)
        yield connect(self.last.frame_b, self.base.frame_b)
        yield connect(self.world.frame_b, self.base.frame_a)
        yield connect(self.torque.flange, self.hinge.axis)
