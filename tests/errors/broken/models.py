"""Models that the broken ones extend."""

from acausal import Model, Scalar, Vector3, chain, der, fixed, input, parameter, variable
from components import Body, FixedTranslation, Revolute, World, rotational

SECTION = {"rho": 1000, "A": 1e-4, "J": 1e-9}


class Pendulum(Model):
    world = World(g=9.81)
    hinge = Revolute(phi=fixed(0.1), w=fixed(0))
    bar = FixedTranslation(r=(1, 0, 0))
    mass = Body(m=1)

    def connections(self):
        yield chain(self.world, self.hinge, self.bar, self.mass)


class Decay(Model):
    """x and v, and one more equation for z."""

    x: Scalar = variable("x", start=1, fixed=True)
    v: Vector3 = variable("v")
    p: Scalar = parameter("p", default=2.0)

    def equations(self):
        yield der(self.x) == -self.x
        yield self.v == (0, 0, 0)
        yield from self.more()

    def more(self):
        yield from ()


class Rotor(Model):
    tau: Scalar = input("torque", unit="N.m")
    drive = rotational.Torque()
    rotor = rotational.Inertia(J=1, phi=fixed(0), w=fixed(0))

    def connections(self):
        yield chain(self.drive, self.rotor)

    def equations(self):
        yield self.drive.tau == self.law()

    def law(self):
        return self.tau
