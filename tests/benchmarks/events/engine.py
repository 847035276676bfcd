"""V6 engine: six slider-cranks on one crankshaft, with the data of EngineV6 of the Modelica Standard Library."""

from __future__ import annotations

from math import asin, cos, pi, radians, sin

from acausal import (
    Component,
    Model,
    Scalar,
    chain,
    connect,
    der,
    fixed,
    guess,
    output,
    parameter,
    part,
    parts,
    piecewise,
    port,
    structural,
    variable,
)
from components import (
    Body,
    BodyBox,
    BodyCylinder,
    FixedRotation,
    FixedTranslation,
    Frame,
    Prismatic,
    Revolute,
    RevolutePlanarLoopConstraint,
    TranslationalFlange,
    World,
)
from components.rotational import Fixed, Friction, Inertia, Torque

TOP, PISTON, ROD, PIN_OFFSET, BORE = 0.42, 0.1, 0.2, 0.1, 0.1  # m
STEEL = 7700.0  # kg/m3
Z = (0, 0, 1)
PIN_MASS = STEEL * pi / 4 * 0.03**2 * 0.1
CHAMBER = TOP - (PISTON + ROD - PIN_OFFSET)
OFFSETS, BANKS = (-30, 90, 210, 210, 90, -30), (-30, 30, -30, 30, -30, 30)  # degrees
LOAD, W_NOMINAL, TAU_NOMINAL, DRY = 1.0, 200.0, 100.0, 5.0


class GasForce(Component):
    """Gas in a cylinder: one pressure over the position in compression, another in expansion (MSL's GasForce2)."""

    flange_a: TranslationalFlange = port(TranslationalFlange, "end of the cylinder")
    flange_b: TranslationalFlange = port(TranslationalFlange, "piston")
    L: Scalar = parameter("length of the chamber", unit="m", positive=True)
    d: Scalar = parameter("bore", unit="m", positive=True)
    x: Scalar = variable("position of the piston, 0 far from the end, 1 at it", unit="1")
    v_rel: Scalar = variable("speed away from the end", unit="m/s")
    press: Scalar = variable("pressure in bar")
    f: Scalar = variable("force on flange_b", unit="N")

    def equations(self):
        s_rel, x = self.flange_b.s - self.flange_a.s, self.x
        into = 177.4132 * x**4 - 287.2189 * x**3 + 151.8252 * x**2 - 24.9973 * x + 2.4
        into_end = 2836360 * x**4 - 10569296 * x**3 + 14761814 * x**2 - 9158505 * x + 2129670
        out_end = -3929704 * x**4 + 14748765 * x**3 - 20747000 * x**2 + 12964477 * x - 3036495
        out = 145.930 * x**4 - 131.707 * x**3 + 17.3438 * x**2 + 17.9272 * x + 2.4
        inwards = self.v_rel < 0
        yield x == 1 - s_rel / self.L
        yield self.v_rel == der(s_rel)
        cases = ((into, inwards & (x < 0.986061)), (into_end, inwards), (out_end, x > 0.933), out)
        yield self.press == piecewise(*cases)
        yield self.f == 1e5 * self.press * pi * self.d**2 / 4
        yield self.flange_b.f == -self.f
        yield self.flange_a.f == self.f

    def supplied_power(self):
        return self.f * self.v_rel


class Cylinder(Component):
    """Throw of a crankshaft, rod and piston in a cylinder, in the plane across z."""

    offset: float = structural("angle of the throw on the crankshaft, in degrees")
    bank: float = structural("inclination of the cylinder, in degrees")
    planar: bool = structural("whether the joint for planar loops closes the loop", default=False)
    shaft: Frame = port(Frame, "crankshaft")
    block: Frame = port(Frame, "engine block, at the crankshaft")
    throw, tilt = FixedRotation(n=Z, angle=offset * (pi / 180)), FixedRotation(n=Z, angle=bank * (pi / 180))
    arms = BodyBox(r=(0, PIN_OFFSET, 0), width=0.02, height=0.05, density=2 * STEEL, width_direction=Z)
    crank_pin = Body(m=PIN_MASS)
    rod = BodyBox(r=(0, ROD, 0), width=0.02, height=0.06, width_direction=Z)
    piston = BodyCylinder(r=(0, PISTON, 0), diameter=BORE)
    head, gas = FixedTranslation(r=(0, TOP, 0)), GasForce(L=CHAMBER, d=BORE)

    @property
    def angles(self) -> tuple[float, float]:
        """Angles of throw and rod from the cylinder at the start."""
        throw = radians(self.offset - self.bank)
        return throw, -asin(PIN_OFFSET / ROD * sin(throw))

    @part
    def big_end(self):
        throw, rod = self.angles
        return RevolutePlanarLoopConstraint() if self.planar else Revolute(phi=guess(rod - throw))

    @part
    def wrist(self):
        return Revolute(phi=guess(-self.angles[1]))

    @part
    def guide(self):
        throw, rod = self.angles
        s = TOP - PISTON - PIN_OFFSET * cos(throw) - ROD * cos(rod)
        return Prismatic(n=(0, -1, 0), use_axis_flange=True, s=guess(s))

    def connections(self):
        yield chain(self.shaft, self.throw, self.arms, self.big_end, self.rod, self.wrist, self.piston.frame_a)
        yield connect(self.arms.frame_b, self.crank_pin.frame_a)
        yield chain(self.block, self.tilt, self.head, self.guide, self.piston.frame_b)
        yield connect(self.guide.support, self.gas.flange_a)
        yield connect(self.guide.axis, self.gas.flange_b)


class EngineV6(Model):
    """Six cylinders in two banks at 60 degrees fire every 60 degrees, each once a turn; the load grows with the speed.

    Left out of the original: its extent along the shaft, which only loads the bearings, and the filter of the torque.
    At the start one piston is at its end and another far from it, where the law of the gas changes.
    """

    stop_time = 1.01
    planar: bool = structural("whether the joint for planar loops closes each loop", default=False)
    world, bearing = World(), Revolute(use_axis_flange=True)
    load = Inertia(J=LOAD, phi=fixed(0), w=fixed(10))
    brake, housing, drag = Friction(tau_sliding=DRY), Fixed(), Torque()
    angle: Scalar = output("angle of the crankshaft", unit="rad")
    speed: Scalar = output("speed of the crankshaft", unit="rad/s")

    @parts
    def cylinders(self):
        return [Cylinder(offset=o, bank=b, planar=self.planar) for o, b in zip(OFFSETS, BANKS, strict=True)]

    def connections(self):
        yield chain(self.world, self.bearing)
        for cylinder in self.cylinders:
            yield connect(self.world.frame_b, cylinder.block)
            yield connect(self.bearing.frame_b, cylinder.shaft)
        yield chain(self.bearing.axis, self.load, self.drag.flange)
        yield chain(self.housing.flange, self.brake, self.load.flange_b)

    def equations(self):
        yield self.drag.tau == -TAU_NOMINAL * (self.load.w / W_NOMINAL) ** 2
        yield self.angle == self.load.phi
        yield self.speed == self.load.w
