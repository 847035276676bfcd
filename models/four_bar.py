"""Planar four-bar: four revolute joints about z and a damper on the crank (Modelica's Loops.PlanarFourbar)."""

from __future__ import annotations

from acausal import Model, Scalar, chain, connect, fixed, output
from components import BodyBox, Revolute, World
from components.rotational import Damper


class FourBar(Model):
    """Crank b1, coupler b2 and rocker b4 on the fixed link b3, released from rest."""

    stop_time = 5.0
    world = World(g=9.80665)
    j1 = Revolute(use_axis_flange=True, phi=fixed(0), w=fixed(0))
    j2 = Revolute()
    j3 = Revolute()
    j4 = Revolute()
    b1 = BodyBox(r=(0.4, 0, 0), width=0.05)
    b2 = BodyBox(r=(0.1, 1.1, 0), width=0.05)
    b3 = BodyBox(r=(-0.15, 1, 0), width=0.05)
    b4 = BodyBox(r=(0.65, 0.1, 0), width=0.05)
    damper = Damper(d=0.1)
    j1_phi: Scalar = output("angle of the crank", unit="rad")
    j1_w: Scalar = output("angular velocity of the crank", unit="rad/s")

    def connections(self):
        yield chain(self.world, self.j1, self.b1, self.j2, self.b2, self.j4, self.b4.frame_b)
        yield chain(self.world, self.b3, self.j3, self.b4)
        yield connect(self.j1.support, self.damper.flange_a)
        yield connect(self.damper.flange_b, self.j1.axis)

    def equations(self):
        yield self.j1_phi == self.j1.phi
        yield self.j1_w == self.j1.w


if __name__ == "__main__":
    import acausal as ac

    ac.simulate(FourBar(), stop_time=FourBar.stop_time).plot("j1_phi", "j1_w", path="four-bar.png")
