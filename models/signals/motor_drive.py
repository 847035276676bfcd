"""MotorDrive: a motor with gear and fan, controlled in speed under a current limit."""

from __future__ import annotations

from acausal import Model, Scalar, clip, connect, fixed, output, parameter, quantity, step
from components import blocks, rotational
from components import electrical as el


class MotorDrive(Model):
    """Motor with gear and fan: a speed controller demands a limited current, which a converter of limited voltage drives."""

    stop_time = 4.0
    gain: Scalar = parameter("gain of the current controller", unit="Ohm", default=2)
    v_max: Scalar = parameter("limit of the voltage", unit="V", default=110)
    motor = el.DCPermanentMagnet(J_r=0.15, ia=fixed(0), phi_mechanical=fixed(0), w_mechanical=fixed(0))
    converter, ground = el.SignalVoltage(), el.Ground()
    gear = rotational.IdealGear(ratio=2)
    fan = rotational.Inertia(J=2)
    air = rotational.QuadraticSpeedDependentTorque(tau_nominal=-60, w_nominal=70, torque_direction=False)
    speed = blocks.LimPID(controller_type="PI", k=8, Ti=0.5, y_max=100, u_s=step(60, start_time=0.2))
    current: Scalar = output("current of the motor", unit="A")
    w: Scalar = output("speed of the fan", unit="rad/s")

    def connections(self):
        yield connect(self.converter.p, self.motor.pin_ap)
        yield connect(self.converter.n, self.motor.pin_an)
        yield connect(self.converter.n, self.ground.p)
        yield connect(self.motor.flange, self.gear.flange_a)
        yield connect(self.gear.flange_b, self.fan.flange_a)
        yield connect(self.fan.flange_b, self.air.flange)

    def equations(self):
        demand = quantity(1, "A") * self.speed.y
        yield self.speed.u_m == self.fan.w
        induced = self.motor.coefficient() * self.motor.w_mechanical
        wanted = self.gain * (demand - self.motor.ia) + induced
        yield self.converter.v == clip(wanted, -self.v_max, self.v_max)
        yield self.current == self.motor.ia
        yield self.w == self.fan.w
