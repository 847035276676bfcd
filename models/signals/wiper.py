"""Wiper: a blade with stiction behind a worm gear and a crank, and a motor of two speeds."""

from __future__ import annotations

from acausal import Component, Model, Scalar, connect, cos, fixed, output, parameter, piecewise, port, sin, time
from components import Flange, rotational
from components import electrical as el


class CrankRocker(Component):
    """Rocker that swings by the sine of the angle of a crank, without losses."""

    swing: Scalar = parameter("amplitude of the rocker", unit="rad", default=0.8)
    crank: Flange = port(Flange, "crank")
    rocker: Flange = port(Flange, "rocker")

    def equations(self):
        yield self.rocker.phi == self.swing * sin(self.crank.phi)
        yield self.crank.tau + self.swing * cos(self.crank.phi) * self.rocker.tau == 0


class Wiper(Model):
    """Wiper blade that is switched on at the slow speed, then to the fast one, and off."""

    stop_time = 6.0
    slow: Scalar = parameter("voltage of the slow speed", unit="V", default=8)
    fast: Scalar = parameter("voltage of the fast speed", unit="V", default=13)
    motor = el.DCPermanentMagnet(
        V_a_nominal=12,
        I_a_nominal=10,
        w_nominal=300,
        R_a=0.3,
        L_a=1e-3,
        J_r=1e-4,
        ia=fixed(0),
        phi_mechanical=fixed(0.1),
        w_mechanical=fixed(0),
    )
    supply, ground = el.SignalVoltage(), el.Ground()
    worm, rod = rotational.IdealGear(ratio=60), CrankRocker()
    blade = rotational.Inertia(J=0.05)
    rubber = rotational.BearingFriction(tau_pos=3, peak=1.3)
    angle: Scalar = output("angle of the blade", unit="rad")
    current: Scalar = output("current of the motor", unit="A")

    def connections(self):
        yield connect(self.supply.p, self.motor.pin_ap)
        yield connect(self.supply.n, self.motor.pin_an)
        yield connect(self.supply.n, self.ground.p)
        yield connect(self.motor.flange, self.worm.flange_a)
        yield connect(self.worm.flange_b, self.rod.crank)
        yield connect(self.rod.rocker, self.blade.flange_a)
        yield connect(self.blade.flange_b, self.rubber.flange_a)

    def equations(self):
        steps = (0, time < 0.2), (self.slow, time < 2.5), (self.fast, time < 4.5)
        yield self.supply.v == piecewise(*steps, 0)
        yield self.angle == self.blade.phi
        yield self.current == self.motor.ia
