"""Flexible beams against theory: frequencies, statics, internal forces, damping, free motion."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from scipy.linalg import eigh
from scipy.spatial.transform import Rotation

import acausal as ac
from acausal import Model, chain, connect, fixed, part, structural
from components import (
    Body,
    FlexibleBeam,
    Revolute,
    Spherical,
    SubstructuredBeam,
    World,
    WorldForce,
    WorldTorque,
)
from models import FreeVibration
from tests.reference import cantilever
from tests.shared import pairwise

LENGTH, E, RHO, A, J = 2.0, 72e9, 2700.0, 1e-4, 1e-8 / 12
ALUMINIUM = {"length": LENGTH, "E": E, "rho": RHO, "A": A, "J": J}
RUBBER = {"length": 1.0, "E": 1e7, "rho": 1000.0, "A": 1e-3, "J": 1e-7}
PLANAR = {"bending": "xy", "torsion": False}
MASS = RUBBER["rho"] * RUBBER["A"] * RUBBER["length"]


def place_of(result: ac.Result, name: str, k: int = 0) -> np.ndarray:
    return result[f"{name}.r_0"][k]


class Cantilever(Model):
    """A beam clamped in the world by one of its ends."""

    turned = structural("clamped at frame_b", default=False)
    kind = structural("values of the beam", default=None)
    volumes = structural("volumes, 0: FlexibleBeam", default=0)
    world = World(gravity=None)

    @part
    def beam(self):
        """The beam."""
        return SubstructuredBeam(volumes=self.volumes, **self.kind) if self.volumes else FlexibleBeam(**self.kind)

    def connections(self):
        yield connect(self.world.frame_b, self.beam.frame_b if self.turned else self.beam.frame_a)


def bending(count: int, **kind: Any) -> np.ndarray:
    """First frequencies of bending in one plane."""
    turned, volumes = kind.pop("turned", False), kind.pop("volumes", 0)
    model = Cantilever(kind=ALUMINIUM | PLANAR | kind, turned=turned, volumes=volumes)
    return ac.linearize(model).frequencies_hz[:count]


def rod_frequencies(elements: int, inertia: float, stiffness: float) -> np.ndarray:
    """Angular frequencies of linear elements, clamped at the root, with the mean of consistent and lumped masses.

    Parameters
    ----------
    inertia, stiffness : float
        Of an element: mass or moment of inertia, and axial or torsional stiffness.
    """
    M = np.zeros((elements + 1, elements + 1))
    K = np.zeros_like(M)
    for j in range(elements):
        M[j : j + 2, j : j + 2] += inertia / 12 * np.array([[5, 1], [1, 5]])
        K[j : j + 2, j : j + 2] += stiffness * np.array([[1, -1], [-1, 1]])
    return np.sqrt(eigh(K[1:, 1:], M[1:, 1:], eigvals_only=True))


@pytest.mark.parametrize("reference", ["tangent", "pinned"])
def test_frequencies_are_those_of_the_finite_elements(reference):
    J_y, J_t, G, n = 3 * J, 0.7 * J, 27e9, 3
    kind = ALUMINIUM | {"elements": n, "J_y": J_y, "J_t": J_t, "G": G, "reference": reference}
    found = ac.linearize(Cantilever(kind=kind)).frequencies_hz
    across = [cantilever.element_frequencies(LENGTH, RHO * A, E * I, n) for I in (J, J_y)]
    h = LENGTH / n
    along, about = rod_frequencies(n, RHO * A * h, E * A / h), rod_frequencies(n, RHO * (J + J_y) * h, G * J_t / h)
    np.testing.assert_allclose(found, np.sort([*across[0], *across[1], *along, *about]) / (2 * np.pi), rtol=1e-7)


def test_frequencies_of_free_vibration():
    """Those of the square section occur in both planes."""
    found = ac.linearize(FreeVibration()).frequencies_hz[:10]
    expected = np.repeat([2.08547509, 13.06987071, 36.60412252, 71.77955026, 118.84259392], 2)
    np.testing.assert_allclose(found, expected, atol=1e-7)


def test_frequencies_converge_with_the_fourth_power_of_the_element():
    exact = cantilever.bending_frequencies(LENGTH, RHO * A, E * J, 3) / (2 * np.pi)
    errors = np.array([bending(3, elements=n) / exact - 1 for n in (2, 4, 8, 16)])
    assert (errors > 0).all()  # finite elements are too stiff
    rates = np.log2(errors[:-1] / errors[1:])
    assert (rates[2] > rates[1]).all()  # towards 4 from below, the slower the higher the mode
    np.testing.assert_allclose(rates[-1], [4, 4, 4], atol=0.07)
    np.testing.assert_allclose(rates[-1, 0], 4, atol=0.01)
    assert errors[-1, 0] < 2e-7


@pytest.mark.parametrize(
    ("reference", "turned", "shape"),
    pairwise(
        ("tangent", "pinned"),
        (False, True),
        ({"elements": 4}, {"volumes": 4}, {"volumes": 2, "elements_per_volume": 2}),
    ),
)
def test_reference_direction_and_substructuring_do_not_change_frequencies(reference, turned, shape):
    """In both planes, of a section that is stiffer in xz, and in torsion: a shaft as soft as a thread, the lowest ones."""
    both = [cantilever.element_frequencies(LENGTH, RHO * A, E * I, 4)[:4] for I in (J, 3 * J)]
    soft = {"J_y": 3 * J, "J_t": J / 4e3, "torsional_inertia": 4 * RHO * J * LENGTH}
    about = rod_frequencies(4, RHO * J * LENGTH, E / 2.6 * J / 4e3 * 4 / LENGTH)
    expected = np.sort([*both[0], *both[1], *about])[:8] / (2 * np.pi)
    assert about[1] / (2 * np.pi) < expected[-1]
    found = bending(8, reference=reference, turned=turned, bending="both", torsion=True, **soft, **shape)
    np.testing.assert_allclose(found, expected, rtol=1e-7)


FORCE, MOMENT = np.array([3.0, 0.02, 0.7]), np.array([0.1, -0.2, 0.03])


class LoadedCantilever(Cantilever):
    """A force and a torque, both in space, at the tip, in the static shape."""

    force = WorldForce(force=tuple(FORCE))
    torque = WorldTorque(torque=tuple(MOMENT))

    def connections(self):
        yield super().connections()
        for load in (self.force, self.torque):
            yield connect(load.frame_b, self.beam.frame_a if self.turned else self.beam.frame_b)


def loaded(volumes: int = 0, turned: bool = False, **kind: Any) -> ac.Result:
    model = LoadedCantilever(kind=ALUMINIUM | {"initial": "static"} | kind, volumes=volumes, turned=turned)
    return ac.simulate(model, stop_time=0.1, tolerance=1e-8, intervals=2)


def turned_by(c: np.ndarray) -> Rotation:
    """Section of slopes v', w' and the angle phi: the rotation vector is (phi, -w', v'), up to the second order."""
    v, w, phi = c
    return Rotation.from_euler("ZYX", [v - w * phi / 2, -(w + v * phi / 2), phi - v * w / 2])


def on_slopes(c: np.ndarray, torque: np.ndarray, step: float = 1e-6) -> np.ndarray:
    """Generalised forces of a torque on v', w' and phi, by its virtual work."""
    ends = [[(turned_by(c + sign * e) * turned_by(c).inv()).as_rotvec() for sign in (1, -1)] for e in step * np.eye(3)]
    return np.array([torque @ (ahead - behind) for ahead, behind in ends]) / (2 * step)


def test_static_deflection():
    """Linear theory in both planes and in torsion, where the torque works on the angles of the turned section."""
    result, x, on = loaded(elements=4), np.linspace(0, LENGTH, 5), MOMENT
    for _ in range(20):
        across = []
        for force, torque in zip(FORCE[1:], on[:2], strict=True):
            v, slope = cantilever.tip_force_deflection(x, LENGTH, E * J, force)
            across.append((v + torque * x**2 / (2 * E * J), slope + torque * x / (E * J)))
        phi = on[2] * x / (E / 2.6 * 2 * J)
        on = on_slopes(np.array([across[0][1][-1], across[1][1][-1], phi[-1]]), MOMENT)
    (v, slope_v), (w, slope_w) = across
    expected = np.column_stack([FORCE[0] * x / (E * A), v, w, phi, -slope_w, slope_v])
    nodes = result["beam.node_deflection"]
    for k in (0, -1):  # at the start, and it stays so
        np.testing.assert_allclose(nodes[k], expected, rtol=1e-6, atol=1e-12)
    assert (np.abs(expected[-1]) > 5e-7).all()
    straight = np.column_stack([x, 0 * x, 0 * x])
    np.testing.assert_allclose(result["beam.node_r_0"][0], straight + expected[:, :3], atol=1e-9)
    tip = result["beam.frame_b.R.T"][0]
    np.testing.assert_allclose(tip.T, turned_by(np.array([slope_v[-1], slope_w[-1], phi[-1]])).as_matrix(), atol=1e-8)


@pytest.mark.parametrize(
    ("reference", "turned", "shape"),
    pairwise(
        ("tangent", "pinned"),
        (False, True),
        ({"elements": 3}, {"volumes": 3}, {"volumes": 2, "elements_per_volume": 2}),
    ),
)
def test_static_node_forces_and_moments(reference, turned, shape):
    """The part towards the clamp bears the load, about each node in its deflected place."""
    result = loaded(reference=reference, turned=turned, **shape)
    clamp, tip = ("frame_b", "frame_a") if turned else ("frame_a", "frame_b")
    nodes = result["beam.node_r_0"][0]
    np.testing.assert_allclose(nodes[0], place_of(result, "beam.frame_a"), atol=1e-12)
    np.testing.assert_allclose(nodes[-1], place_of(result, "beam.frame_b"), atol=1e-12)
    frames = frames_of_nodes(result, shape, reference)
    for r, T, f, t in zip(nodes, frames, result["beam.node_force"][0], result["beam.node_moment"][0], strict=True):
        force, moment = T.T @ f, T.T @ t
        sign = -1 if turned else 1  # node forces act on the part towards frame_a
        np.testing.assert_allclose(sign * force, FORCE, atol=1e-7)
        arm = place_of(result, f"beam.{tip}") - r
        np.testing.assert_allclose(sign * moment, MOMENT + np.cross(arm, FORCE), atol=1e-7)
    T = result[f"beam.{clamp}.R.T"][0]
    np.testing.assert_allclose(T.T @ result[f"beam.{clamp}.f"][0], -FORCE, atol=1e-7)


def frames_of_nodes(result: ac.Result, shape: dict[str, int], reference: str, k: int = 0) -> list[np.ndarray]:
    """Rotation matrix of the reference frame in which the forces of each node are resolved."""
    name = "frame_a" if reference == "tangent" else "chord"
    if "volumes" not in shape:
        return [result[f"beam.{name}.R.T"][k]] * (shape["elements"] + 1)
    own = [result[f"beam.volume[{i}].{name}.R.T"][k] for i in range(shape["volumes"])]
    return [own[0], *(T for T in own for _ in range(shape.get("elements_per_volume", 1)))]


class Swing(Model):
    """Beam on a spherical joint with a rigid body at its end, tumbling in space under gravity."""

    kind = structural("values of the beam", default=None)
    volumes = structural("volumes, 0: FlexibleBeam", default=0)
    world = World()
    joint = Spherical(angles_fixed=True, w_rel_a=fixed((2.0, 1.0, 3.0)))
    body = Body(m=0.3, r_CM=(0.05, 0.02, 0.03), I=np.diag([2e-3, 3e-3, 4e-3]))

    @part
    def beam(self):
        """The beam."""
        values = RUBBER | self.kind
        return SubstructuredBeam(volumes=self.volumes, **values) if self.volumes else FlexibleBeam(**values)

    def connections(self):
        yield chain(self.world, self.joint, self.beam, self.body)


@pytest.mark.parametrize("reference", ["tangent", "pinned"])
@pytest.mark.parametrize(
    "shape", [{"elements": 3}, pytest.param({"volumes": 2, "elements_per_volume": 2}, marks=pytest.mark.slow)]
)
def test_internal_forces_balance_while_moving(reference, shape):
    """At the ends they are the forces of the frames; between, momentum changes by them and by gravity."""
    kind = {k: v for k, v in shape.items() if k != "volumes"} | {"reference": reference, "torsional_inertia": 1e-3}
    model = Swing(kind=kind, volumes=shape.get("volumes", 0))
    result = ac.simulate(model, stop_time=0.1, tolerance=1e-8, intervals=3)
    for k in range(4):
        frames = frames_of_nodes(result, shape, reference, k)
        force, moment = result["beam.node_force"][k], result["beam.node_moment"][k]
        for end, node, sign in (("frame_a", 0, -1), ("frame_b", -1, 1)):
            T = result[f"beam.{end}.R.T"][k]
            for cut, name in ((force, "f"), (moment, "t")):
                expected = sign * T.T @ result[f"beam.{end}.{name}"][k]
                np.testing.assert_allclose(frames[node].T @ cut[node], expected, atol=1e-8)
    assert np.abs(force).max() > 0.1
    assert np.abs(moment).max() > 0.01


def test_force_between_nodes_is_the_momentum_of_the_element():
    """From node positions alone: mass times second differences of the element's centre, less its weight."""
    result = ac.simulate(Swing(kind={"elements": 3}), stop_time=0.1, tolerance=1e-10, intervals=1000)
    step = result.time[1]
    T = result["beam.frame_a.R.T"]
    q, l, mu = result["beam.node_deflection"], 1.0 / 3, MASS / 3
    for j in range(3):
        left, right = q[:, j], q[:, j + 1]
        along = (j + 0.5) * l + (left[:, 0] + right[:, 0]) / 2
        v = (left[:, 1] + right[:, 1]) / 2 + l * (left[:, 5] - right[:, 5]) / 12
        w = (left[:, 2] + right[:, 2]) / 2 - l * (left[:, 4] - right[:, 4]) / 12
        local = np.column_stack([along, v, w])
        centre = result["beam.frame_a.r_0"] + np.einsum("kji,kj->ki", T, local)
        acceleration = (centre[2:] - 2 * centre[1:-1] + centre[:-2]) / step**2
        jump = result["beam.node_force"][:, j + 1] - result["beam.node_force"][:, j]
        expected = mu * (acceleration - [0, -9.80665, 0])
        found = np.einsum("kji,kj->ki", T, jump)[1:-1]
        scale = np.abs(expected).max()
        assert scale > 1
        np.testing.assert_allclose(found, expected, atol=2e-3 * scale)


@pytest.mark.parametrize(
    # In volumes, alpha would damp the motion of each in its own frame.
    ("alpha", "beta", "volumes"),
    [(0.8, 0.0, 0), (0.0, 1e-5, 0), (0.8, 1e-5, 0), (0.0, 1e-5, 3)],
)
def test_rayleigh_damping(alpha, beta, volumes):
    """In both planes, of a section that is stiffer in xz; torsion of lower stiffness is damped by beta as well."""
    kind = ALUMINIUM | {"alpha": alpha, "beta": beta, "J_y": 3 * J} | ({} if volumes else {"elements": 3})
    w = np.concatenate([cantilever.element_frequencies(LENGTH, RHO * A, E * I, 3)[:4] for I in (J, 3 * J)])
    if alpha:
        kind["torsion"] = False
    else:
        polar = 400 * RHO * J * LENGTH
        kind["torsional_inertia"] = polar
        w = np.r_[w, rod_frequencies(3, polar / 3, E / 2.6 * 4 * J * 3 / LENGTH)]
    w = np.sort(w)[:8]
    found = ac.linearize(Cantilever(kind=kind, volumes=volumes))
    expected = alpha / (2 * w) + beta * w / 2
    np.testing.assert_allclose(found.damping_ratios[:8], expected, rtol=1e-5)
    np.testing.assert_allclose(found.frequencies_hz[:8] * 2 * np.pi, w * np.sqrt(1 - expected**2), rtol=1e-6)


class Entered(Model):
    """A pendulum whose beam is held at either end, and carries a load at the other."""

    at_tip: bool = structural("whether the hinge is at frame_b", default=False)
    world, load = World(), Body(m=0.1)
    hinge = Revolute(phi=fixed(0.1), w=fixed(0))
    beam = FlexibleBeam(length=1.0, E=7e10, rho=2700.0, A=1e-4, J=1e-9, elements=6)

    def connections(self):
        ends = (self.beam.frame_a, self.beam.frame_b)
        first, second = ends[::-1] if self.at_tip else ends
        yield chain(self.world, self.hinge, first)
        yield chain(second, self.load)


def test_a_beam_that_is_entered_at_its_tip_takes_no_more_operations():
    """The equations are solved for the other frame: its inverse motion took 1.3 times as many."""
    root, tip = (ac.compile(Entered(at_tip=at_tip)).local.function.n_instructions() for at_tip in (False, True))
    assert tip < 1.1 * root
