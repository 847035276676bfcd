"""Beams warn where what their frames neglect exceeds 1 % of the deflection, and are quiet where it is small."""

import warnings
from functools import cache

import numpy as np
import pytest
import sympy as sp

import acausal as ac
from acausal import (
    Model,
    Scalar,
    chain,
    connect,
    guess,
    parameter,
)
from components import (
    FlexibleBeam,
    Prismatic,
    Revolute,
    SubstructuredBeam,
    World,
    WorldForce,
    WorldTorque,
)
from tests.reference.elastica import tip_force

SECTION: dict = {"length": 1, "E": 1e9, "rho": 1000, "A": 1e-4, "J": 1e-9, "axial": "none", "initial": "static"}
AXIAL, SLOPE = "axial force", "slope is too large"


def doubts(model, **options):
    """Warnings of a run, and its result."""
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        result = ac.simulate(model, **options)
    texts = [str(w.message) for w in caught if issubclass(w.category, ac.AcausalWarning)]
    assert texts == result.stats["doubts"]
    return texts, result


class Cantilever(Model):
    """Clamped at the root; a force P at the tip keeps its direction, with a part H along the beam."""

    world = World(gravity=None)
    load = WorldForce()
    beam = FlexibleBeam(elements=8, **SECTION)
    P: Scalar = parameter("force across", unit="N", default=1)
    H: Scalar = parameter("force along", unit="N", default=0)

    def connections(self):
        yield chain(self.world, self.beam)
        yield connect(self.load.frame_b, self.beam.frame_b)

    def equations(self):
        yield self.load.force == (self.H, self.P, 0)


@cache
def of(scene, kind, **values):
    """A scene with one of the beams, compiled; values that are not 0 may be changed."""
    return ac.compile(scene(beam=BEAMS[kind](), **values))


def at_rest(model, **parameters):
    return doubts(model, parameters=parameters, stop_time=1e-3, intervals=2)


def tip_error(model, P):
    """Texts of a cantilever, and the relative error of its tip's deflection."""
    texts, result = at_rest(model, P=P)
    exact = tip_force(P)[1]
    return texts, abs(result["beam.frame_b.r_0"][0, 1] - exact) / exact


BEAMS = {
    "linear": lambda: FlexibleBeam(elements=8, **SECTION),
    "linear, pinned": lambda: FlexibleBeam(elements=8, reference="pinned", **SECTION),
    "stiffened": lambda: FlexibleBeam(elements=8, geometric_stiffness=True, **SECTION),
    "volumes": lambda: SubstructuredBeam(volumes=4, **SECTION),
    "stiffened volumes": lambda: SubstructuredBeam(volumes=4, geometric_stiffness=True, **SECTION),
}


def told(texts, name="beam"):
    """Greatest share that the warnings about a part tell."""
    sizes = [text.partition("up to ")[2].partition(" %")[0] for text in texts if text.startswith(name + " ")]
    return max((float(size) / 100 if size else 1 for size in sizes), default=0)


def check(texts, error, name="beam"):
    """Warnings come where they should, and tell the size of the error within a factor of 2."""
    size = told(texts, name)
    assert size or error < 0.013
    assert not size or error > 0.005
    if 0.01 <= error <= 0.2 and size:
        assert 0.5 < size / error < 2


@pytest.mark.parametrize("kind", BEAMS)
@pytest.mark.slow
def test_tip_load_against_the_elastica(kind):
    for P in (0.1, 0.25, 0.4, 0.5, 1, 2, 3):
        texts, error = tip_error(of(Cantilever, kind), P)
        check(texts, error)
        if texts and "pinned" not in kind:
            assert SLOPE in texts[0]


def test_series_of_the_energy_are_those_of_the_elastica():
    x, p = sp.symbols("x p", positive=True)
    slope = p * (x - x**2 / 2)  # of a cantilever of unit length and stiffness under a force p at the tip
    bent = sp.diff(slope, x)
    # A term W(p) left out of the energy moves the tip by dW/dp (Castigliano), here relative to p / 3.
    linear, second = (
        sp.simplify(sp.diff(sp.integrate(bent**2 * slope**n / 2, (x, 0, 1)), p) / (p / 3)) for n in (2, 4)
    )
    assert linear == sp.Rational(4, 35) * p**2
    for load in (0.1, 0.2):
        assert load / 3 / tip_force(load)[1] - 1 == pytest.approx(float(linear.subs(p, load)), rel=0.01)
    texts, error = tip_error(of(Cantilever, "stiffened"), 1)
    assert told(texts) == pytest.approx(error, rel=0.15)
    assert error < float(second.subs(p, 1))  # slopes are smaller than those of the linear beam


class TipMoment(Model):
    """Clamped at the root, with a moment at the tip: bent to a circle."""

    world, load = World(gravity=None), WorldTorque()
    beam = FlexibleBeam(elements=8, **SECTION)
    M: Scalar = parameter("moment", unit="N.m", default=1)

    def connections(self):
        yield chain(self.world, self.beam)
        yield connect(self.load.frame_b, self.beam.frame_b)

    def equations(self):
        yield self.load.torque == (0, 0, self.M)


@pytest.mark.parametrize("kind", BEAMS)
def test_tip_moment_against_the_circle(kind):
    for M in (0.2, 0.6, 1):
        texts, result = at_rest(of(TipMoment, kind), M=M)
        # The deflection is that from the chord where the reference is pinned.
        found, angle = (
            (-result["beam.middle_deflection"][0], M / 2) if "pinned" in kind else (result["beam.frame_b.r_0"][0, 1], M)
        )
        check(texts, abs(found * M / (1 - np.cos(angle)) - 1))


class Column(Model):
    """Hinged at both ends, under its weight across and a force H along, that buckles it at -pi^2."""

    world, load = World(g=0.5), WorldForce()
    foot, head, guide = Revolute(), Revolute(phi=guess(0)), Prismatic(s=guess(1))
    beam = FlexibleBeam(elements=8, **SECTION)
    H: Scalar = parameter("force along", unit="N", default=0)

    def connections(self):
        yield chain(self.world, self.foot, self.beam, self.head, self.guide.frame_b)
        yield connect(self.world.frame_b, self.guide.frame_a)
        yield connect(self.load.frame_b, self.guide.frame_b)

    def equations(self):
        yield self.load.force == (self.H, 0, 0)


@pytest.mark.parametrize("reference", ["tangent", "pinned"])
@pytest.mark.parametrize("part_of_buckling", [-0.1, -0.03, 0.002, 0.03, 0.1])
def test_column_between_hinges(part_of_buckling, reference):
    H, q, errors = part_of_buckling * np.pi**2, 0.05, []
    kind = {"tangent": "linear", "pinned": "linear, pinned"}[reference]
    texts, result = at_rest(of(Column, kind, H=1.0), H=H)
    # Timoshenko, Gere, Theory of Elastic Stability, section 1.11, H < 0; for H > 0 the angle is imaginary.
    u = np.sqrt(complex(-H)) / 2
    exact = (q / (16 * u**4) * (1 / np.cos(u) - 1) - q / (8 * 4 * u**2)).real
    root = (q / (8 * u**3) * (np.tan(u) - u)).real  # slope at the foot
    errors.append(abs(result["beam.middle_deflection"][0]) / exact - 1)
    errors.append(abs(result["foot.phi"][0]) / root - 1)
    check(texts, max(np.abs(errors)))


def test_text_tells_part_size_and_mend():
    texts, error = tip_error(of(Cantilever, "linear"), 1)
    (text,) = texts
    assert text.startswith("beam (FlexibleBeam), ")
    assert "test_beam_range.py:" in text
    assert "geometric_stiffness=True" in text
    assert "t = 0 s" in text
    assert 0.8 < told(texts) / error < 1.25


@pytest.mark.parametrize(("part_of_buckling", "warns"), [(-0.001, False), (0.001, False), (-0.03, True), (0.05, True)])
def test_axial_load_against_buckling(part_of_buckling, warns):
    H = part_of_buckling * np.pi**2 / 4
    texts, linear = at_rest(of(Cantilever, "linear", H=1.0), P=0.05, H=H)
    assert [AXIAL in text for text in texts] == [True] * warns
    quiet, right = at_rest(of(Cantilever, "stiffened", H=1.0), P=0.05, H=H)
    assert not quiet
    tips = [r["beam.frame_b.r_0"][0, 1] for r in (linear, right)]
    assert (abs(tips[0] / tips[1] - 1) > 0.01) == warns


def test_deflection_that_is_not_seen_does_not_matter():
    model = of(Cantilever, "linear", H=1.0)
    assert not at_rest(model, P=1e-7, H=-0.1)[0]
    assert not at_rest(model, P=0, H=-0.5)[0]
