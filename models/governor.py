"""Flyball governor: two rods with balls on a rotating shaft, coupled to a slider by stiff spring-dampers."""

from __future__ import annotations

from math import pi
from typing import Any

from acausal import Model, Scalar, chain, connect, fixed, output
from components import Body, BodyBox, FixedTranslation, Prismatic, Revolute, SpringDamperParallel, World

ROD: dict[str, Any] = {"width": 0.01, "density": 3000}
TIE: dict[str, Any] = {"c": 8e5, "d": 4e4, "s_unstretched": 0.5}
CUBE = 3000 * 0.1**3


class Governor(Model):
    """Freely rotating shaft along z with a sliding cube; the rods are initially 30 degrees below the horizontal."""

    stop_time = 10.0
    world = World(g=9.81, n=(0, 0, -1))
    bearing = Revolute(phi=fixed(0), w=fixed(2 * pi))
    shaft = BodyBox(r=(0, 0, 1), **ROD)
    guide = Prismatic(n=(0, 0, 1), s=fixed(0.5), v=fixed(0))
    slider = Body(m=CUBE, I=((CUBE * 0.1**2 / 6, 0, 0), (0, CUBE * 0.1**2 / 6, 0), (0, 0, CUBE * 0.1**2 / 6)))
    top1, eye1 = FixedTranslation(r=(0.05, 0, 0)), FixedTranslation(r=(0.05, 0, 0))
    top2, eye2 = FixedTranslation(r=(-0.05, 0, 0)), FixedTranslation(r=(-0.05, 0, 0))
    hinge1 = Revolute(n=(0, 1, 0), phi=fixed(pi / 6), w=fixed(0))
    hinge2 = Revolute(n=(0, -1, 0), phi=fixed(pi / 6), w=fixed(0))
    rod1, half1 = BodyBox(r=(1, 0, 0), **ROD), FixedTranslation(r=(0.5, 0, 0))
    rod2, half2 = BodyBox(r=(-1, 0, 0), **ROD), FixedTranslation(r=(-0.5, 0, 0))
    ball1, ball2 = Body(m=5), Body(m=5)
    tie1, tie2 = SpringDamperParallel(**TIE), SpringDamperParallel(**TIE)
    s: Scalar = output("height of the slider", unit="m")
    rod_angle: Scalar = output("angle of the rods below the horizontal", unit="rad")
    shaft_angle: Scalar = output("angle of the shaft", unit="rad")

    def connections(self):
        yield chain(self.world, self.bearing, self.shaft)
        yield chain(self.bearing, self.guide, self.slider)
        yield chain(self.shaft, self.top1, self.hinge1, self.rod1, self.ball1)
        yield chain(self.shaft, self.top2, self.hinge2, self.rod2, self.ball2)
        yield chain(self.guide, self.eye1, self.tie1, self.half1.frame_b)
        yield chain(self.guide, self.eye2, self.tie2, self.half2.frame_b)
        yield connect(self.half1.frame_a, self.rod1.frame_a)
        yield connect(self.half2.frame_a, self.rod2.frame_a)

    def equations(self):
        yield self.s == self.guide.s
        yield self.rod_angle == self.hinge1.phi
        yield self.shaft_angle == self.bearing.phi


if __name__ == "__main__":
    import acausal as ac

    ac.simulate(Governor(), stop_time=Governor.stop_time).plot("s", "rod_angle", path="governor.png")
