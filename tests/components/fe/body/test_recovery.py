"""Motion and stresses at nodes: against the frames of the same run, derivatives in time, and statics."""

from __future__ import annotations

import pickle
from functools import cache
from pathlib import Path

import numpy as np
import pytest

import acausal as ac
from acausal import DeclarationError, Model, chain, fixed
from components import Revolute, World, WorldForce
from components.fe import FEBody, NodalResult, box, reduce_body
from components.fe.body.recovery import von_mises

RUBBER = {"E": 1e7, "nu": 0.49, "rho": 17333.0}
LOAD = 0.02


@cache
def rod():
    """A hinged rod, whose tip is also a node of the mesh."""
    M, K, nodes = box((0.1, 0.015, 0.01), (8, 2, 1), "hex8", **RUBBER)
    return reduce_body(M, K, nodes, frames={"hinge": [0, 2, 4], "tip": [50]}, hold="hinge", modes=6)


@cache
def swung():
    class Pendulum(Model):
        world = World(n=(0, 0, -1), g=9.81)
        hinge = Revolute(n=(0, 1, 0), phi=fixed(0.3), w=fixed(4))
        rod = FEBody(reduced=rod())

        def connections(self):
            yield chain(self.world.frame_b, self.hinge.frame_a)
            yield chain(self.hinge.frame_b, self.rod.hinge)

    return ac.simulate(Pendulum(), stop_time=0.1, tolerance=1e-9, intervals=200)


def test_motion_of_a_frame_and_of_its_node() -> None:
    result = swung()
    nodes = NodalResult(result, "rod", rod())
    T = result["rod.tip.R.T"]
    assert np.abs(nodes.position([50])[:, 0] - result["rod.tip.r_0"]).max() < 1e-14
    for found, level in ((nodes.velocity([50]), "v"), (nodes.acceleration([50]), "a")):
        in_world = np.einsum("tij,ti->tj", T, result[f"rod.tip.{level}"])
        assert np.abs(found[:, 0] - in_world).max() < 1e-12 * np.abs(in_world).max()
    assert nodes.position([3, 50]).shape == (201, 2, 3)
    assert np.abs(nodes.displacement([0, 2, 4])).max() < 1e-17  # held by the reference frame


def test_axes_and_derivatives() -> None:
    result = swung()
    nodes = NodalResult(result, "rod", rod())
    T = result["rod.hinge.R.T"]
    for name in ("displacement", "velocity", "acceleration"):
        body, world = (getattr(nodes, name)(axes=axes) for axes in ("body", "world"))
        assert np.abs(np.einsum("tij,tkj->tki", T, world) - body).max() < 1e-12 * np.abs(body).max()
    place = result["rod.hinge.r_0"][:, None] + np.einsum("tji,tkj->tki", T, nodes.position(axes="body"))
    assert np.abs(place - nodes.position()).max() < 1e-14
    t = nodes.time
    for lower, higher in (("position", "velocity"), ("velocity", "acceleration")):
        errors = []
        for every in (1, 2):  # of second order in the step
            rate = np.gradient(getattr(nodes, lower)()[::every], t[::every], axis=0)[2:-2]
            errors.append(np.abs(rate - getattr(nodes, higher)()[::every][2:-2]).max())
        assert errors[1] / errors[0] == pytest.approx(4, rel=0.4)


def test_fewer_modes_and_a_body_without_any() -> None:
    for modes in (2, 0):

        class Pendulum(Model):
            world = World(n=(0, 0, -1), g=9.81)
            hinge = Revolute(n=(0, 1, 0), phi=fixed(0), w=fixed(0))
            rod = FEBody(reduced=rod(), modes=modes)

            def connections(self):
                yield chain(self.world.frame_b, self.hinge.frame_a)
                yield chain(self.hinge.frame_b, self.rod.hinge)

        result = ac.simulate(Pendulum(), stop_time=0.05, intervals=5)
        nodes = NodalResult(result, "rod", rod())
        assert np.abs(nodes.position([50])[:, 0] - result["rod.tip.r_0"]).max() < 1e-14
        assert nodes.displacement().any() == bool(modes)


@cache
def bent():
    """A clamped beam under a force at its tip, at rest: static modes hold all of it."""
    M, K, nodes = box((0.2, 0.01, 0.02), (8, 1, 2), "hex20", E=2e11, nu=0.0, rho=7850)
    ends = {name: np.flatnonzero(np.isclose(nodes[:, 0], x)) for name, x in (("root", 0), ("tip", 0.2))}
    body = reduce_body(M, K, nodes, frames=ends, hold="root", modes=8, basis="craig-bampton")

    class Beam(Model):
        world = World(gravity=None)
        beam = FEBody(reduced=body, initial="static")
        force = WorldForce(force=(0, 0, -LOAD))

        def connections(self):
            yield chain(self.world.frame_b, self.beam.root)
            yield chain(self.beam.tip, self.force.frame_b)

    runs = [ac.simulate(Beam(), stop_time=1e-3, intervals=1, parameters={"beam.stiffness": k}) for k in (1, 3)]
    return runs, body


@pytest.mark.parametrize("run", [0, 1])
def test_stress_of_a_clamped_beam(run: int) -> None:
    """It does not depend on the factor of the stiffness, as the force does not."""
    runs, beam = bent()
    result = runs[run]
    nodes = NodalResult(result, "beam", beam)
    x, _, z = beam.nodal.nodes.T
    z = z - z.mean()
    stress = nodes.stress(E=2e11, nu=0.0, at="nodes")[0]
    inertia = 0.01 * 0.02**3 / 12
    expected = LOAD * (0.2 - x) * z / inertia  # above the middle it is stretched
    away = (x > 0.03) & (x < 0.17)
    assert np.abs(stress[away, 0] - expected[away]).max() < 0.01 * np.abs(expected).max()
    shear = nodes.stress(E=2e11, nu=0.0, at="elements")["hexahedron20"][0, :, 5].reshape(8, -1).mean(axis=1)
    assert shear[2:6] == pytest.approx(-LOAD / (0.01 * 0.02), rel=0.01)
    points = nodes.stress(E=2e11, nu=0.0)["hexahedron20"]
    assert points.shape == (2, 16, 8, 6)
    plain = von_mises(stress[away])
    assert (
        np.abs(plain[np.abs(z[away]) > 0.0099] - np.abs(expected[away][np.abs(z[away]) > 0.0099])).max()
        < 0.02 * plain.max()
    )


def test_files_for_paraview(tmp_path: Path) -> None:
    meshio = pytest.importorskip("meshio")
    nodes = NodalResult(swung(), "rod", rod())
    paths = nodes.write_vtu(tmp_path / "rod.vtu", every=50, E=RUBBER["E"], nu=RUBBER["nu"])
    assert [path.name for path in paths] == ["rod.pvd", *(f"rod-{k:04d}.vtu" for k in range(5))]
    text = paths[0].read_text()
    assert [f'timestep="{t:.17g}"' in text for t in nodes.time[::50]] == [True] * 5
    seen = meshio.read(paths[3])
    assert np.abs(seen.points - nodes.position()[100]).max() < 1e-14
    assert np.array_equal(seen.cells_dict["hexahedron"], rod().nodal.cells["hexahedron"])
    assert np.abs(seen.point_data["displacement"] - nodes.displacement(axes="world")[100]).max() < 1e-14
    assert np.abs(seen.point_data["velocity"] - nodes.velocity()[100]).max() < 1e-12
    stress = nodes.stress(E=RUBBER["E"], nu=RUBBER["nu"], at="nodes")[100]
    assert np.abs(seen.point_data["stress"] - stress).max() < 1e-9 * np.abs(stress).max()
    larger = meshio.read(nodes.write_vtu(tmp_path / "more.vtu", every=100, scale=10)[2])
    assert "stress" not in larger.point_data
    moved = nodes.position()[100] + 9 * nodes.displacement(axes="world")[100]
    assert np.abs(larger.points - moved).max() < 1e-14
    with pytest.raises(ac.ExportError, match="there is no directory"):
        nodes.write_vtu(tmp_path / "lost" / "rod.vtu")
    assert sorted(path.suffix for path in tmp_path.iterdir()) == [".pvd"] * 2 + [".vtu"] * 8


def test_without_elements(tmp_path: Path) -> None:
    meshio = pytest.importorskip("meshio")
    M, K, nodes = box((0.1, 0.015, 0.01), (8, 2, 1), "hex8", **RUBBER)
    bare = reduce_body(M, K, np.asarray(nodes), frames={"hinge": [0, 2, 4], "tip": [50]}, hold="hinge", modes=6)
    assert bare == rod()
    found = NodalResult(swung(), "rod", bare)
    with pytest.raises(DeclarationError, match="has no elements"):
        found.stress(E=1e7, nu=0.49)
    assert list(meshio.read(found.write_vtu(tmp_path / "a.vtu", every=200)[1]).cells_dict) == ["vertex"]


def test_from_the_file(tmp_path: Path) -> None:
    rod().save(tmp_path / "rod.npz")
    found = NodalResult(swung(), "rod", tmp_path / "rod.npz")
    assert np.array_equal(found.position(), NodalResult(swung(), "rod", rod()).position())
    assert found.stress(E=1e7, nu=0.49, at="nodes").shape == (201, 54, 6)
    rod().save(tmp_path / "bare.npz", nodal=False)
    for bare in (tmp_path / "bare.npz", pickle.loads(pickle.dumps(rod()))):
        with pytest.raises(DeclarationError, match="has no nodes"):
            NodalResult(swung(), "rod", bare)


def test_wrong_arguments() -> None:
    with pytest.raises(DeclarationError, match=r"the result has no FEBody `beam`"):
        NodalResult(swung(), "beam", rod())
    with pytest.raises(DeclarationError, match="differs from the reduced body: it has 6 modes, the reduced body 2"):
        NodalResult(swung(), "rod", rod().first(2))
    M, K, places = box((0.1, 0.015, 0.01), (8, 2, 1), "hex8", **RUBBER)
    frames = {"hinge": [0, 2, 4], "tip": [50]}
    for other in (
        reduce_body(M, 1.01 * K, places, frames=frames, hold="hinge", modes=6),
        reduce_body(M, K, places, frames=frames, hold=(2, 50, 0), modes=6),
        reduce_body(M, K, places, frames={**frames, "end": [48]}, hold="hinge", modes=6),
    ):
        with pytest.raises(DeclarationError, match="differs from the reduced body"):
            NodalResult(swung(), "rod", other)
    more = reduce_body(M, K, places, frames=frames, hold="hinge", modes=12)
    assert NodalResult(swung(), "rod", more).position().shape == (201, 54, 3)
    nodes = NodalResult(swung(), "rod", rod())
    for wrong in ([54], [-1], [0.5]):
        with pytest.raises(DeclarationError, match="nodes must be rows from 0 to 53"):
            nodes.velocity(wrong)
    with pytest.raises(DeclarationError, match='"world" or "body", not \'ref\''):
        nodes.velocity(axes="ref")
    with pytest.raises(DeclarationError, match="at must be"):
        nodes.stress(E=1e7, nu=0.3, at="corners")
    with pytest.raises(DeclarationError, match="both or neither of E and nu"):
        nodes.write_vtu("a.vtu", E=1e7)
