"""Motor accelerating a load through the gears of a planetary gearbox."""

from __future__ import annotations

from acausal import Model, Scalar, chain, fixed, output, time_table
from components.rotational import Inertia, QuadraticSpeedDependentTorque, Torque
from models.vehicle.planetary_gearbox import PlanetaryGearbox

SHIFT = 0.3  # duration of a shift in s


class Shifting(Model):
    """First gear from 0 s, second from 3 s, third from 6 s; each shift opens one clutch or brake and closes another."""

    stop_time = 9.0
    motor, drive = Inertia(J=0.2, phi=fixed(0), w=fixed(50)), Torque(tau=100)
    gearbox = PlanetaryGearbox(
        clutch_1=time_table([(0, 1), (6, 1), (6 + SHIFT, 0), (9, 0)]),
        clutch_2=time_table([(0, 0), (3, 0), (3 + SHIFT, 1), (9, 1)]),
        brake=time_table([(0, 1), (3, 1), (3 + SHIFT, 0), (6, 0), (6 + SHIFT, 1), (9, 1)]),
    )
    load = Inertia(J=4, phi=fixed(0), w=fixed(30))
    drag = QuadraticSpeedDependentTorque(tau_nominal=-100, w_nominal=200, torque_direction=False)
    w_motor: Scalar = output("speed of the motor", unit="rad/s")
    w: Scalar = output("speed of the load", unit="rad/s")

    def connections(self):
        yield chain(self.drive.flange, self.motor, self.gearbox, self.load, self.drag.flange)

    def equations(self):
        yield self.w_motor == self.motor.w
        yield self.w == self.load.w


if __name__ == "__main__":
    import acausal as ac

    ac.simulate(Shifting(), stop_time=Shifting.stop_time).plot("w_motor", "w", path="shifting.png")
