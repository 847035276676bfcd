"""Turning blades, spinning shafts and tumbling beams."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from numpy.polynomial import Polynomial
from scipy.linalg import eigh

import acausal as ac
from acausal import Model, Scalar, Vector3, chain, connect, fixed, parameter, part, structural, time
from components import Body, FixedRotation, FreeMotion, Revolute, World
from components.rotational import Position
from tests.components.beams_in_space.scenes import beam_of


class Turning(Model):
    """A beam on a hub of constant speed."""

    kind: dict = structural("values of the beam", default=None)
    axis: Vector3 = structural("axis of the hub", default=(0, 0, 1))
    omega: Scalar = parameter("speed", unit="rad/s", default=1.0)
    world = World(gravity=None)
    hub = Revolute(n=axis, use_axis_flange=True)
    drive = Position(phi_ref=omega * time)

    @part
    def beam(self):
        return beam_of(**self.kind)

    def connections(self):
        yield from (chain(self.world, self.hub, self.beam), connect(self.drive.flange, self.hub.axis))


def modes(omega: float, axis: tuple[float, ...] = (0, 0, 1), **kind: Any) -> np.ndarray:
    """Angular frequencies in the turning frame."""
    model = Turning(kind={"length": 1.0, "rho": 1.0, "A": 1.0, "initial": "static"} | kind, axis=axis)
    return np.abs(np.linalg.eigvals(ac.linearize(model, parameters={"omega": omega}).A).imag)


def nearest(found: np.ndarray, exact: float) -> float:
    return float(found[np.argmin(np.abs(found - exact))] / exact - 1)


POWERS = [Polynomial([0] * (k + 2) + [1]) for k in range(9)]


def gram(weight: Polynomial, order: int) -> np.ndarray:
    """Integrals of products of derivatives of x^2, x^3, ... over a beam of unit length."""
    entries = [[(a.deriv(order) * b.deriv(order) * weight).integ() for b in POWERS] for a in POWERS]
    return np.array([[p(1) - p(0) for p in row] for row in entries])


def flap(gamma: float) -> float:
    """First angular frequency of flapping of a thin blade of EJ = rho A = L = 1, by Ritz."""
    one, pull = Polynomial([1]), Polynomial([0.5, 0, -0.5])
    return float(np.sqrt(eigh(gram(one, 2) + gamma**2 * gram(pull, 1), gram(one, 0))[0][0]))


def test_flapping_has_the_published_frequencies():
    np.testing.assert_allclose([flap(g) for g in (0, 2, 5, 12)], (3.5160, 4.1373, 6.4495, 13.1702), atol=5e-5)


@pytest.mark.parametrize("speed", [0.0, 2.0, 12.0])
def test_turning_blade(speed):
    """One stiffened frame; the chordwise motion lacks the centrifugal force across: w^2 is less by the speed squared."""
    kind = {"E": 1e4, "G": 4e3, "J": 1.6e-3, "J_y": 1e-4, "J_t": 4e-4, "elements": 8, "axial": "none"}
    found = modes(speed, geometric_stiffness=True, **kind)
    assert abs(nearest(found, flap(speed))) < 2e-4
    assert abs(nearest(found, np.sqrt(16 * flap(speed / 4) ** 2 - speed**2))) < 2e-4


def whirl(spin: float, J: float, E: float) -> list[float]:
    """First four angular frequencies of a spinning cantilever in the turning frame, with gyroscopic moments."""
    one, n = Polynomial([1]), len(POWERS)
    M, K, G = gram(one, 0) + J * gram(one, 1), E * J * gram(one, 2), 2 * J * gram(one, 1)
    A = np.block([[np.zeros((n, n)), np.eye(n)], [-np.linalg.solve(M, K), 1j * spin * np.linalg.solve(M, G)]])
    found = np.linalg.eigvals(A).imag
    found = found[np.argsort(np.abs(found))][:4]
    return sorted(abs(x - spin) for x in found)


@pytest.mark.parametrize("spin", [0.0, 20.0])
def test_whirl_of_a_spinning_shaft(spin):
    exact = whirl(spin, 4e-3, 1e4)
    if spin:
        np.testing.assert_allclose(exact, (2.401, 41.669, 113.419, 148.804), atol=1e-3)
    kind = {"E": 1e4, "G": 1e7, "J": 4e-3, "elements": 8, "geometric_stiffness": True}
    found = modes(spin, (1, 0, 0), rotary_inertia=True, **kind)
    assert max(abs(nearest(found, x)) for x in exact) < 2e-4
    assert max(abs(nearest(modes(spin, (1, 0, 0), **kind), x)) for x in exact) > 5e-3


def test_propeller_moment():
    """The torsion of a turning blade is stiffened by Omega^2 (I_z - I_y) / (I_z + I_y)."""
    kind = {"E": 1e6, "G": 2e3, "J": 0.01, "J_y": 0.002, "J_t": 0.004, "elements": 8, "geometric_stiffness": True}
    rest = (np.pi / 2) ** 2 * 2e3 * 0.004 / 0.012
    for speed in (0.0, 20.0):
        exact = np.sqrt(rest + speed**2 * 0.008 / 0.012)
        assert abs(nearest(modes(speed, rotary_inertia=True, **kind), exact)) < 2e-3


class Tumbling(Model):
    """A free beam with bodies at both ends."""

    kind: dict = structural("values of the beam", default=None)
    axis: Vector3 = structural("axis about which all is turned", default=(1, 0, 0))
    angle: float = structural("angle", default=0.0)
    world, turned = World(gravity=None), FixedRotation(n=axis, angle=angle)
    free = FreeMotion(r_rel_a=fixed((0, 0, 0)), v_rel_a=fixed((0, 0, 0)), w_rel_a=fixed((2, 3, 4)), angles_fixed=True)
    root = Body(m=0.3, r_CM=(0.02, 0.03, -0.01), I=np.diag([2e-3, 3e-3, 4e-3]))
    tip = Body(m=0.2, r_CM=(0.01, -0.02, 0.03), I=np.diag([3e-3, 2e-3, 1e-3]))

    @part
    def beam(self):
        values = {"length": 1.0, "E": 4e5, "G": 1.6e5, "rho": 1000.0, "A": 1e-3, "J": 2e-6, "J_y": 1e-6, "J_t": 1.5e-6}
        return beam_of(**values | self.kind)

    def connections(self):
        yield chain(self.world, self.turned, self.free, self.beam, self.tip)
        yield connect(self.root.frame_a, self.beam.frame_a)


TUMBLING = [
    {"elements": 2},
    {"elements": 2, "reference": "pinned", "geometric_stiffness": True},
    {"volumes": 2, "geometric_stiffness": True, "rotary_inertia": True},
    {"elements": 2, "axial": "none", "geometric_stiffness": True, "shear": True},
]


def tumble(**kind: Any) -> ac.Result:
    angles = {k: kind.pop(k) for k in ("axis", "angle") if k in kind}
    return ac.simulate(
        Tumbling(kind=kind, **angles), stop_time=0.5, intervals=10, tolerance=1e-9, method="resolve", energy=True
    )


@pytest.mark.parametrize(
    "kind", [TUMBLING[0], *(pytest.param(kind, marks=pytest.mark.slow) for kind in TUMBLING[1:3]), TUMBLING[3]]
)
def test_tumbling_keeps_its_energy_and_momentum(kind):
    result = tumble(**kind)
    assert np.abs(result["beam.node_deflection"][:, :, 1:3]).max() > 5e-3
    assert abs(result.stats["energy_stored_change"]) < 1e-6


def test_tumbling_does_not_depend_on_the_axes_of_the_world():
    kind = TUMBLING[1]
    one, other = tumble(**kind), tumble(**kind, axis=(1, 2, 3), angle=0.7)
    for name in ("beam.node_deflection", "beam.node_moment"):
        np.testing.assert_allclose(one[name], other[name], rtol=0, atol=1e-9 * np.abs(one[name]).max())
