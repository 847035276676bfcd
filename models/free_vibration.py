"""Free vibration: cantilever released from its static deflection under a tip force (beam paper, section 5.1)."""

import acausal as ac
from acausal import Model, Scalar, chain, connect, initial, output, parameter, part, structural
from components import FlexibleBeam, SubstructuredBeam, World, WorldForce

SECTION: dict = {"length": 2.0, "E": 72e9, "A": 1e-4, "J": 1e-8 / 12, "rho": 2700.0}
CHAIN = {"formulation": "substructured"}


class FreeVibration(Model):
    """Aluminium cantilever, 2 m long, with square section, released with the tip deflection `tip`."""

    stop_time = 1.0
    method = "resolve"  # the vibrations are of interest and must not be damped numerically
    formulations = ac.with_and_without(
        ac.Formulation("one frame", {"formulation": "fem"}, {"elements": (2, 4, 8)}),
        ac.Formulation("volumes", {**CHAIN, "elements_per_volume": 1}, {"volumes": (2, 4, 8)}, exact=True),
        ac.Formulation("volumes of 2", {**CHAIN, "elements_per_volume": 2}, {"volumes": (1, 2, 4)}, exact=True),
        stiffened="beam.geometric_stiffness",
    )
    formulation: str = structural("formulation of the beam", default="fem", choices=("fem", "substructured"))
    elements: int = structural("elements of the finite-element beam", default=10, minimum=1)
    volumes: int = structural("volumes of the substructured beam", default=5, minimum=1)
    elements_per_volume: int = structural("finite elements of a volume", default=2, minimum=1)
    tip: Scalar = parameter("initial tip deflection", unit="m", default=0.01)
    world = World(gravity=None)
    load = WorldForce()
    tip_deflection: Scalar = output("transverse displacement of the tip", unit="m")

    @part
    def beam(self):
        """The beam, in one floating frame or substructured."""
        if self.formulation == "fem":
            return FlexibleBeam(elements=self.elements, initial="static", **SECTION)
        return SubstructuredBeam(
            volumes=self.volumes, elements_per_volume=self.elements_per_volume, initial="static", **SECTION
        )

    def connections(self):
        yield chain(self.world, self.beam)
        yield connect(self.load.frame_b, self.beam.frame_b)

    def equations(self):
        beam = self.beam
        pull = 3 * beam.E * beam.J / beam.length**3 * self.tip
        yield self.load.force[0] == 0
        yield self.load.force[1] == initial * pull
        yield self.load.force[2] == 0
        yield self.tip_deflection == beam.frame_b.r_0[1]


if __name__ == "__main__":
    ac.simulate(FreeVibration(), stop_time=FreeVibration.stop_time).plot("tip_deflection", path="free-vibration.png")
