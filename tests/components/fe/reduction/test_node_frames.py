"""Frames at nodes: weights by area, places and axes that are given, and nodes on circles."""

from __future__ import annotations

import warnings

import numpy as np
import pytest

import acausal as ac
from acausal import AcausalWarning, DeclarationError, Model, chain, fixed
from components import Body, FixedRotation, Revolute, World
from components.fe import FEBody, Nodes, assemble, average, frame_at, read_sid, reduce_body, rigid, write_sid
from components.fe.elements.box import mesh
from components.fe.elements.faces import area_weights
from components.fe.reduction.circle_fit import circle_of
from components.fe.reduction.node_frames import frame
from components.fe.reduction.reduced_body import ReducedBody
from components.orientation import axis_rotation, unit_vector
from tests.components.fe import bodies

STEEL = {"E": 2.1e11, "nu": 0.3, "rho": 7850.0}
RADIUS, CENTRE = 0.02, np.array([0.2, 0.05, 0.0])


def ring(element: str, count: int = 16, share: float = 1.0) -> Nodes:
    """A ring round CENTRE, or a part of it, fine on one side and coarse on the other; its axis is along z."""
    points, cells = mesh((1.0, 1.0, 1.0), (1, count, 1), element)
    used, row = np.unique(
        np.c_[points[:, 0], points[:, 1] % share**-9, points[:, 2]].round(9), axis=0, return_inverse=True
    )
    angle = 2 * np.pi * share * (used[:, 1] + 0.1 * np.sin(2 * np.pi * used[:, 1]))
    r = RADIUS * (1 + 0.5 * used[:, 0])
    places = CENTRE + np.stack([r * np.cos(angle), r * np.sin(angle), 0.01 * used[:, 2]], axis=1)
    return Nodes(places, cells={kind: row.reshape(-1)[members] for kind, members in cells.items()})


def inside(nodes: Nodes) -> np.ndarray:
    r = np.linalg.norm((np.asarray(nodes) - CENTRE)[:, :2], axis=1)
    return np.flatnonzero(r < r.min() + 0.2 * RADIUS * 0.5)


@pytest.mark.parametrize(("element", "error"), [("hex8", 2e-2), ("hex20", 2e-4), ("tet10", 2e-4)])
def test_a_hole_has_its_frame_at_its_centre(element: str, error: float) -> None:
    """Where the mesh is finer on one side of the hole; the mean of the nodes is a tenth of the radius off."""
    nodes = ring(element)
    at = inside(nodes)
    mean = np.asarray(nodes)[at].mean(axis=0)
    assert np.linalg.norm((mean - CENTRE)[:2]) > 0.05 * RADIUS
    with warnings.catch_warnings():
        warnings.simplefilter("error" if element != "hex8" else "ignore")
        found = frame("hole", at, np.asarray(nodes), nodes.cells).place
    assert np.linalg.norm((found - CENTRE)[:2]) < error * RADIUS
    assert found[2] == pytest.approx(0.005, rel=1e-5)  # triangles are cut along one diagonal


@pytest.mark.parametrize("share", [pytest.param(1.0, marks=pytest.mark.slow), 0.5])
def test_nodes_on_a_circle_whose_centre_is_elsewhere(share: float) -> None:
    """Without elements, and half a bearing, whose mean is 2 / pi radii off: the warning has the place to be given."""
    nodes = ring("hex20", share=share)
    at, plain = inside(nodes), np.asarray(nodes)
    cells = {} if share == 1 else nodes.cells
    M, K, _ = assemble(plain, nodes.cells, **STEEL)
    with pytest.warns(
        AcausalWarning,
        match=r"frame 'hole' is at the mean of its nodes, .* m off the axis of the circle of radius 0.02 m",
    ) as caught:
        body = reduce_body(M, K, Nodes(plain, cells=cells), frames={"hole": at}, hold="mean-axis", modes=2)
    assert caught[0].filename == __file__
    place = body.interfaces[0].place + body.origin
    off = np.linalg.norm((place - CENTRE)[:2])
    assert f"{off:.3g} m off the axis" in str(caught[0].message)
    if share == 0.5:
        assert off == pytest.approx(2 / np.pi * RADIUS, rel=1e-3)
    text = str(caught[0].message)
    given = eval(text[text.index("place=") + 6 : text.rindex(")}")], {})
    assert np.abs((given - CENTRE)[:2]).max() < 1e-3 * RADIUS
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        body = reduce_body(M, K, plain, frames={"hole": frame_at(at, given)}, hold="mean-axis", modes=2)
    assert body.interfaces[0].place + body.origin == pytest.approx(given, abs=1e-12)


@pytest.mark.parametrize("turned", [False, True])
def test_circles(turned: bool) -> None:
    rng = np.random.default_rng(4)
    T = np.linalg.qr(rng.normal(size=(3, 3)))[0] if turned else np.eye(3)
    angle = np.sort(rng.uniform(0, 2 * np.pi, 30))
    for height in (0 * angle, rng.uniform(-3, 5, 30)):
        round_ = np.stack([2 * np.cos(angle) + 1, 2 * np.sin(angle) - 3, height], axis=1)
        found = circle_of(round_ @ T.T)
        assert found is not None
        assert found.radius == pytest.approx(2, rel=1e-9)
        assert abs(found.axis @ T[:, 2]) == pytest.approx(1, abs=1e-12)
        place = T @ [7.0, 7.0, 1.5]
        assert found.nearest(place) == pytest.approx(T @ [1.0, -3.0, 1.5], abs=1e-8)
        assert circle_of(round_[:5] @ T.T) is None
        assert circle_of(round_[(angle > 1) & (angle < 2.4)] @ T.T) is None  # less than a quarter
    flat = np.stack(np.meshgrid(range(5), range(3), [0.0]), axis=-1).reshape(-1, 3)
    block = np.stack(np.meshgrid(range(3), range(3), range(3)), axis=-1).reshape(-1, 3) * 1.0
    prism = np.array([(x, y, z) for x, y in ((0, 0), (1, 0), (0.3, 0.8)) for z in range(5)], dtype=float)
    for other in (flat, block, prism, np.arange(30.0).reshape(10, 3)):
        assert circle_of(other @ T.T) is None


@pytest.mark.parametrize("element", ["hex8", "hex20", "tet10"])
def test_weights_are_areas(element: str) -> None:
    """Their sum is that of the faces, and a linear function has the mean that it has on the face, in an uneven mesh."""
    points, cells = mesh((1.0, 1.0, 1.0), (2, 3, 4), element)
    places = points**2 * [0.3, 0.2, 0.1]
    at = np.flatnonzero(points[:, 0] == 1)
    weights = area_weights(at, places, cells)
    assert weights is not None
    assert weights.sum() == pytest.approx(0.2 * 0.1, rel=1e-12)
    exact = [0.3, 0.1, 0.05]
    assert weights @ places[at] / weights.sum() == pytest.approx(exact, rel=1e-12)
    middle = np.flatnonzero(points[:, 0] == 0.5)  # inside the body, where the faces of two elements are one
    weights = area_weights(middle, places, cells)
    assert weights is not None
    assert weights.sum() == pytest.approx(0.2 * 0.1, rel=1e-12)
    assert area_weights(np.append(at, middle[0]), places, cells) is None
    assert area_weights(at[:2], places, cells) is None
    assert area_weights(at, places, {}) is None


@pytest.mark.parametrize("make", [frame_at, rigid, average])
def test_a_place_follows_its_nodes_rigidly(make) -> None:
    """Where the nodes move as a rigid body, so does the frame, wherever it is."""
    _, _, nodes = bodies.block()
    at, place = bodies.face(nodes, 0, -1), np.array([0.5, -0.2, 0.3])
    found = frame("face", make(at, place=place), np.asarray(nodes), nodes.cells)
    motions = bodies.rigid(np.asarray(nodes)[at], place)
    np.testing.assert_allclose(found.maps @ motions, np.eye(6), atol=1e-12)
    assert found.place == pytest.approx(place, abs=0)


def test_places_and_axes_that_cannot_be() -> None:
    M, K, nodes = bodies.block()
    on_line = np.asarray(nodes)[[0, 2]].mean(axis=0) + 0.1 * (nodes[2] - nodes[0])
    reduce_body(M, K, nodes, frames={"line": frame_at([0, 2], place=on_line)}, modes=1)
    for spider, message in (
        (lambda: frame_at([0, 2], place=(5, 5, 5)), "the place of frame 'a' must be on the line of its nodes"),
        (lambda: frame_at([7], place=(5, 5, 5)), "the place of frame 'a' must be at its node"),
        (lambda: frame_at([7, 8, 9], place=(5, 5)), r"the place of a frame must be x, y, z in m, not \(5, 5\)"),
        (lambda: rigid([7, 8, 9], place="centre"), "the place of a frame must be x, y, z in m, not 'centre'"),
        (lambda: frame_at([7, 8, 9], axes=((1, 0, 0), (2, 0, 0))), "axes of a frame must be orthogonal vectors"),
        (lambda: average([7, 8, 9], axes=((1, 0, 0), (0, 0, 0))), "axes of a frame must be orthogonal vectors"),
        (lambda: frame_at([7, 8, 9], axes=-np.eye(3)), "axes of a frame must be orthogonal vectors"),
        (lambda: frame_at([7, 8, 9], axes=(1, 0, 0)), "axes of a frame must be orthogonal vectors"),
    ):
        with pytest.raises(DeclarationError, match=message):
            reduce_body(M, K, nodes, frames={"a": spider()}, modes=1)


AXIS, ANGLE = (1.0, 2.0, -1.0), 0.8
AXES = axis_rotation(unit_vector(AXIS), ANGLE)
M, K, BLOCK = bodies.block()


def block_of(axes, hold: str) -> ReducedBody:
    """A soft block, with frames at its ends."""
    ends = {name: frame_at(bodies.face(BLOCK, 0, end), axes=axes) for name, end in (("frame_a", 0), ("frame_b", -1))}
    return reduce_body(M, K / 1e3, BLOCK, frames=ends, hold=hold, modes=4)


class Plain(Model):
    """A block on a hinge about an oblique axis, with a body at its end; rotations stand between frames."""

    hold: str = ac.structural("reference frame", default="frame_a", cls=str)
    world = World(n=(0, 0, -1))
    hinge = Revolute(n=(0, 0, 1), phi=fixed(0.2), w=fixed(3))
    there, back = FixedRotation(n=AXIS, angle=-ANGLE), FixedRotation(n=AXIS, angle=ANGLE)
    end = Body(m=2.0, r_CM=(0.1, 0.05, -0.02), I=np.diag([0.01, 0.02, 0.03]))

    @ac.part
    def rod(self):
        return FEBody(reduced=block_of(None, self.hold))

    def connections(self):
        yield chain(self.world, self.hinge, self.there, self.rod, self.back, self.end.frame_a)


class Turned(Plain):
    """The same with frames that have these axes."""

    @ac.part
    def rod(self):
        return FEBody(reduced=block_of(AXES, self.hold))

    there = back = None

    def connections(self):
        yield chain(self.world, self.hinge, self.rod, self.end.frame_a)


@pytest.mark.parametrize("hold", ["frame_a", "frame_b", "mean-axis"])
def test_axes_are_those_of_a_rotation_between(hold: str) -> None:
    """The same motion as with rotations that stand between, and energy is conserved."""
    found, expected = (
        ac.simulate(model(hold=hold), stop_time=0.2, tolerance=1e-9, energy=True) for model in (Turned, Plain)
    )
    assert np.ptp(found["rod.q"], axis=0).max() > 1e-5
    for name in ("end.frame_a.r_0", "end.frame_a.R.T", "end.frame_a.f", "rod.q", "hinge.phi"):
        size = np.abs(expected[name]).max()
        np.testing.assert_allclose(found[name], expected[name], rtol=0, atol=2e-6 * size)
    assert abs(found.stats["energy_method"]) < 1e-6


def test_files_keep_axes(tmp_path) -> None:
    body = block_of(AXES, "mean-axis")
    body.save(tmp_path / "body.npz")
    assert ReducedBody.load(tmp_path / "body.npz") == body
    assert body != block_of(None, "mean-axis")
    write_sid(body, tmp_path / "body.sid")
    again = read_sid(tmp_path / "body.sid")
    for one, other in zip(again.interfaces, body.interfaces, strict=True):
        assert one.axes == pytest.approx(AXES, abs=1e-15)
        assert np.abs(one.rotation - other.rotation).max() < 1e-13 * np.abs(other.rotation).max()
