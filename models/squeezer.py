"""Andrews' squeezing mechanism: seven planar bodies, three loops through one point, one degree of freedom."""

from __future__ import annotations

from typing import Any

from acausal import Model, chain, connect, fixed, guess, output
from components import BodyShape, Fixed, FixedTranslation, Revolute, Spring, World
from components.rotational import Torque


def body(m: float, I: float, r: tuple[float, float], r_CM: tuple[float, float]) -> BodyShape:
    """Return a planar body from its mass, moment of inertia, second pin and centre of mass."""
    return BodyShape(m=m, I=((0, 0, 0), (0, 0, 0), (0, 0, I)), r=(*r, 0), r_CM=(*r_CM, 0))


def angle(name: str) -> Any:
    """Declare an output for a joint angle."""
    return output(f"angle {name}", unit="rad")


class Squeezer(Model):
    """Crank K1 and link K2 drive the pin E, which K3, K4 with K5, and K6 with K7 support; a spring loads K3; from rest."""

    stop_time = 0.03
    world = World(gravity=None)
    A, B, C = Fixed(r=(-0.06934, -0.00227, 0)), Fixed(r=(-0.03635, 0.03273, 0)), Fixed(r=(0.014, 0.072, 0))
    j1 = Revolute(use_axis_flange=True, phi=fixed(-0.0617138900142764), w=fixed(0))
    j2, j3 = Revolute(phi=guess(0)), Revolute(phi=guess(0.455279819163070))
    j4, j5 = Revolute(phi=guess(0.222668390165886)), Revolute(phi=guess(0.487364979543843))
    j6, j7 = Revolute(phi=guess(-0.222668390165886)), Revolute(phi=guess(1.23054744454982))
    e3, e4, e6 = Revolute(), Revolute(), Revolute()
    K1, K2 = body(0.04325, 2.194e-6, (7e-3, 0), (9.2e-4, 0)), body(0.00365, 4.410e-7, (-28e-3, 0), (-0.0115, 0))
    K3, D = body(0.02373, 5.255e-6, (0, -35e-3), (0.01043, -0.01874)), FixedTranslation(r=(0.02, -18e-3, 0))
    K4, K5 = body(0.00706, 5.667e-7, (0, -0.02), (0, -0.00579)), body(0.07050, 1.169e-5, (0.04, 0), (0.02308, 9.16e-3))
    K6, K7 = body(0.00706, 5.667e-7, (0.02, 0), (0.00579, 0)), body(0.05498, 1.912e-5, (0, -0.04), (0.01228, -4.49e-3))
    motor, spring = Torque(tau=0.033), Spring(c=4530, s_unstretched=0.07785)
    beta, theta, gamma, phi = angle("of K1"), angle("of K2 from K1"), angle("of K3"), angle("of K4 from K5")
    delta, omega, epsilon = angle("of K5"), angle("of K6 from K7"), angle("of K7")

    def connections(self):
        yield connect(self.motor.flange, self.j1.axis)
        yield chain(self.world, self.j1, self.K1, self.j2, self.K2)
        yield chain(self.B, self.j3, self.K3, self.e3, self.K2.frame_b)
        yield chain(self.A, self.j5, self.K5, self.j4, self.K4, self.e4, self.K2.frame_b)
        yield chain(self.A, self.j7, self.K7, self.j6, self.K6, self.e6, self.K2.frame_b)
        yield chain(self.C, self.spring, self.D.frame_b)
        yield connect(self.D.frame_a, self.K3.frame_a)

    def equations(self):
        outputs = (self.beta, self.theta, self.gamma, self.phi, self.delta, self.omega, self.epsilon)
        for value, joint in zip(outputs, (self.j1, self.j2, self.j3, self.j4, self.j5, self.j6, self.j7), strict=True):
            yield value == joint.phi


if __name__ == "__main__":
    import acausal as ac

    ac.simulate(Squeezer(), stop_time=Squeezer.stop_time).plot("gamma", "phi", "delta", "epsilon", path="squeezer.png")
