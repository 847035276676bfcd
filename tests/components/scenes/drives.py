"""Drive trains on bodies that move, each in a scene."""

from __future__ import annotations

import numpy as np

from acausal import chain, connect, fixed, part, sin, time
from components import BevelGear1D, Body, GearConstraint, Mounting1D, Rotor1D
from components import rotational as r
from tests.components.scenes.scene import OnSpherical, Plain


class OnRotor(Plain):
    """A motor on the tip turns a rotor."""

    motor = r.Torque(tau=0.2 * sin(3 * time), use_support=True)
    mounting = Mounting1D(n=(1, 2, 0))
    it = Rotor1D(J=0.05, n=(1, 2, 0), phi=fixed(0.1), w=fixed(8.0))

    def graph(self):
        yield from super().graph()
        yield connect(self.mounting.frame_a, self.tip.frame_a)
        yield connect(self.motor.support, self.mounting.flange_b)
        yield from self.train()

    def train(self):
        first, _ = self.through(self.it)
        yield connect(self.it.frame_a, self.tip.frame_a)
        yield connect(self.motor.flange, first)


class OnMounting(OnRotor):
    it = Mounting1D(n=(1, 2, 0))
    mounting = None
    rotor = Rotor1D(J=0.05, n=(1, 2, 0), phi=fixed(0.1), w=fixed(8.0))

    def graph(self):
        yield from self.path(self.joint)
        yield connect(self.it.frame_a, self.tip.frame_a)
        yield connect(self.motor.support, self.it.flange_b)
        yield connect(self.rotor.frame_a, self.tip.frame_a)
        yield connect(self.motor.flange, self.rotor.flange_a)


class OnBevelGear(OnRotor):
    """The motor drives a second rotor through a gear of crossed axes."""

    rotor = Rotor1D(J=0.05, n=(1, 2, 0))
    wheel = Rotor1D(J=0.1, n=(0, 1, -1), phi=fixed(0.1), w=fixed(8.0))

    @part
    def it(self):
        axes = {"n_a": (1, 2, 0), "n_b": (0, 1, -1)}
        return (
            BevelGear1D(ratio=0.5, n_a=axes["n_b"], n_b=axes["n_a"]) if self.turned else BevelGear1D(ratio=2.0, **axes)
        )

    def train(self):
        first, second = self.through(self.it)
        for bearing in (self.rotor, self.wheel, self.it):
            yield connect(bearing.frame_a, self.tip.frame_a)
        yield chain(self.motor.flange, self.rotor, first)
        yield connect(second, self.wheel.flange_a)


class OnGearConstraint(OnSpherical):
    """A wheel and the tip turn in a body that turns."""

    base, wheel = Body(m=2.0, I=np.diag([0.1, 0.2, 0.15])), Body(m=0.5, I=np.diag([0.02, 0.03, 0.04]))
    it = GearConstraint(ratio=-2.5, n_a=(1, 2, 0), n_b=(0, 1, -1), r_a=(0.1, 0, 0.2), phi_b=fixed(0.2), w_b=fixed(3.0))

    def graph(self):
        yield connect(self.place.frame_b, self.joint.frame_a)
        yield connect(self.joint.frame_b, self.base.frame_a)
        yield connect(self.base.frame_a, self.it.bearing)
        yield connect(self.it.frame_a, self.wheel.frame_a)
        yield connect(self.it.frame_b, self.tip.frame_a)
