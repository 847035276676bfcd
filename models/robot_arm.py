"""Robot arm: two elastic links in space on geared drives, which carry a payload within two seconds."""

from math import pi

import acausal as ac
from acausal import Model, Scalar, chain, connect, fixed, output, parameter, parts, piecewise, time
from components import Body, FixedRotation, FlexibleBeam, Revolute, Tube, World
from components.rotational import IdealGear, Inertia, Torque

START, END = (0.0, 0.9, -1.6), (pi / 2, 0.3, -0.5)  # angles of base, shoulder and elbow in rad
AXES = ((1, 0, 0), (0, 0, 1), (0, 0, 1))
STIFF, DAMPED = (2e4, 4e4, 2e4), (800.0, 1600.0, 600.0)  # of the controllers, at the joints, in N.m/rad and N.m.s/rad
LINK: dict = {"section": Tube(0.06, 0.052), "E": 7e10, "rho": 2700.0, "elements": 2, "beta": 1e-4}


class RobotArm(Model):
    """Base that turns about the vertical, shoulder and elbow; links of 1 m and 0.8 m, gears of 100 to 1."""

    stop_time = 3.0
    payload: Scalar = parameter("mass of the payload", unit="kg", default=5.0, minimum=0)
    world, upright, level = World(), FixedRotation(n=(0, 0, 1), angle=pi / 2), FixedRotation(n=(0, 0, 1), angle=-pi / 2)
    upper, fore = FlexibleBeam(length=1.0, **LINK), FlexibleBeam(length=0.8, **LINK)
    load = Body(m=payload)
    tip_x: Scalar = output("position of the payload along x", unit="m")
    tip_y: Scalar = output("height of the payload above the shoulder", unit="m")
    tip_z: Scalar = output("position of the payload along z", unit="m")

    @parts
    def joint(self):
        return [Revolute(n=n, use_axis_flange=True, phi=fixed(a), w=fixed(0)) for n, a in zip(AXES, START, strict=True)]

    @parts
    def gear(self):
        return [IdealGear(ratio=100.0) for _ in AXES]

    @parts
    def rotor(self):
        return [Inertia(J=2e-4) for _ in AXES]

    @parts
    def motor(self):
        return [Torque() for _ in AXES]

    def connections(self):
        base, shoulder, elbow = self.joint
        yield chain(self.world, self.upright, base, self.level, shoulder, self.upper, elbow, self.fore, self.load)
        for joint, gear, rotor, motor in zip(self.joint, self.gear, self.rotor, self.motor, strict=True):
            yield chain(motor, rotor, gear)
            yield connect(gear.flange_b, joint.axis)

    def equations(self):
        s = piecewise((time / 2, time < 2), 1.0, smooth=True)
        for joint, motor, a, b, k, d in zip(self.joint, self.motor, START, END, STIFF, DAMPED, strict=True):
            yield motor.tau == (k * (a + (b - a) * s**3 * (10 - 15 * s + 6 * s**2) - joint.phi) - d * joint.w) / 100
        r = self.load.frame_a.r_0
        yield from (self.tip_x == r[0], self.tip_y == r[1], self.tip_z == r[2])


if __name__ == "__main__":
    ac.simulate(RobotArm(), stop_time=RobotArm.stop_time).plot("tip_x", "tip_y", "tip_z", path="robot-arm.png")
