"""Shaft: an unbalanced rotor on elastic bearings, run up through its resonance."""

import acausal as ac
from acausal import Model, Scalar, chain, connect, fixed, output, parameter, part, structural, time
from components import Body, Bushing, Circle, FlexibleBeam, FreeMotion, World
from components.rotational import Speed

STEEL: dict = {"section": Circle(0.02), "E": 2.1e11, "rho": 7850.0}


class Shaft(Model):
    """Steel shaft of 0.8 m along x with a disc of 6 kg in its middle, whose mass is off the axis by 0.2 mm."""

    stop_time = 10.0
    elements: int = structural("finite elements, an even number", default=8, minimum=2)
    stop_speed: Scalar = parameter("speed at the end of the run", unit="rad/s", default=250.0)
    eccentricity: Scalar = parameter("distance of the centre of mass of the disc from the axis", unit="m", default=2e-4)
    world = World()
    disc = Body(m=6.0, r_CM=(0, eccentricity, 0), I=((0.03, 0, 0), (0, 0.015, 0), (0, 0, 0.015)))
    whirl_y: Scalar = output("displacement of the disc upwards", unit="m")
    whirl_z: Scalar = output("displacement of the disc to the side", unit="m")
    speed: Scalar = output("speed of the shaft", unit="rad/s")
