"""Second-order stiffness of beams: turning beams, buckling, large deflections, the spin-up."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

import acausal as ac
from acausal import Model, Scalar, chain, connect, parameter, part, structural, time
from components import (
    Body,
    FlexibleBeam,
    Prismatic,
    Revolute,
    SubstructuredBeam,
    World,
    WorldForce,
    WorldTorque,
    rotational,
)
from models import SpinUp
from tests.reference import cantilever, elastica, rotating_beam

# Length, mass per length and bending stiffness are 1.
UNIT = {"length": 1.0, "E": 1.0, "rho": 1.0, "A": 1.0, "J": 1.0, "torsional_inertia": 1e-6, "axial": "none"}
PLANAR = {"bending": "xy", "torsion": False}
STIFFENED = {"elements": 4, "geometric_stiffness": True}
LONG = {"E": 1e6, "J": 1e-6, "A": 1.0}  # EA = 1e6
Z, Y = (0, 0, 1), (0, 1, 0)


def make(kind: dict[str, Any], **more: Any) -> FlexibleBeam | SubstructuredBeam:
    values = UNIT | more | kind
    return SubstructuredBeam(**values) if "volumes" in values else FlexibleBeam(**values)


class Turning(Model):
    """A beam on a hub that turns steadily about an axis across the beam."""

    kind = structural("values of the beam", default=None)
    n = structural("axis", default=Z, shape=(3,))
    speed: Scalar = parameter("speed", unit="rad/s", default=1.0)
    world, drive = World(gravity=None), rotational.Position(phi_ref=speed * time)
    hub = Revolute(n=n, use_axis_flange=True)

    @part
    def beam(self):
        return make(self.kind, initial="static")

    def connections(self):
        yield from (chain(self.world, self.hub, self.beam), connect(self.drive.flange, self.hub.axis))


def turning(n: tuple, speeds: tuple[float, ...], **kind: Any) -> np.ndarray:
    """Errors of the first three frequencies of bending in xy, one row a speed."""
    compiled = ac.compile(Turning(n=n, kind=PLANAR | {"geometric_stiffness": True} | kind))
    found = [ac.linearize(compiled, parameters={"speed": s}).frequencies_hz[:3] * 2 * np.pi for s in speeds]
    return np.array(found) / [rotating_beam.frequencies(s, n == Z, 3) for s in speeds] - 1


@pytest.mark.parametrize("n", [Z, pytest.param(Y, marks=pytest.mark.slow)])
@pytest.mark.parametrize(
    "kind", [{"elements": 4}, pytest.param({"elements": 4, "reference": "pinned"}, marks=pytest.mark.slow)]
)
def test_both_planes_of_a_turning_beam_bend_alike(n, kind):
    """Each as alone: in the plane of rotation, and across it; what bends less by EJ_y = 2 has the frequencies of its own."""
    both = {"J_y": 2.0, "torsional_inertia": 1e-6, "J_t": 1.0, "bending": "both", "torsion": True}
    for speed in (1.0, 6.0):
        model = Turning(n=n, kind={"geometric_stiffness": True} | kind | both, speed=speed)
        found = ac.linearize(model).frequencies_hz[:4] * 2 * np.pi
        root = np.sqrt(2.0)  # unit of time of the stiffer plane
        xy = rotating_beam.frequencies(speed, n == Z, 3)
        xz = rotating_beam.frequencies(speed / root, n == Y, 3) * root
        expected = np.sort([*xy, *xz])[:4]
        np.testing.assert_allclose(found, expected, rtol=1.5e-3)
        alone = ac.linearize(Turning(n=n, kind=PLANAR | {"geometric_stiffness": True} | kind, speed=speed))
        for frequency in alone.frequencies_hz[:2] * 2 * np.pi:
            assert np.abs(found - frequency).min() < 1e-8 * frequency


@pytest.mark.parametrize("n", [Z, pytest.param(Y, marks=pytest.mark.slow)])
def test_frequencies_of_a_turning_beam(n):
    speeds = (1.0, 3.0, 6.0, 10.0)
    coarse, fine = turning(n, speeds, elements=4), turning(n, speeds, elements=8)
    # Elements are too stiff, and the error falls with the fourth power of their length; 16 in the limit.
    assert (fine > 0).all()
    assert (coarse / fine > (10, 9, 9)).all()
    assert (np.abs(fine[:, 0]) < 3e-4).all()
    assert (np.abs(fine[:3, 0]) < 5e-5).all()
    np.testing.assert_allclose(coarse[0] / fine[0], 16, rtol=0.25)


@pytest.mark.parametrize("n", [Z, Y])
@pytest.mark.parametrize(
    "kind",
    [
        {"elements": 4, "reference": "pinned"},
        {"elements": 4, "axial": "quasi_static"},
        {"volumes": 4},
        {"elements": 4, "axial": "dynamic", **LONG},
    ],
    ids=["pinned", "quasi_static", "volumes", "dynamic"],
)
def test_frequencies_of_a_turning_beam_in_every_formulation(n, kind):
    errors = turning(n, (1.0, 6.0), **kind)
    assert np.abs(errors[0, 0]) < 1e-4
    assert np.abs(errors[1, 0]) < 1.2e-3
    assert np.abs(errors[:, 1]).max() < 1.5e-3


def test_without_its_part_of_the_centrifugal_force_both_planes_are_alike():
    """The straight beam's centrifugal force stiffens; the part that grows with the deflection pulls it outwards."""
    kept, removed, across = (
        ac.linearize(Turning(n=n, kind=PLANAR | STIFFENED | {"centrifugal": on}, speed=3.0)).frequencies_hz[:4]
        * 2
        * np.pi
        for n, on in ((Z, True), (Z, False), (Y, True))
    )
    np.testing.assert_allclose(removed, across, rtol=1e-9)
    np.testing.assert_allclose(kept**2 + 9, across**2, rtol=1e-3)


class Column(Model):
    """A cantilever with an axial force at its tip."""

    kind = structural("values of the beam", default=None)
    force: Scalar = parameter("tension", unit="N", default=1.0)
    world, load = World(gravity=None), WorldForce(force=(force, 0, 0))

    @part
    def beam(self):
        return make(self.kind, initial="static")

    def connections(self):
        yield chain(self.world, self.beam, self.load.frame_b)


class Hinged(Model):
    """A beam with a hinge at each end, one of which slides along it with a light body, under an axial force."""

    kind = structural("values of the beam", default=None)
    force: Scalar = parameter("tension", unit="N", default=1.0)
    world, load = World(gravity=None), WorldForce(force=(force, 0, 0))
    hinge, wrist, guide, slider = Revolute(), Revolute(), Prismatic(), Body(m=1e-3)

    @part
    def beam(self):
        return make(self.kind, reference="pinned")

    def connections(self):
        yield chain(self.world, self.hinge, self.beam, self.wrist, self.slider)
        yield chain(self.world, self.guide, self.slider)
        yield connect(self.slider.frame_a, self.load.frame_b)


BUCKLING = [
    (Column, {}, np.pi**2 / 4),
    (Column, {"reference": "pinned"}, np.pi**2 / 4),
    (Column, {"axial": "quasi_static"}, np.pi**2 / 4),
    (Column, {"axial": "dynamic", **LONG}, np.pi**2 / 4),
    (Column, {"volumes": 4, "elements": None}, np.pi**2 / 4),
    (Hinged, {}, np.pi**2),
    (Hinged, {"axial": "quasi_static"}, np.pi**2),
]


@pytest.mark.parametrize(("model", "kind", "critical"), BUCKLING)
def test_buckling(model, kind, critical):
    kind = {name: value for name, value in (STIFFENED | kind).items() if value is not None}
    compiled = ac.compile(model(kind=kind))
    rest, below, above = (
        ac.linearize(compiled, parameters={"force": -part_of * critical}).eigenvalues
        for part_of in (1e-9, 0.999, 1.001)
    )
    assert below.real.max() < 1e-9 * np.abs(below).max()  # stable
    assert above.real.max() > 0.1
    # The square of the frequency falls linearly with the force, very nearly.
    assert (below[0].imag / rest[0].imag) ** 2 == pytest.approx(1e-3, rel=0.6)


@pytest.mark.slow
def test_tension_raises_frequencies():
    k = np.arange(1, 3) * np.pi
    for force in (10.0, -5.0):
        kind = PLANAR | {"elements": 8}
        found = ac.linearize(Hinged(kind=STIFFENED | kind, force=force)).frequencies_hz[:2] * 2 * np.pi
        np.testing.assert_allclose(found**2, k**4 + force * k**2, rtol=2e-3)
        linear = ac.linearize(Hinged(kind=kind, force=force)).frequencies_hz[:2] * 2 * np.pi
        np.testing.assert_allclose(linear**2, k**4, rtol=2e-3)


class Bent(Model):
    """A cantilever in the static shape under a transverse force and a moment at its tip."""

    kind = structural("values of the beam", default=None)
    force: Scalar = parameter("force", unit="N", default=0.0)
    moment: Scalar = parameter("moment", unit="N.m", default=0.0)
    world, load, turn = World(gravity=None), WorldForce(force=(0, force, 0)), WorldTorque(torque=(0, 0, moment))

    @part
    def beam(self):
        return make(self.kind, initial="static")

    def connections(self):
        yield chain(self.world, self.beam, self.load.frame_b)
        yield connect(self.beam.frame_b, self.turn.frame_b)


def bent(kind: dict[str, Any], name: str, values: tuple[float, ...]) -> np.ndarray:
    """x, y and angle of the tip, then x and y of the middle, one row a load."""
    compiled = ac.compile(Bent(kind=kind, **{name: 1.0}))
    rows = []
    for value in values:
        result = ac.simulate(compiled, stop_time=1e-6, intervals=1, tolerance=1e-8, parameters={name: value})
        T = result["beam.frame_b.R.T"][0]
        angle = np.arctan2(T[0, 1], T[0, 0])
        rows.append([*result["beam.frame_b.r_0"][0, :2], angle, *result["beam.middle_r_0"][0, :2]])
    return np.array(rows)


LOADS = (0.25, 0.5, 1.0)


@pytest.mark.parametrize(
    ("kind", "limit"),
    [
        ({"elements": 8}, 2e-4),
        ({"elements": 8, "axial": "dynamic", **LONG}, 2e-4),
        ({"elements": 8, "reference": "pinned"}, 2e-5),
        ({"volumes": 4}, 1e-5),
    ],
    ids=["tangent", "dynamic", "pinned", "volumes"],
)
def test_a_stiffened_beam_follows_the_elastica(kind, limit):
    exact = np.array([elastica.tip_force(load) for load in LOADS])
    errors = np.abs(bent(kind | {"geometric_stiffness": True}, "force", LOADS)[:, :3] - exact)
    assert errors[1, :2].max() < limit
    assert errors[1, 2] < 2 * limit
    if kind == {"elements": 8}:
        # What is left out is of fourth order in the slope, relative to the deflection.
        orders = np.log2(errors[1:, 1:] / errors[:-1, 1:])
        assert (orders > 4).all()
        linear = np.abs(bent(kind, "force", LOADS)[:, :3] - exact)
        assert (errors[1] < linear[1] / 15).all()


def test_a_moment_bends_into_an_arc():
    moments = (0.2, 0.4)
    found = bent({"elements": 3, "geometric_stiffness": True}, "moment", moments)
    for moment, row in zip(moments, found, strict=True):
        x, y, angle = cantilever.rolled_up([0.5, 1.0], 1.0, moment)
        expected = np.array([x[1], y[1], angle[1], x[0], y[0]])
        np.testing.assert_allclose(row, expected, atol=0.15 * moment**5)


@pytest.mark.parametrize(
    ("omega", "smallest"),
    # The smallest tip deflection of the geometrically exact beam, from a program that shares no formula with this one.
    [(2.0, -0.280436), (4.0, -0.534167), (10.0, -1.083913)],
)
@pytest.mark.slow
def test_spin_up(omega, smallest):
    extensions = {}
    for axial, shape, tolerance in (
        ("none", {"formulation": "fem"}, 1e-8),
        ("quasi_static", {"formulation": "fem"}, 1e-8),
        ("dynamic", {"formulation": "fem"}, 1e-7),
        ("none", {"formulation": "substructured"}, 1e-8),
    ):
        effects = {"beam.axial": axial, "beam.geometric_stiffness": True}
        result = ac.simulate(
            SpinUp(volumes=5, omega=omega, **shape), stop_time=20.0, tolerance=tolerance, parameters=effects
        )
        limit = 7e-4 if axial == "dynamic" else 5e-4  # a looser tolerance
        assert result["tip_deflection"].min() == pytest.approx(smallest, rel=limit)
        extensions[axial, shape["formulation"]] = result["tip_extension"][-1]
    stretch = 2767 * omega**2 * 8**3 / 3 / 6.895e10  # of a straight bar that turns
    bent = extensions["none", "fem"]  # what is left of the bending draws the tip in
    assert abs(bent) < 0.05 * stretch
    assert extensions["quasi_static", "fem"] - bent == pytest.approx(stretch, rel=5e-3)
    assert extensions["dynamic", "fem"] == pytest.approx(extensions["quasi_static", "fem"], rel=0.01)
