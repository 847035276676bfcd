"""Machines of the tests of beams in space."""

from __future__ import annotations

from typing import Any

import numpy as np

import acausal as ac
from acausal import Model, Scalar, Vector3, chain, connect, input, part, parts, structural
from components import FixedRotation, FlexibleBeam, SubstructuredBeam, World, WorldForce


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
