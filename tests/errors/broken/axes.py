"""Loops of joints of which one has a wrong axis."""

import numpy as np

import acausal as ac
from acausal import Model, chain, connect, fixed
from components import Body, FixedTranslation, Revolute, World


class FourBar(Model):
    """Four hinges about z."""

    world, r = World(), (1, 0, 0)
    j1, b1 = Revolute(phi=fixed(0.5), w=fixed(1)), FixedTranslation(r=r)
    j2, b2 = Revolute(phi=ac.guess(0.5)), FixedTranslation(r=r)
    j3, b3 = Revolute(phi=ac.guess(-1)), FixedTranslation(r=r)
    j4, ground, m = Revolute(), FixedTranslation(r=(2, 0, 0)), Body(m=1, I=np.eye(3))

    def connections(self):
        yield chain(self.world, self.j1, self.b1, self.j2, self.b2, self.j3, self.b3, self.j4)
        yield chain(self.world, self.ground)
        yield connect(self.ground.frame_b, self.j4.frame_b)
        yield connect(self.b2.frame_b, self.m.frame_a)


def axis_across_a_planar_loop(repaired):
    class M(FourBar):
        j2 = Revolute(phi=ac.guess(0.5), n=(0, 0, 1) if repaired else (1, 0, 0))

    ac.simulate(M(), stop_time=0.01)


def skew_axis_in_a_planar_loop(repaired):
    class M(FourBar):
        j3 = Revolute(phi=ac.guess(-1), n=(0 if repaired else 0.01, 0, 1))

    ac.simulate(M(), stop_time=0.01)


def axis_of_the_last_joint(repaired):
    class M(FourBar):
        j4 = Revolute(n=(0, 0, -2) if repaired else (0, 1, 0))

    ac.simulate(M(), stop_time=0.01)
