"""Names that a part does not have, where it has one that contains them."""

import acausal as ac
from acausal import Model, chain
from components import FlexibleBeam, Revolute, SubstructuredBeam, World
from tests.errors.broken.models import SECTION

BEAM = {"length": 1, "E": 1e9, **SECTION}


class Cantilever(Model):
    world, beam = World(), SubstructuredBeam(**BEAM)

    def connections(self):
        yield chain(self.world, self.beam)


def elements_of_a_substructured_beam(repaired):
    SubstructuredBeam(**BEAM, **({"elements_per_volume": 3} if repaired else {"elements": 3}))


def stiffness_of_a_beam(repaired):
    FlexibleBeam(**BEAM, **({"geometric_stiffness": True} if repaired else {"stiffness": True}))


def flange_of_a_joint(repaired):
    Revolute(**({"use_axis_flange": True} if repaired else {"use_flange": True}))


def elements_by_path(repaired):
    ac.compile(Cantilever(), {"beam.elements_per_volume" if repaired else "beam.elements": 3})


def elements_in_an_equation(repaired):
    class M(Cantilever):
        def equations(self):
            _ = self.beam.elements_per_volume if repaired else self.beam.elements
            yield from ()

    ac.compile(M())
