"""RectifierDrive: a six-pulse rectifier that feeds a DC machine with a load."""

from __future__ import annotations

import math

from acausal import Model, Scalar, connect, fixed, output
from components import electrical as el
from components import rotational


class RectifierDrive(Model):
    """Three phases of 50 Hz, six diodes, a choke that keeps the current flowing, and a machine whose load increases."""

    stop_time = 0.5
    a = el.SineVoltage(V=60, f=50)
    b = el.SineVoltage(V=60, f=50, phase=-2 * math.pi / 3)
    c = el.SineVoltage(V=60, f=50, phase=2 * math.pi / 3)
    a_up, b_up, c_up, a_down, b_down, c_down = (el.IdealDiode(Ron=1e-3, Goff=1e-5, Vknee=0.7) for _ in range(6))
    choke = el.Inductor(L=5e-3, i=fixed(50))
    machine = el.DCPermanentMagnet(phi_mechanical=fixed(0), w_mechanical=fixed(145), ia=fixed(50))
    ground = el.Ground()
    load = rotational.QuadraticSpeedDependentTorque(tau_nominal=-30, w_nominal=150)
    brake = rotational.TorqueStep(step_torque=-20, offset_torque=0, start_time=0.2)
    voltage: Scalar = output("rectified voltage", unit="V")
    current: Scalar = output("current of the machine", unit="A")
    w: Scalar = output("speed of the machine", unit="rad/s")

    def connections(self):
        for source, up, down in (
            (self.a, self.a_up, self.a_down),
            (self.b, self.b_up, self.b_down),
            (self.c, self.c_up, self.c_down),
        ):
            yield connect(source.n, self.ground.p)
            yield connect(source.p, up.p)
            yield connect(source.p, down.n)
            yield connect(up.n, self.choke.p)
            yield connect(down.p, self.machine.pin_an)
        yield connect(self.choke.n, self.machine.pin_ap)
        yield connect(self.machine.flange, self.load.flange)
        yield connect(self.machine.flange, self.brake.flange)

    def equations(self):
        yield self.voltage == self.choke.p.v - self.machine.pin_an.v
        yield self.current == self.machine.ia
        yield self.w == self.machine.w_mechanical
