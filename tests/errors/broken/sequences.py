"""Axes of the angles at the start that there are not."""

import numpy as np

import acausal as ac
from acausal import Model, chain
from components import Body, Spherical, World


class Free(Model):
    world, ball = World(), Body(m=1, I=np.eye(3), angles_fixed=True)


def fifth_axis_of_a_body(repaired):
    class M(Model):
        world = World()
        ball = Body(m=1, I=np.eye(3), sequence_start=(1, 2 if repaired else 5, 3), angles_fixed=True)

    ac.compile(M())


def axis_0_of_a_joint(repaired):
    class M(Model):
        world, ball = World(), Body(m=1, I=np.eye(3))
        joint = Spherical(sequence_start=(3 if repaired else 0, 1, 2))

        def connections(self):
            yield chain(self.world, self.joint, self.ball)

    ac.compile(M())


def half_an_axis_by_path(repaired):
    ac.compile(Free(), {"ball.sequence_start": (1, 2, 3 if repaired else 2.5)})
