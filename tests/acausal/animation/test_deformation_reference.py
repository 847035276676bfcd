"""Exaggerated deformations detach nothing: a beam with a shape at its far end deforms from its chord."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

import acausal as ac
from acausal import Model, chain, connect, fixed
from acausal.animation import geometry as g
from acausal.animation.collect import PartShape
from acausal.animation.deformation_reference import with_references
from acausal.animation.document import document
from acausal.result.animated import run_of
from components import Body, FlexibleBeam, Revolute, SubstructuredBeam, World, WorldForce

SECTION: dict[str, Any] = {"length": 0.4, "E": 1e9, "rho": 5540, "A": 18e-4, "J": 1.215e-8, "check_range": False}


class Free(Model):
    world, beam = World(), FlexibleBeam(**SECTION)

    def connections(self):
        yield chain(self.world, self.beam)


class Reversed(Model):
    world, beam = World(), FlexibleBeam(**SECTION)

    def connections(self):
        yield connect(self.world.frame_b, self.beam.frame_b)


class Pushed(Free):
    push = WorldForce(force=(0, 1, 0))

    def connections(self):
        yield chain(self.world, self.beam, self.push)


class Loaded(Model):
    world, beam, tip = World(), SubstructuredBeam(volumes=2, **SECTION), Body(m=0.1)

    def connections(self):
        yield chain(self.world, self.beam, self.tip)


class Double(Model):
    world, beam, pin, second = (
        World(),
        FlexibleBeam(**SECTION),
        Revolute(phi=fixed(0), w=fixed(0)),
        FlexibleBeam(**SECTION),
    )

    def connections(self):
        yield chain(self.world, self.beam, self.pin, self.second)


class Welded(Model):
    world, beam, second = World(), FlexibleBeam(**SECTION), FlexibleBeam(**SECTION)

    def connections(self):
        yield chain(self.world, self.beam, self.second)


@pytest.mark.parametrize(
    ("model", "chords"),
    [
        (Free, {"beam": False}),
        (Reversed, {"beam": False}),
        (Pushed, {"beam": False}),
        (Loaded, {"beam": True}),
        (Double, {"beam": True, "second": False}),
        (Welded, {"beam": True, "second": False}),
    ],
)
def test_beams_that_hold_something(model: type[Model], chords: dict[str, bool]) -> None:
    result = ac.simulate(model(), stop_time=0.1, intervals=20)
    run = document({"": run_of(result)})["runs"][0]
    curves = [shape for shape in run["shapes"] if shape["kind"] == "curve"]
    assert {run["parts"][s["part"]]["path"]: "chord" in s["rest"] for s in curves} == chords
    for shape in curves:
        if "chord" in shape["rest"]:
            count = len(shape["points"])
            assert shape["rest"]["fractions"] == pytest.approx(np.linspace(0, 1, count))


def test_what_comes_near_once_does_not_hold() -> None:
    t = np.linspace(0, 1, 11)
    T = np.broadcast_to(np.eye(3), (11, 3, 3))
    points = np.zeros((11, 2, 3))
    points[:, 1, 0] = 1
    curve = g.Curve(points, rest=g.Pose(points[:, 0], T), rest_points=points[0])
    passing = g.Sphere(g.Pose(np.stack([1 + 0.1 * np.sin(6 * t), 0 * t, 0 * t], axis=1), T))
    for other, chord in (
        (passing, False),
        (g.Sphere(g.Pose(points[:, 1] + 1e-9, T)), True),
        (g.Arrow(points[:, 1], points[:, 1]), False),
    ):
        found = with_references([PartShape("beam", "Beam", curve), PartShape("other", "Other", other)])
        assert (found[0].shape.rest is None) == chord
