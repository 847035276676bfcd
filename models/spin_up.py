"""Spin-up manoeuvre: flexible beam on a hub with a prescribed angle (beam paper, section 5.4)."""

from math import pi

import acausal as ac
from acausal import Model, Scalar, chain, connect, cos, output, parameter, part, piecewise, sin, structural, time
from components import FlexibleBeam, Revolute, SubstructuredBeam, World
from components.rotational import Position

FEM, CHAIN = {"formulation": "fem"}, {"formulation": "substructured"}


class SpinUp(Model):
    """Beam on a hub that accelerates to the speed omega within the time ramp."""

    stop_time = 20.0
    formulations = ac.with_and_without(
        ac.Formulation("one frame", FEM, {"volumes": (5, 10)}),
        ac.Formulation("volumes", {**CHAIN, "elements_per_volume": 1}, {"volumes": (5, 10, 20, 40)}, exact=True),
        ac.Formulation("volumes of 2", {**CHAIN, "elements_per_volume": 2}, {"volumes": (5, 10, 20)}, exact=True),
        stiffened="beam.geometric_stiffness",
    )
    formulation: str = structural("formulation of the beam", default="substructured", choices=("substructured", "fem"))
    volumes: int = structural("volumes of the substructured beam", default=5, minimum=1)
    elements_per_volume: int = structural("finite elements of a volume", default=1, minimum=1)
    omega: Scalar = parameter("final speed of the hub", unit="rad/s", default=4)
    ramp: Scalar = parameter("acceleration time", unit="s", default=15, positive=True)
    length: Scalar = parameter("length of the beam", unit="m", default=8, positive=True)
    E: Scalar = parameter("modulus of elasticity", unit="Pa", default=6.895e10, positive=True)
    A: Scalar = parameter("area of the section", unit="m2", default=7.299e-5, positive=True)
    J: Scalar = parameter("second moment of area", unit="m4", default=8.214e-9, positive=True)
    rho: Scalar = parameter("density", unit="kg/m3", default=2767, positive=True)
    world, hub, drive = World(gravity=None), Revolute(use_axis_flange=True), Position()
    angle: Scalar = output("prescribed angle", unit="rad")
    tip_deflection: Scalar = output("transverse position of the tip in the rotating frame", unit="m")
    tip_extension: Scalar = output("longitudinal displacement of the tip in the rotating frame", unit="m")

    @part
    def beam(self):
        section: dict = {"length": self.length, "E": self.E, "A": self.A, "J": self.J, "rho": self.rho}
        if self.formulation == "fem":
            return FlexibleBeam(elements=self.volumes * self.elements_per_volume, **section)
        return SubstructuredBeam(volumes=self.volumes, elements_per_volume=self.elements_per_volume, **section)

    def connections(self):
        yield from (chain(self.world, self.hub, self.beam), connect(self.drive.flange, self.hub.axis))

    def equations(self):
        T, x = self.ramp, 2 * pi * time / self.ramp
        rise = self.omega / T * (time**2 / 2 + (T / (2 * pi)) ** 2 * (cos(x) - 1))
        yield self.angle == piecewise((rise, time < T), self.omega * (time - T / 2), smooth=True)
        yield self.drive.phi_ref == self.angle
        c, s, r = cos(self.angle), sin(self.angle), self.beam.frame_b.r_0
        yield self.tip_deflection == c * r[1] - s * r[0]
        yield self.tip_extension == c * r[0] + s * r[1] - self.length


if __name__ == "__main__":
    ac.simulate(SpinUp(), stop_time=SpinUp.stop_time).plot("tip_deflection", "tip_extension", path="spin-up.png")
