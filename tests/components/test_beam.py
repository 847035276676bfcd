"""Flexible beams against theory: frequencies, statics, internal forces, damping, free motion."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

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
SIDES = ("tangent", "pinned"), (False, True)
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
    turned, volumes = kind.pop("turned", False), kind.pop("volumes", 0)
    model = Cantilever(kind=ALUMINIUM | kind, turned=turned, volumes=volumes)
    return ac.linearize(model).frequencies_hz[:count]


def test_frequencies_are_those_of_the_finite_elements():
    found = ac.linearize(Cantilever(kind=ALUMINIUM | {"elements": 3})).frequencies_hz
    across = cantilever.element_frequencies(LENGTH, RHO * A, E * J, 3)
    h = LENGTH / 3
    M = RHO * A * h / 6 * np.array([[4, 1, 0], [1, 4, 1], [0, 1, 2]])
    K = E * A / h * np.array([[2, -1, 0], [-1, 2, -1], [0, -1, 1]])
    along = np.sqrt(np.linalg.eigvals(np.linalg.solve(M, K)).real)
    np.testing.assert_allclose(found, np.sort([*across, *along]) / (2 * np.pi), rtol=1e-7)


def test_frequencies_of_free_vibration():
    found = ac.linearize(FreeVibration()).frequencies_hz[:5]
    np.testing.assert_allclose(found, [2.08547509, 13.06987071, 36.60412252, 71.77955026, 118.84259392], atol=1e-7)


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
    expected = cantilever.element_frequencies(LENGTH, RHO * A, E * J, 4)[:4] / (2 * np.pi)
    np.testing.assert_allclose(bending(4, reference=reference, turned=turned, **shape), expected, rtol=1e-7)


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


def test_static_deflection():
    result = loaded(elements=4)
    x = np.linspace(0, LENGTH, 5)
    v, slope = cantilever.tip_force_deflection(x, LENGTH, E * J, FORCE[1])
    v, slope = v + MOMENT[2] * x**2 / (2 * E * J), slope + MOMENT[2] * x / (E * J)
    expected = np.column_stack([FORCE[0] * x / (E * A), v, slope])
    for k in (0, -1):  # at the start, and it stays so
        np.testing.assert_allclose(result["beam.node_deflection"][k], expected, rtol=1e-6, atol=1e-12)
    np.testing.assert_allclose(result["beam.node_r_0"][0][:, 0], x + expected[:, 0], atol=1e-12)
    np.testing.assert_allclose(result["beam.node_r_0"][0][:, 1], v, atol=1e-12)


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
        across = (left[:, 1] + right[:, 1]) / 2 + l * (left[:, 2] - right[:, 2]) / 12
        local = np.column_stack([along, across, np.zeros(len(q))])
        centre = result["beam.frame_a.r_0"] + np.einsum("kji,kj->ki", T, local)
        acceleration = (centre[2:] - 2 * centre[1:-1] + centre[:-2]) / step**2
        jump = result["beam.node_force"][:, j + 1] - result["beam.node_force"][:, j]
        expected = mu * (acceleration - [0, -9.80665, 0])
        found = np.einsum("kji,kj->ki", T, jump)[1:-1]
        scale = np.abs(expected).max()
        assert scale > 1
        np.testing.assert_allclose(found, expected, atol=2e-3 * scale)


class Twisted(Model):
    """A torque about the axis of a straight beam that nothing holds."""

    kind = structural("values of the beam", default=None)
    world = World(gravity=None)
    hinge = Revolute(n=(1, 0, 0), phi=fixed(0.0), w=fixed(0.0))
    torque = WorldTorque(torque=(0.4, 0.0, 0.0))

    @part
    def beam(self):
        """The beam."""
        return FlexibleBeam(**RUBBER, **self.kind)

    def connections(self):
        yield chain(self.world, self.hinge, self.beam)
        yield connect(self.torque.frame_b, self.beam.frame_b)


@pytest.mark.parametrize("reference", ["tangent", "pinned"])
@pytest.mark.parametrize(
    ("given", "inertia"),
    [({}, 2 * 1000.0 * 1e-7), ({"J_y": 3e-7}, 1000.0 * 4e-7), ({"torsional_inertia": 0.02, "J_y": 3e-7}, 0.02)],
)
def test_torsional_inertia(reference, given, inertia):
    result = ac.simulate(Twisted(kind={"reference": reference, **given}), stop_time=0.1, intervals=2)
    np.testing.assert_allclose(result["hinge.a"], 0.4 / inertia, rtol=1e-9)
    np.testing.assert_allclose(result["beam.torsional_inertia"], inertia, rtol=1e-12)


def test_torsional_inertia_is_shared_by_the_volumes():
    result = ac.simulate(Swing(kind={}, volumes=4), stop_time=0.01, intervals=1)
    shares = [result[f"beam.volume[{k}].torsional_inertia"][0] for k in range(4)]
    np.testing.assert_allclose(shares, 2 * 1000.0 * 1e-7 / 4, rtol=1e-12)


@pytest.mark.parametrize(
    # In volumes, alpha would damp the motion of each in its own frame.
    ("alpha", "beta", "volumes"),
    [(0.8, 0.0, 0), (0.0, 1e-5, 0), (0.8, 1e-5, 0), (0.0, 1e-5, 3)],
)
def test_rayleigh_damping(alpha, beta, volumes):
    kind = ALUMINIUM | {"alpha": alpha, "beta": beta} | ({} if volumes else {"elements": 3})
    found = ac.linearize(Cantilever(kind=kind, volumes=volumes))
    w = cantilever.element_frequencies(LENGTH, RHO * A, E * J, 3)[:4]
    expected = alpha / (2 * w) + beta * w / 2
    np.testing.assert_allclose(found.damping_ratios[:4], expected, rtol=1e-5)
    np.testing.assert_allclose(found.frequencies_hz[:4] * 2 * np.pi, w * np.sqrt(1 - expected**2), rtol=1e-6)


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
