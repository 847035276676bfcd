"""Stretch of beams in its three kinds, rotary inertia, and what centrifugal=False and coriolis=False take away."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

import acausal as ac
from acausal import Model, chain, connect, part, structural
from components import Body, FlexibleBeam, Prismatic, Revolute, SubstructuredBeam, World
from tests.reference import cantilever

BAR = {"length": 2.0, "E": 1e5, "rho": 1000.0, "A": 1e-3, "J": 1e-4}
TIP_MASS, G = 3.0, 10.0
PLANAR = {"bending": "xy", "torsion": False}


class Hanging(Model):
    """A bar that hangs, with a body at its end; guided, a slide beside the bar holds the body too and closes a loop."""

    kind = structural("values of the beam", default=None)
    guided = structural("whether a slide holds the body", default=False)
    turned = structural("whether the bar stands on frame_b", default=False)
    world, tip = World(g=G, n=(1, 0, 0)), Body(m=TIP_MASS)

    @part
    def slide(self):
        return Prismatic() if self.guided else None

    @part
    def pin(self):
        return Revolute() if self.guided else None

    @part
    def beam(self):
        values = {"initial": "static"} | BAR | self.kind
        return SubstructuredBeam(**values) if "volumes" in values else FlexibleBeam(**values)

    def connections(self):
        held, free = (self.beam.frame_a, self.beam.frame_b)[:: -1 if self.turned else 1]
        yield from (connect(self.world.frame_b, held), connect(free, self.tip.frame_a))
        if self.guided:
            yield chain(self.world, self.slide, self.pin, self.tip)


def hung(guided: bool = False, **kind: Any) -> tuple[np.ndarray, np.ndarray]:
    """By how much frame_b and the nodes move along the bar."""
    result = ac.simulate(Hanging(kind=kind, guided=guided), stop_time=0.01, intervals=1, tolerance=1e-8)
    assert np.abs(result["beam.node_r_0"][..., 1:]).max() < 1e-9
    nodes = result["beam.node_r_0"][:, :, 0] - np.linspace(0, 2, 4)
    np.testing.assert_allclose(nodes[0], nodes[1], atol=1e-7)
    return result["beam.frame_b.r_0"][0, 0] - 2, nodes[0]


SHAPES = [
    {"elements": 3},
    {"elements": 3, "geometric_stiffness": True},
    {"elements": 3, "bending": "none"},
    {"volumes": 3},
]


@pytest.mark.parametrize("shape", SHAPES)
@pytest.mark.parametrize("axial", ["dynamic", "quasi_static", "none"])
def test_stretch_by_weight(axial, shape):
    tip, nodes = hung(axial=axial, **shape)
    x = np.linspace(0, 2, 4)
    # The force at x is that of the body and of the bar below.
    stretch = (TIP_MASS * G * x + G * (2 * x - x**2 / 2)) / (BAR["E"] * BAR["A"])
    expected = (axial != "none") * stretch
    np.testing.assert_allclose(nodes, expected, atol=1e-7)
    assert tip == pytest.approx(expected[-1], abs=1e-7)


@pytest.mark.parametrize("shape", [*SHAPES, {"elements": 3, "reference": "pinned"}])
def test_a_bar_held_by_its_frame_b_is_compressed(shape):
    for axial in ("dynamic", "quasi_static"):
        model = Hanging(kind={"axial": axial} | shape, turned=True)
        result = ac.simulate(model, stop_time=0.01, intervals=1, tolerance=1e-8)
        for place in (result["tip.r_0"], result["beam.node_r_0"][:, 0]):
            np.testing.assert_allclose(place, [[-1.2, 0, 0]] * 2, atol=1e-7)


def test_in_a_loop_a_quasi_static_stretch_moves_nodes_alone():
    tip, nodes = hung(guided=True, axial="quasi_static", elements=3)
    assert tip == pytest.approx(0, abs=1e-9)
    assert nodes[-1] == pytest.approx(0.8, abs=1e-7)
    tip, nodes = hung(guided=True, axial="dynamic", elements=3)
    assert tip == pytest.approx(0.8, abs=1e-7)
    assert nodes[-1] == pytest.approx(0.8, abs=1e-7)


class Held(Model):
    """A beam clamped in the world."""

    kind = structural("values of the beam", default=None)
    world = World(gravity=None)

    @part
    def beam(self):
        return FlexibleBeam(**BAR | self.kind)

    def connections(self):
        yield chain(self.world, self.beam)


def frequencies(model: Model) -> np.ndarray:
    return ac.linearize(model).frequencies_hz * 2 * np.pi


@pytest.mark.parametrize("geometric_stiffness", [False, True])
@pytest.mark.slow
def test_frequencies_along(geometric_stiffness):
    """The error falls with the fourth power of the elements, (k l)^4 / 480 with the wave number k."""
    exact = cantilever.axial_frequencies(2.0, 1.0, 100.0, 2)
    kind = {"geometric_stiffness": geometric_stiffness, "elements": 8}
    along = frequencies(Held(kind=kind | {"bending": "none", "torsion": False}))
    assert along.size == 8
    np.testing.assert_allclose(along[:2], exact, rtol=3e-4)
    assert 1 - along[0] / exact[0] == pytest.approx((np.pi / 4 / 4) ** 4 / 480, rel=0.02)
    everything = frequencies(Held(kind=kind))
    for axial in ("quasi_static", "none"):  # what is left bends and twists as before
        across = frequencies(Held(kind=kind | {"axial": axial}))
        np.testing.assert_allclose(np.sort([*along, *across]), everything, rtol=1e-7)


class Hinged(Model):
    """A beam with a hinge at each end, one of which slides along it."""

    kind = structural("values of the beam", default=None)
    world = World(gravity=None)
    hinge, wrist, guide, slider = Revolute(), Revolute(), Prismatic(), Body(m=1e-3)

    @part
    def beam(self):
        stocky = {"length": 1.0, "E": 100.0, "rho": 1.0, "A": 1.0, "J": 0.01, "axial": "none", "reference": "pinned"}
        return FlexibleBeam(**stocky | PLANAR | self.kind)

    def connections(self):
        yield chain(self.world, self.hinge, self.beam, self.wrist, self.slider)
        yield chain(self.world, self.guide, self.slider)


@pytest.mark.parametrize("geometric_stiffness", [False, True])
@pytest.mark.slow
def test_frequencies_of_a_rayleigh_beam(geometric_stiffness):
    k = np.arange(1, 4) * np.pi
    kind = {"geometric_stiffness": geometric_stiffness, "rotary_inertia": True}
    coarse, fine = (frequencies(Hinged(kind=kind | {"elements": n}))[:3] for n in (4, 8))
    exact = k**2 / np.sqrt(1 + 0.01 * k**2)
    np.testing.assert_allclose(fine, exact, rtol=2e-3)
    np.testing.assert_allclose((coarse[0] - exact[0]) / (fine[0] - exact[0]), 16, rtol=0.1)
    plain = frequencies(Hinged(kind=kind | {"elements": 8, "rotary_inertia": False}))[:3]
    np.testing.assert_allclose(plain, k**2, rtol=2e-3)
