"""Drive trains on moving bodies: Modelica.Mechanics.MultiBody.Examples.Rotational3DEffects."""

from __future__ import annotations

import numpy as np

from acausal import Model, chain, connect, fixed, part, sine
from components import BevelGear1D, BodyBox, BodyShape, Fixed, Mounting1D, Revolute, Rotor1D, Torque, World, rotational
from tests.reference.msl.published import compare

EFFECTS = "Modelica.Mechanics.MultiBody.Examples.Rotational3DEffects."
X, Y, Z = np.eye(3)


class Bevel(Model):
    """A bevel gear with its rotors on a box that is turned about three axes."""

    world = World()
    inertia1 = Rotor1D(J=1.1, n=X, phi=fixed(0), w=fixed(0))
    inertia2, bevelGear = Rotor1D(J=18.2, n=Y), BevelGear1D(ratio=10, n_a=X, n_b=Y)
    revolute1, revolute2, revolute3 = (Revolute(n=n, use_axis_flange=True, phi=fixed(0), w=fixed(0)) for n in (X, Y, Z))
    torque1, torque2, torque3 = (rotational.Torque(tau=sine(amplitude=10 * k + 60, f=k)) for k in (5, 6, 7))
    torque, mounting1D = rotational.Torque(tau=sine(amplitude=140, f=8), use_support=True), Mounting1D(n=X)
    bodyBox = BodyBox(r=(0.1, 0.1, 0.1), length=0.1, width=0.1)

    def connections(self):
        yield chain(self.world, self.revolute1, self.revolute2, self.revolute3, self.bodyBox)
        for k in (1, 2, 3):
            yield connect(getattr(self, f"torque{k}").flange, getattr(self, f"revolute{k}").axis)
        yield chain(self.torque.flange, self.inertia1, self.bevelGear, self.inertia2)
        yield connect(self.torque.support, self.mounting1D.flange_b)
        for item in (self.mounting1D, self.inertia1, self.inertia2, self.bevelGear):
            yield connect(item.frame_a, self.revolute3.frame_b)


def test_bevel_gear():
    """Near gimbal lock, revolute1 passes 2,950 rad/s within a millisecond, where values lie between many rows."""
    compare(EFFECTS + "BevelGear1D", Bevel(), run=1e-9, intervals=20000)


class Drives(Model):
    """A body that a torque turns, and a rotor that a drive turns, each on a table that turns as prescribed."""

    world, ground = World(g=0), Fixed()
    r1, r2 = Revolute(n=Y, use_axis_flange=True), Revolute(n=Y, use_axis_flange=True)
    mounting1D1, mounting1D2, mounting1D = Mounting1D(n=Y), Mounting1D(n=Y), Mounting1D()
    revolute, bodyCylinder = (
        Revolute(n=X, phi=fixed(0), w=fixed(0)),
        BodyShape(r=(0.5, 0, 0), m=0, I=np.diag([2, 0, 0])),
    )
    torque = Torque(torque=(sine(f=1), 0, 0))
    rotor1D, torque1 = Rotor1D(J=2, phi=fixed(0), w=fixed(0)), rotational.Torque(tau=sine(f=1), use_support=True)

    @part
    def position1(self):
        return self.table()

    @part
    def position2(self):
        return self.table()

    def table(self):
        return rotational.Position(phi_ref=sine(amplitude=2, f=1), exact=False, use_support=True, w=fixed(0))

    def connections(self):
        yield chain(self.world, self.r1, self.revolute, self.bodyCylinder)
        yield chain(self.r1, self.torque, self.bodyCylinder.frame_b)
        yield chain(self.ground.frame_b, self.r2)
        for position, joint, mounting, base in (
            (self.position1, self.r1, self.mounting1D1, self.world),
            (self.position2, self.r2, self.mounting1D2, self.ground),
        ):
            yield connect(position.flange, joint.axis)
            yield connect(position.support, mounting.flange_b)
            yield connect(mounting.frame_a, base.frame_b)
        yield connect(self.torque1.flange, self.rotor1D.flange_a)
        yield connect(self.torque1.support, self.mounting1D.flange_b)
        yield connect(self.r2.frame_b, self.rotor1D.frame_a)
        yield connect(self.r2.frame_b, self.mounting1D.frame_a)


def test_moving_actuated_drive():
    compare(EFFECTS + "MovingActuatedDrive", Drives())
