"""Machines of the tests of beams in space."""

from __future__ import annotations

from typing import Any

import numpy as np

import acausal as ac
from acausal import Model, Scalar, Vector3, chain, connect, input, part, parts, structural
from components import FixedRotation, FlexibleBeam, SubstructuredBeam, World, WorldForce
from tests.reference.rod import loaded_rod

BEND = {"E": 1e7, "G": 5e6, "rho": 1e-3, "A": 1.0, "J": 1 / 12, "J_t": 0.1406}


def beam_of(**kind: Any) -> FlexibleBeam | SubstructuredBeam:
    """Return a chain if its volumes are given, one frame otherwise."""
    return SubstructuredBeam(**kind) if "volumes" in kind else FlexibleBeam(**kind)


class Cantilever(Model):
    """A beam that is clamped at its root, with a force at its tip."""

    kind: dict = structural("values of the beam", default=None)
    force: Vector3 = input("force at the tip, resolved in the world", unit="N")
    world = World(gravity=None)
    load = WorldForce(force=force)

    @part
    def beam(self):
        return beam_of(**self.kind)

    def connections(self):
        yield chain(self.world, self.beam)
        yield connect(self.load.frame_b, self.beam.frame_b)


class Arc(Model):
    """Cantilever of straight chords on an arc of 45 degrees and radius 100, bent by a force across its plane."""

    count: int = structural("chords", default=8)
    kind: dict = structural("values of the chords", default=None)
    P: Scalar = ac.parameter("force", unit="N", default=600.0)
    world, load = World(gravity=None), WorldForce(force=(0, 0, P))

    @parts
    def bar(self):
        length = 200 * np.sin(np.pi / 8 / self.count)
        return [FlexibleBeam(length=length, initial="static", **self.kind) for _ in range(self.count)]

    @parts
    def kink(self):
        turns = [np.pi / 8 / self.count, *[np.pi / 4 / self.count] * (self.count - 1)]
        return [FixedRotation(n=(0, 0, 1), angle=angle) for angle in turns]

    def connections(self):
        yield chain(self.world, *(p for pair in zip(self.kink, self.bar, strict=True) for p in pair), self.load.frame_b)


def bent_tip() -> np.ndarray:
    """Tip of the exact rod on the arc, under 600 N."""
    E, J, GJ = BEND["E"], BEND["J"], BEND["G"] * BEND["J_t"]
    return loaded_rod(25 * np.pi, np.array([0, 0, 600.0]), (GJ, E * J, E * J), E * BEND["A"], curvature=0.01)[0]


def bend_error(count: int, **kind: Any) -> float:
    """Distance of the tip from that of the exact rod, under 600 N."""
    result = ac.simulate(Arc(count=count, kind=BEND | kind), stop_time=1e-6, intervals=1)
    return float(np.linalg.norm(result["load.frame_b.r_0"][0] - bent_tip()))
