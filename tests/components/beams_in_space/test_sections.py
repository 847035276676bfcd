"""Sections that vary along a beam, and sections with offsets, against Ritz' method."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from numpy.polynomial import Polynomial
from scipy.linalg import block_diag, eigh

import acausal as ac
from acausal import Model, Scalar, chain, parameter
from components import Circle, FlexibleBeam, Load, Rectangle, Section, Tube, World
from tests.components.beams_in_space.scenes import Cantilever

POWERS = [Polynomial([0] * (k + 2) + [1]) for k in range(10)]
TWISTS = [Polynomial([0] * (k + 1) + [1]) for k in range(10)]
X, W = np.polynomial.legendre.leggauss(40)
X, W = (X + 1) / 2, W / 2


def gram(weight: Any, left: list[Polynomial], right: list[Polynomial], order: int = 0) -> np.ndarray:
    """Integrals over a beam of unit length of products of derivatives."""
    a, b = (np.array([p.deriv(order)(X) for p in own]) for own in (left, right))
    return (a * (W * weight(X))) @ b.T


def lowest(K: Any, M: Any, count: int = 3) -> np.ndarray:
    return np.sqrt(eigh(K, M)[0][:count])


def frequencies(**kind: Any) -> np.ndarray:
    model = Cantilever(kind={"length": 1.0} | kind)
    return ac.linearize(model).frequencies_hz * 2 * np.pi


def nearest(found: np.ndarray, exact: float) -> float:
    return float(found[np.argmin(np.abs(found - exact))] / exact - 1)


def test_taper_converges_with_order_4_nearly():
    """A strip whose width falls to one half."""

    def strip(s: Any) -> Rectangle:
        return Rectangle(width=0.02 * (1 - s / 2), height=0.01)

    E, rho = 1e9, 1000.0
    exact = lowest(
        gram(lambda x: E * 0.01 * (0.02 * (1 - x / 2)) ** 3 / 12, POWERS, POWERS, 2),
        gram(lambda x: rho * 0.01 * 0.02 * (1 - x / 2), POWERS, POWERS),
    )[0]
    errors = []
    for n in (4, 8):
        found = frequencies(section=strip, E=E, rho=rho, elements=n, bending="xy", torsion=False, axial="none")
        errors.append(abs(nearest(found, exact)))
    assert errors[0] < 3e-5
    assert errors[0] / errors[1] > 7


def test_taper_in_volumes_is_that_of_one_frame():
    def strip(s: Any) -> Rectangle:
        return Rectangle(width=0.02 * (1 - s / 2), height=0.01 + 0.005 * s)

    one, chain = (frequencies(section=strip, E=1e9, rho=1e3, **n) for n in ({"elements": 4}, {"volumes": 4}))
    np.testing.assert_allclose(one[:6], chain[:6], rtol=1e-7)


def test_pre_twist_converges_with_order_4():
    """Twisted by 45 degrees, with stiffnesses 16 to 1."""
    strong, weak = 16.0, 1.0

    def twisted(s: Any) -> Section:
        return Section(EA=1e8, EJ_y=weak, EJ_z=strong, GJ_t=1e4, mass=1.0, I_y=1e-6, I_z=1e-6, angle=np.pi / 4 * s)

    def turned(entry: int):
        c, s = (lambda x: np.cos(np.pi / 4 * x)), (lambda x: np.sin(np.pi / 4 * x))
        return (
            lambda x: strong * c(x) ** 2 + weak * s(x) ** 2,
            lambda x: (strong - weak) * c(x) * s(x),
            lambda x: strong * s(x) ** 2 + weak * c(x) ** 2,
        )[entry]

    vv, vw, ww = (gram(turned(k), POWERS, POWERS, 2) for k in range(3))
    mass = gram(np.ones_like, POWERS, POWERS)
    exact = lowest(np.block([[vv, vw], [vw.T, ww]]), block_diag(mass, mass))[0]
    errors = [
        abs(nearest(frequencies(section=twisted, elements=n, axial="none", torsion=False), exact)) for n in (4, 8)
    ]
    assert errors[0] < 3e-5
    assert errors[0] / errors[1] > 14


@pytest.mark.parametrize("plane", ["xy", "xz"])
def test_offset_of_the_shear_centre_couples_bending_and_torsion(plane):
    """The nodal line runs through the centroid: m (v - e phi)'' couples v and phi, without warping."""
    e, EJ, GJ, polar = 0.03, 1.0, 0.4, 2e-3
    values = {"EA": 1e6, "EJ_y": EJ, "EJ_z": EJ, "GJ_t": GJ, "mass": 1.0, "I_y": polar / 2, "I_z": polar / 2}
    offset = {"z_s": e} if plane == "xy" else {"y_s": e}
    mass = gram(np.ones_like, POWERS, POWERS)
    mixed, turning = gram(np.ones_like, POWERS, TWISTS), gram(np.ones_like, TWISTS, TWISTS)
    # With the deflection of the shear centre v_s, the centroid moves by v_s + e phi (in xz: w_s - e phi).
    sign = 1 if plane == "xy" else -1
    M = np.block([[mass, sign * e * mixed], [sign * e * mixed.T, (polar + e * e) * turning]])
    K = block_diag(EJ * gram(np.ones_like, POWERS, POWERS, 2), GJ * gram(np.ones_like, TWISTS, TWISTS, 1))
    exact = lowest(K, M, 4)
    found = frequencies(section=Section(**values, **offset), elements=12, axial="none", bending=plane)
    assert max(abs(nearest(found, w)) for w in exact[:3]) < 2e-3
    plain = lowest(K, block_diag(mass, polar * turning), 4)
    assert max(abs(nearest(found, w)) for w in plain) > 2e-2


def test_axis_through_any_point_gives_the_same_beam():
    """Centroid and shear centre off the axis, and a load through them, against the axis through both."""
    y, z = 0.02, -0.03
    values = {"EA": 1e6, "EJ_y": 1.0, "EJ_z": 3.0, "GJ_t": 0.4, "mass": 1.0, "I_y": 1e-3, "I_z": 2e-3}
    plain = frequencies(section=Section(**values), elements=6, rotary_inertia=True)
    off = frequencies(section=Section(**values, y_c=y, z_c=z, y_s=y, z_s=z), elements=6, rotary_inertia=True)
    # The mass off the axis counts where the section turns, as rotary inertia does: at its points of Gauss, not Simpson's.
    np.testing.assert_allclose(off[:6], plain[:6], rtol=2e-3)


@pytest.mark.parametrize("section", [Rectangle(0.02, 0.01), Circle(0.02), Tube(0.02, 0.015)])
def test_values_of_solid_sections(section):
    """Area and second moments by quadrature; the torsion constant of round ones is the polar moment."""
    y, z = np.meshgrid(*[np.linspace(-0.01, 0.01, 4001)] * 2, indexing="ij")
    if isinstance(section, Rectangle):
        inside = (np.abs(y) <= 0.01) & (np.abs(z) <= 0.005)
    else:
        r = np.hypot(y, z)
        inside = (r <= 0.01) & (r >= getattr(section, "d_i", 0) / 2)
    cell = (0.02 / 4000) ** 2
    for value, weight in ((section.A, 1 + 0 * y), (section.J_z, y**2), (section.J_y, z**2)):
        assert float(value) == pytest.approx((weight * inside).sum() * cell, rel=3e-3)
    if not isinstance(section, Rectangle):
        assert section.J_t == pytest.approx(section.J_y + section.J_z)


def test_shear_factors():
    assert Rectangle(1, 2).shear_factor(0.3) == 5 / 6
    assert Circle(1).shear_factor(0.3) == pytest.approx(6 * 1.3 / 8.8)
    assert Tube(1, 0).shear_factor(0.3) == pytest.approx(Circle(1).shear_factor(0.3))
    assert Tube(1, 0.999).shear_factor(0.3) == pytest.approx(2 * 1.3 / (4 + 3 * 0.3), rel=1e-3)


def test_torsion_constant_of_rectangles():
    """Timoshenko, Goodier: 0.1406, 0.229, 0.263 and 0.312 a b^3 with sides of ratio 1, 2, 3 and 10."""
    for ratio, factor in ((1, 0.1406), (2, 0.229), (3, 0.263), (10, 0.312)):
        for width, height in ((ratio, 1.0), (1.0, ratio)):
            assert Rectangle(width, height).J_t == pytest.approx(factor * ratio, rel=2e-3)


class Shelf(Model):
    """A round beam under a uniform load; both are parameters of the model."""

    d: Scalar = parameter("diameter", unit="m", default=0.02)
    q: Scalar = parameter("load per length", unit="N/m", default=1.0)
    world = World(gravity=None)
    beam = FlexibleBeam(
        length=1.0, section=Circle(d), E=2e11, rho=7850.0, initial="static", distributed=Load((0, q, 0))
    )

    def connections(self):
        yield chain(self.world, self.beam)


def test_sections_and_loads_take_parameters_of_the_model():
    model = ac.compile(Shelf())
    for d, q in ((0.02, 1.0), (0.03, 2.0)):
        result = ac.simulate(model, stop_time=1e-4, intervals=1, parameters={"d": d, "q": q})
        EJ = 2e11 * np.pi / 64 * d**4
        assert result["beam.frame_b.r_0"][0, 1] == pytest.approx(q / (8 * EJ), rel=1e-4)


def test_report_lists_defaults_that_were_taken():
    kind = {"length": 1.0, "E": 1e9, "rho": 1e3, "A": 1e-4, "J": 1e-9, "J_t": 2e-9, "volumes": 2}
    assert ac.compile(Cantilever(kind=kind)).report["defaults"] == {
        "beam.G": "beam.E, beam.nu",
        "beam.J_y": "beam.J",
        "beam.torsional_inertia": "beam.rho, beam.J, beam.length",
    }
    given = ac.compile(Cantilever(kind=kind), {"beam.J_y": 2e-9, "beam.G": 1e9})
    assert list(given.report["defaults"]) == ["beam.torsional_inertia"]
    solid = ac.compile(Cantilever(kind={"length": 1.0, "E": 1e9, "G": 4e8, "rho": 1e3, "section": Rectangle(0.1, 0.2)}))
    assert list(solid.report["defaults"]) == ["beam.torsional_inertia"]
