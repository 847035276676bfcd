"""Flexible pendulum: rubber-like beam under gravity (beam paper, section 5.2)."""

import acausal as ac
from acausal import Model, Scalar, chain, cos, fixed, output, parameter, part, sin, structural
from components import BodyRod, FlexibleBeam, Revolute, SubstructuredBeam, World

LENGTH, E, A, J, RHO = 0.4, 1e9, 18e-4, 1.215e-8, 5540.0
# The release excites vibrations at several kHz; the error test resolves those near pi^2 sqrt(EJ / rho A L^4) = 68 rad/s.
SECTION: dict = {"length": LENGTH, "E": E, "A": A, "J": J, "rho": RHO, "nominal_rate": 68.0}
CHAIN = {"formulation": "substructured"}


class FlexiblePendulum(Model):
    """Beam on a hinge at the origin, released from rest in the horizontal position."""

    stop_time = 1.0
    formulations = ac.with_and_without(
        ac.Formulation("one frame", {"formulation": "fem"}, {"elements": (4, 8, 16)}),
        ac.Formulation("volumes", {**CHAIN, "elements_per_volume": 1}, {"volumes": (4, 8, 16)}, exact=True),
        ac.Formulation("volumes of 2", {**CHAIN, "elements_per_volume": 2}, {"volumes": (2, 4, 8)}, exact=True),
        stiffened="beam.geometric_stiffness",
    )
    formulations += (ac.Formulation("rigid", {"formulation": "rigid"}),)
    formulation: str = structural("formulation of the beam", default="fem", choices=("fem", "substructured", "rigid"))
    elements: int = structural("elements of the finite-element beam", default=10, minimum=1)
    volumes: int = structural("volumes of the substructured beam", default=5, minimum=1)
    elements_per_volume: int = structural("finite elements of a volume", default=2, minimum=1)
    reference: str = structural("reference frame", default="tangent", choices=("tangent", "pinned"))
    gravity: Scalar = parameter("acceleration of gravity", unit="m/s2", default=9.81)
    world, hinge = World(g=gravity), Revolute(phi=fixed(0), w=fixed(0))
    swing_angle: Scalar = output("angle of the tangent at the hinge from the horizontal", unit="rad")
    tip_deflection: Scalar = output("transverse displacement of the tip from that tangent", unit="m")
    tip_x: Scalar = output("horizontal position of the tip, in the world", unit="m")
    tip_y: Scalar = output("vertical position of the tip, in the world", unit="m")
    mid_deflection: Scalar = output("transverse distance of the midpoint from the chord", unit="m")

    @part
    def beam(self):
        if self.formulation == "rigid":
            return BodyRod(r=(LENGTH, 0, 0), m=RHO * A * LENGTH)
        if self.formulation == "fem":
            return FlexibleBeam(elements=self.elements, reference=self.reference, **SECTION)
        n = self.elements_per_volume
        return SubstructuredBeam(volumes=self.volumes, elements_per_volume=n, reference=self.reference, **SECTION)

    def connections(self):
        yield chain(self.world, self.hinge, self.beam)

    def equations(self):
        yield self.swing_angle == self.hinge.phi
        c, s, tip = cos(self.swing_angle), sin(self.swing_angle), self.beam.frame_b.r_0
        yield self.tip_deflection == c * tip[1] - s * tip[0]
        yield from (self.tip_x == tip[0], self.tip_y == tip[1])
        yield self.mid_deflection == (0 * tip[0] if self.formulation == "rigid" else self.beam.middle_deflection)


if __name__ == "__main__":
    ac.simulate(FlexiblePendulum(), stop_time=1.0).plot("swing_angle", "tip_deflection", path="pendulum.png")
