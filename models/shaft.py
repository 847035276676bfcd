"""Shaft: an unbalanced rotor between two bearings, run up through its resonance."""

import acausal as ac
from acausal import Model, Scalar, chain, connect, fixed, output, parameter, part, structural, time
from components import Body, Circle, FlexibleBeam, Prismatic, Revolute, Spherical, Universal, World, WorldForce
from components.rotational import Speed


class Shaft(Model):
    """Steel shaft of 0.8 m along x with a disc of 6 kg in its middle, whose mass is off the axis by 0.2 mm.

    The first bearing turns the shaft through a joint; the second one lets it slide and tilt.
    """

    stop_time = 10.0
    elements: int = structural("finite elements, an even number", default=8, minimum=2)
    stop_speed: Scalar = parameter("speed at the end of the run", unit="rad/s", default=110.0)
    eccentricity: Scalar = parameter("distance of the centre of mass of the disc from the axis", unit="m", default=2e-4)
    drag: Scalar = parameter("damping of the disc by the air and its seals", unit="N.s/m", default=30.0)
    world, motor = World(), Revolute(n=(1, 0, 0), use_axis_flange=True, phi=fixed(0))
    drive, joint, slide, ball = (
        Speed(w_ref=stop_speed * time / 10),
        Universal(n_a=(0, 1, 0), n_b=(0, 0, 1)),
        Prismatic(),
        Spherical(),
    )
    disc = Body(m=6.0, r_CM=(0, eccentricity, 0), I=((0.03, 0, 0), (0, 0.015, 0), (0, 0, 0.015)))
    seal = WorldForce()
    whirl_y: Scalar = output("displacement of the disc upwards", unit="m")
    whirl_z: Scalar = output("displacement of the disc to the side", unit="m")
    speed: Scalar = output("speed of the shaft", unit="rad/s")

    @part
    def beam(self):
        return FlexibleBeam(
            length=0.8,
            section=Circle(0.013),
            E=2.1e11,
            rho=7850.0,
            elements=self.elements,
            frames_at=(0.5,),
            axial="none",
            initial="static",
        )

    def connections(self):
        yield chain(self.world, self.motor, self.joint, self.beam, self.ball, self.slide.frame_b)
        yield connect(self.slide.frame_a, self.world.frame_b)
        yield from (connect(self.drive.flange, self.motor.axis), connect(self.beam.frames_inner[0], self.disc.frame_a))
        yield connect(self.seal.frame_b, self.disc.frame_a)

    def equations(self):
        place = self.disc.frame_a.r_0
        yield self.seal.force == -self.drag * ac.der(place)
        yield from (self.whirl_y == place[1], self.whirl_z == place[2], self.speed == self.motor.w)


if __name__ == "__main__":
    ac.simulate(Shaft(), stop_time=Shaft.stop_time).plot("whirl_y", "whirl_z", path="shaft.png")
