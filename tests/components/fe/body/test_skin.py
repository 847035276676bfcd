"""What bodies from finite elements look like: closed skins that deform as the nodes do."""

from __future__ import annotations

import pickle
from collections import Counter

import numpy as np
import pytest

import acausal as ac
from acausal import Model, chain, fixed, geometry
from components import Revolute, TwoFrames, World
from components.fe import FEBody, NodalField, NodalResult, box, reduce_body
from components.fe.body.skin import box_of_inertia, skin
from components.fe.elements.faces import FACES
from components.orientation import axis_rotation
from models import FEPlate
from models.fe_plate import plate
from tests.components.fe.body.test_recovery import rod, swung
from tests.shared import compiled

SIZE, COUNTS, STEEL = (0.3, 0.2, 0.1), (3, 2, 2), {"E": 2e11, "nu": 0.3, "rho": 7850.0}
# Wedges of the lower and the upper triangle of a brick, in the order of its corners.
HALVES = ((0, 1, 2, 4, 5, 6), (0, 2, 3, 4, 6, 7))


def field(places, cells) -> NodalField:
    return NodalField(places, np.zeros((len(places), 3, 0)), cells)


def meshes() -> dict[str, NodalField]:
    found = {}
    for kind in ("hex8", "hex20", "tet10"):
        *_, nodes = box(SIZE, COUNTS, kind, **STEEL)
        found[kind] = field(np.asarray(nodes), nodes.cells)
    places, bricks = found["hex8"].nodes, found["hex8"].cells["hexahedron"]
    wedges = bricks[:, HALVES].reshape(-1, 6)
    found["tetra"] = field(found["tet10"].nodes, {"tetra": found["tet10"].cells["tetra10"][:, :4]})
    # Corners in any order, so that neighbours name those of their common face in different ones.
    shuffled = np.random.default_rng(0).permuted(found["tetra"].cells["tetra"], axis=1)
    found["tetra in any order"] = field(found["tet10"].nodes, {"tetra": shuffled})
    found["wedge"] = field(places, {"wedge": wedges})
    found["wedge15"] = field(places, {"wedge15": np.hstack([wedges, np.zeros((len(wedges), 9), dtype=int)])})
    # Where both meet, one has a face of four corners, the other one as well: halves are cut across z.
    found["both"] = field(places, {"hexahedron": bricks[:6], "wedge": wedges[12:]})
    found["mirrored"] = field(places * (-1, 1, 1), {"hexahedron": bricks})
    found["with surfaces"] = field(places, {"hexahedron": bricks, "triangle": bricks[:, :3], "line": bricks[:, :2]})
    return found


@pytest.mark.parametrize("name", meshes())
def test_skin_is_closed_and_faces_outward(name):
    """Every edge has two triangles, one in each direction; the volume by the divergence theorem; the area of the box."""
    mesh = meshes()[name]
    nodes, triangles = skin(mesh)
    edges = Counter((a, b) for t in triangles.tolist() for a, b in zip(t, t[1:] + t[:1], strict=True))
    assert set(edges.values()) == {1}
    assert all((b, a) in edges for a, b in edges)
    a, b, c = (mesh.nodes[nodes][triangles[:, k]] for k in range(3))
    assert np.einsum("ij,ij->", a, np.cross(b, c)) / 6 == pytest.approx(np.prod(SIZE))
    x, y, z = SIZE
    assert np.linalg.norm(np.cross(b - a, c - a), axis=1).sum() / 2 == pytest.approx(2 * (x * y + y * z + z * x))
    inside = np.all((np.abs(mesh.nodes[nodes]) > 1e-9) & (np.abs(np.abs(mesh.nodes[nodes]) - SIZE) > 1e-9), axis=1)
    assert not inside.any()
    assert sorted(set(triangles.ravel().tolist())) == list(range(len(nodes)))


def test_kinds_of_solids_are_known():
    """Those that the readers of decks make; nodes of edges follow the corners."""
    assert FACES.keys() == {"tetra", "tetra10", "wedge", "wedge15", "hexahedron", "hexahedron20"}


def test_mesh_moves_as_the_nodes_do():
    """Vertices, with modes and coordinates, turned into the world, are the places of `NodalResult`."""
    result = swung()
    (shape,) = result.tree.rod.shapes()
    assert isinstance(shape, geometry.Mesh)
    local = shape.vertices + np.einsum("bki,tb->tki", shape.modes, result[shape.q])
    drawn = result[shape.pose.r][:, None] + np.einsum("tij,tki->tkj", result[shape.pose.T], local)
    nodes, _ = skin(rod().nodal)
    np.testing.assert_allclose(drawn, NodalResult(result, "rod", rod()).position(nodes.tolist()), atol=1e-15)
    assert np.abs(local - shape.vertices).max() > 1e-4


def test_mesh_of_the_plate():
    """The model shifts the nodes and keeps the elements; with fewer modes than the body has, the first ones."""
    tree = compiled(FEPlate, modes=6).tree
    (shape,) = tree.body.shapes()
    assert shape.modes.shape == (6, len(shape.vertices), 3)
    assert shape.vertices.max(axis=0) == pytest.approx((0.5, 0.025, 0.005))
    nodes, _ = skin(plate("hex20", 6).nodal)
    np.testing.assert_array_equal(shape.modes[3], plate("hex20", 6).nodal.modes[nodes][:, :, 3])


class Hinged(Model):
    """A rod on a hinge."""

    reduced = ac.structural("the body")
    modes = ac.structural("number of modes", default=3)
    world = World()
    hinge = Revolute(phi=fixed(0), w=fixed(1))

    @ac.part
    def rod(self):
        return FEBody(reduced=self.reduced, modes=self.modes, check_range=False)

    def connections(self):
        yield chain(self.world, self.hinge, self.rod.hinge)


def test_rigid_body_has_a_mesh_without_modes():
    (shape,) = ac.compile(Hinged(reduced=rod(), modes=0)).tree.rod.shapes()
    assert shape.modes is None
    assert shape.q is None
    assert len(shape.triangles) > 0


def test_saved_body_keeps_its_mesh(tmp_path):
    rod().save(tmp_path / "rod.npz")
    (shape,) = ac.compile(Hinged(reduced=str(tmp_path / "rod.npz"))).tree.rod.shapes()
    np.testing.assert_array_equal(shape.triangles, skin(rod().nodal)[1])


def without_nodes():
    return pickle.loads(pickle.dumps(rod()))


def without_elements():
    M, K, nodes = box((0.1, 0.015, 0.01), (8, 2, 1), "hex8", E=1e7, nu=0.49, rho=17333.0)
    return reduce_body(M, K, np.asarray(nodes), frames={"hinge": [0, 2, 4], "tip": [50]}, hold="hinge", modes=6)


@pytest.mark.parametrize("body", [without_nodes, without_elements])
def test_body_without_mesh_shows_its_frames_and_its_inertia(body):
    result = ac.simulate(Hinged(reduced=body()), stop_time=0.02, intervals=2)
    drawn, *points = result.tree.rod.shapes()
    assert isinstance(drawn, geometry.Box)
    assert sorted(drawn.size) == pytest.approx([0.01, 0.015, 0.1])
    for point, name in zip(points, ("hinge", "tip"), strict=True):
        assert isinstance(point, geometry.Sphere)
        np.testing.assert_array_equal(result[point.pose.r], result[f"rod.{name}.r_0"])


def test_box_of_inertia_is_a_box_that_lies_askew():
    turn = axis_rotation(np.array([1, 2, 2]) / 3, 0.7)
    M, K, nodes = box(SIZE, (2, 2, 2), "hex20", **STEEL)
    # Mass and stiffness of turned displacements, at turned nodes.
    body = reduce_body(
        *(turned(X, turn) for X in (M, K)), np.asarray(nodes) @ turn.T, frames={}, hold="mean-axis", modes=1
    )
    found = box_of_inertia(body, geometry.Pose((0, 0, 0), np.eye(3)))
    np.testing.assert_allclose(found.size, sorted(SIZE), rtol=1e-9)
    np.testing.assert_allclose(found.center, 0, atol=1e-12)
    # Edges, shortest first, are z, y, x of the box, in one sense or the other.
    np.testing.assert_allclose(np.abs(found.axes @ turn), np.eye(3)[::-1], atol=1e-9)


def turned(X, turn):
    from scipy.sparse import csr_array, kron

    T = kron(np.eye(X.shape[0] // 3), turn, format="csr")
    return csr_array(T @ X @ T.T)


class Mount(TwoFrames):
    """A part of the user's own around a body of finite elements."""

    body = FEBody(reduced=rod(), modes=2)

    def connections(self):
        yield ac.connect(self.frame_a, self.body.hinge)
        yield ac.connect(self.body.tip, self.frame_b)


def test_body_in_a_part_of_two_frames():
    class Held(Model):
        world, mount = World(), Mount()

        def connections(self):
            yield chain(self.world, self.mount)

    parts = list(ac.compile(Held()).tree.mount.shapes())
    assert [part._path for part in parts] == ["mount.body"]
