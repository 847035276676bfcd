"""Simple pendulum: point mass on a massless bar, released from rest in the horizontal position."""

from __future__ import annotations

from acausal import Model, Scalar, chain, fixed, output
from components import Body, FixedTranslation, Revolute, World


class SimplePendulum(Model):
    """Point mass of 1 kg on a bar of 1 m, hinged at the origin."""

    stop_time = 10.0
    world = World(g=9.81)
    hinge = Revolute(phi=fixed(0), w=fixed(0))
    bar = FixedTranslation(r=(1, 0, 0))
    mass = Body(m=1)
    x: Scalar = output("horizontal position of the mass, in the world", unit="m")
    y: Scalar = output("vertical position of the mass, in the world", unit="m")

    def connections(self):
        yield chain(self.world, self.hinge, self.bar, self.mass)

    def equations(self):
        yield self.x == self.mass.r_0[0]
        yield self.y == self.mass.r_0[1]


if __name__ == "__main__":
    import acausal as ac

    ac.simulate(SimplePendulum(), stop_time=SimplePendulum.stop_time).plot("x", "y", path="simple-pendulum.png")
