"""Turning blade: tapered and pre-twisted, under gravity and thrust, on a hub of constant speed."""

from math import pi

import acausal as ac
from acausal import Model, Scalar, chain, connect, cos, output, parameter, part, sin, structural, time
from components import FlexibleBeam, Load, Rectangle, Revolute, World
from components.rotational import Position

ROOT, TIP, THICKNESS, TWIST = 0.10, 0.05, 0.14, pi / 6  # chords in m, thickness over chord, twist in rad


def section(s):
    """Chord in the plane of rotation at the tip, turned out of it by the twist at the root."""
    chord = ROOT + (TIP - ROOT) * s
    return Rectangle(width=chord, height=THICKNESS * chord, angle=TWIST * (1 - s))


class Blade(Model):
    """Blade of 1.5 m in a vertical plane of rotation, held by centrifugal forces."""

    stop_time = 2.0
    speed: Scalar = parameter("speed of the hub", unit="rad/s", default=10.0)
    elements: int = structural("finite elements", default=8, minimum=1)
    thrust: Scalar = parameter("force of the wind per length, along the axis of the hub", unit="N/m", default=30.0)
    world, hub, drive = World(), Revolute(use_axis_flange=True), Position(phi_ref=speed * time, exact=True)
    flap: Scalar = output("displacement of the tip along the axis of the hub", unit="m")
    lag: Scalar = output("displacement of the tip in the plane of rotation, along the motion", unit="m")
    twist: Scalar = output("rotation of the tip about the axis of the blade", unit="rad")

    @part
    def beam(self):
        return FlexibleBeam(
            length=1.5,
            section=section,
            E=30e9,
            G=4e9,
            rho=1800.0,
            elements=self.elements,
            geometric_stiffness=True,
            rotary_inertia=True,
            axial="none",
            beta=1e-4,
            initial="static",
            distributed=Load((0, 0, self.thrust)),
        )

    def connections(self):
        yield from (chain(self.world, self.hub, self.beam), connect(self.drive.flange, self.hub.axis))

    def equations(self):
        tip, (c, s) = self.beam.frame_b.r_0, (cos(self.hub.phi), sin(self.hub.phi))
        yield from (self.flap == tip[2], self.lag == c * tip[1] - s * tip[0])
        yield self.twist == self.beam.node_deflection[-1, 3]


if __name__ == "__main__":
    ac.simulate(Blade(), stop_time=Blade.stop_time).plot("flap", "lag", "twist", path="blade.png")
