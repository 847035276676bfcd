"""Runs that cannot be followed to their end, and starts that say too much or too little."""

from __future__ import annotations

import numpy as np

import acausal as ac
from acausal import Model, chain, fixed
from components import Body, Revolute, Spherical, Spring, World


def point_mass_on_a_ball_joint(repaired):
    class M(Model):
        world, joint = World(), Spherical(angles_fixed=True, w_rel_a=fixed((0, 0, 0)))
        ball = Body(m=1, r_CM=(0, -1, 0) if repaired else (0, 0, 0), I=0.1 * np.eye(3) if repaired else np.zeros((3, 3)))

        def connections(self):
            yield chain(self.world, self.joint, self.ball)

    ac.compile(M())


def point_mass_on_a_spring(repaired):
    class M(Model):
        world, spring, ball = World(), Spring(c=1), Body(m=1, I=np.eye(3) if repaired else np.zeros((3, 3)))

        def connections(self):
            yield chain(self.world, self.spring, self.ball)

    ac.compile(M())


def point_mass_in_the_axis(repaired):
    class M(Model):
        world, hinge, ball = World(), Revolute(), Body(m=1, r_CM=(1 if repaired else 0, 0, 0))

        def connections(self):
            yield chain(self.world, self.hinge, self.ball)

    ac.compile(M())
