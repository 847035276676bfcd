"""What beams look like: their axis, its direction, their section, and what they are coloured by."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

import acausal as ac
from acausal import Model, connect, geometry, parameter, part, structural
from components import FlexibleBeam, SubstructuredBeam, World, WorldForce, WorldTorque
from components.beams.element import ACROSS, ALONG
from models import FlexiblePendulum, FreeVibration, SliderCrank
from tests.components.scenes.bodies import OnBeam, OnSubstructuredBeam
from tests.components.scenes.scene import RUBBER, Scene
from tests.shared import compiled

# Length, mass per length and bending stiffness are 1.
UNIT = {"length": 1.0, "E": 1e4, "rho": 1.0, "A": 1.0, "J": 1e-4, "torsional_inertia": 1e-6, "check_range": False}


class Cantilever(Model):
    """A beam at rest under loads at its tip, which is turned in the world so that no axis is special."""

    kind: Any = structural("values of the beam", default=())
    f_x = parameter("axial force at the tip", unit="N", default=0)
    f_y = parameter("transverse force at the tip", unit="N", default=0)
    m_z = parameter("torque at the tip", unit="N.m", default=0)
    world = World(gravity=None)

    @part
    def beam(self):
        values = UNIT | {"initial": "static"} | dict(self.kind)
        return SubstructuredBeam(**values) if "volumes" in values else FlexibleBeam(**values)

    @part
    def force(self):
        return WorldForce(force=(self.f_x, self.f_y, 0))

    @part
    def torque(self):
        return WorldTorque(torque=(0, 0, self.m_z))

    def connections(self):
        yield connect(self.world.frame_b, self.beam.frame_a)
        yield connect(self.beam.frame_b, self.force.frame_b)
        yield connect(self.beam.frame_b, self.torque.frame_b)


def at_rest(loads: dict[str, float], **kind: Any) -> ac.Result:
    model = compiled(Cantilever, kind=tuple(kind.items()), **loads)
    return ac.simulate(model, stop_time=1e-6, intervals=1)


def curve_of(result: ac.Result, beam: Any = None) -> geometry.Curve:
    (curve,) = (result.tree.beam if beam is None else beam).shapes()
    return curve


def value_of(result: ac.Result, name: str) -> Any:
    (values,) = (v for v in curve_of(result).values if v.name == name)
    return values.entries() if callable(values.entries) else values.entries


def drawn(result: ac.Result, parts: int, row: int = 0) -> np.ndarray:
    """Points of the drawn axis, cubic between its nodes: `parts` for each element, and the last node."""
    curve = curve_of(result)
    r, d = result[curve.points][row], result[curve.tangents][row]
    found = []
    for k in range(len(r) - 1):
        for x in np.arange(parts) / parts:
            h = (1 - x) ** 2 * (1 + 2 * x), (1 - x) ** 2 * x, x * x * (3 - 2 * x), x * x * (x - 1)
            found.append(h[0] * r[k] + h[1] * d[k] + h[2] * r[k + 1] + h[3] * d[k + 1])
    return np.array([*found, r[-1]])


SPINNING = {
    "one frame": lambda: OnBeam(),
    "chain": lambda: OnSubstructuredBeam(),
    "turned": lambda: OnBeam(moved=True, turned=True),
}


@pytest.mark.filterwarnings("ignore:.*linear frames:acausal.AcausalWarning")
@pytest.mark.parametrize("name", SPINNING)
def test_curve_goes_through_the_nodes(name):
    result = ac.simulate(SPINNING[name](), stop_time=0.2, intervals=5)
    curve = curve_of(result, result.tree.it)
    points, tangents = result[curve.points], result[curve.tangents]
    np.testing.assert_array_equal(points, result["it.node_r_0"])
    np.testing.assert_allclose(points[:, 0], result["it.frame_a.r_0"], atol=1e-14)
    np.testing.assert_allclose(points[:, -1], result["it.frame_b.r_0"], atol=1e-14)
    # Linear frames: the slope of the axis is the angle of the section, its tangent counts up to third order.
    slopes = np.abs(result["it.node_deflection"][:, :, 3:]).max()
    assert 0.01 < slopes < 0.5
    for k, frame in ((0, "a"), (-1, "b")):
        x_axis = result[f"it.frame_{frame}.R.T"][:, 0]
        off = np.cross(tangents[:, k], x_axis) / np.linalg.norm(tangents[:, k], axis=1)[:, None]
        assert np.abs(off).max() < slopes**3
        np.testing.assert_allclose(result[curve.up][:, k], result[f"it.frame_{frame}.R.T"][:, 2], atol=1e-14)


class Free(Scene):
    """A beam of three elements on a spherical joint, in every reference frame."""

    reference = structural("reference frame of the beam", default="tangent")

    @part
    def it(self):
        return FlexibleBeam(**(RUBBER | {"elements": 3, "reference": self.reference, "check_range": False}))

    joint = OnBeam.joint

    def graph(self):
        yield from self.path(self.joint, self.it)


@pytest.mark.parametrize("reference", ["tangent", "pinned"])
def test_tangents_are_those_of_the_shape_functions(reference):
    """Derivatives of the polynomials of an element, in the axes of the reference frame, turned into the world by the result."""
    result = ac.simulate(Free(reference=reference), stop_time=0.2, intervals=5)
    tangents = result[curve_of(result, result.tree.it).tangents]
    frame, l = "it.frame_a" if reference == "tangent" else "it.chord", RUBBER["length"] / 3
    local = np.einsum("tij,tkj->tki", result[f"{frame}.R.T"], tangents)
    u, v, w, phi, w_turn, v_turn = np.moveaxis(result["it.node_deflection"], 2, 0)
    assert min(np.abs(x).max() for x in (u, v, w, phi)) > 1e-4
    across = [np.stack([x, l * slope], axis=2) for x, slope in ((v, v_turn), (w, -w_turn))]
    for k in range(4):
        sides = []
        for element, xi in ((k - 1, 1), (k, 0)):
            if 0 <= element < 3:
                slopes = [np.array([s.deriv()(xi) for s in row]) for row in (ALONG, ACROSS)]
                own = [x[:, element : element + 2].reshape(len(x), -1) @ slopes[1] for x in across]
                sides.append(np.stack([l + u[:, element : element + 2] @ slopes[0], *own], axis=1))
        expected = np.mean(sides, axis=0)
        np.testing.assert_allclose(local[:, k], expected, atol=1e-13)


@pytest.mark.parametrize("second_order", [False, True])
def test_tangents_are_differences_of_a_finer_beam(second_order):
    """Of 64 elements, whose chords between neighbours give the direction at their middle, to second order of 1/64."""
    loads = {"f_y": 0.3, "m_z": 0.1}
    more = {"geometric_stiffness": second_order}
    fine, coarse = at_rest(loads, elements=64, **more), at_rest(loads, elements=4, **more)
    r = fine["beam.node_r_0"][0]
    expected = np.gradient(r, 1 / 64, axis=0, edge_order=2)[::16] / 4
    found = coarse[curve_of(coarse).tangents][0]
    np.testing.assert_allclose(found, expected, atol=1e-3 if second_order else 1e-4)
    assert np.abs(found[:, 1]).max() > 0.02


def test_one_element_has_the_exact_axis_under_a_load_at_its_tip():
    """v = F x^2 (3 L - x) / 6 EJ is a cubic: where a finer beam has its nodes, the tube of one element goes through them."""
    few, many = at_rest({"f_y": 0.3}, elements=1), at_rest({"f_y": 0.3}, elements=8)
    np.testing.assert_allclose(drawn(few, 8), many["beam.node_r_0"][0], atol=1e-9)
    x = np.arange(9) / 8
    np.testing.assert_allclose(drawn(few, 8)[:, 1], 0.3 * x**2 * (3 - x) / 6, atol=1e-9)


def bent(angle: float, **kind: int) -> ac.Result:
    return at_rest({"m_z": angle}, geometric_stiffness=True, axial="none", **kind)


def test_axis_converges_to_the_arc_of_a_bent_beam():
    """A torque at the tip bends it into an arc of radius EJ / M; the tube is as near to that as the nodes are."""
    errors = []
    for n in (2, 4, 8):
        s = np.arange(4 * n + 1) / (4 * n)
        off = np.abs(drawn(bent(1.0, volumes=n), 4) - np.stack([np.sin(s), 1 - np.cos(s), 0 * s], axis=1))
        assert off.max() < 1.01 * off[::4].max()
        errors.append(off.max())
    assert errors[-1] < 2e-5
    assert np.log2(np.array(errors[:-1]) / errors[1:]).min() > 3.5


@pytest.mark.slow
def test_axis_of_second_order_converges_to_that_of_a_finer_beam():
    """Across the beam with the fourth power; along it as its nodes do, whose shortening has its own error."""
    fine = bent(0.2, elements=64)["beam.node_r_0"][0]
    off = [np.abs(drawn(bent(0.2, elements=n), 8) - fine[:: 8 // n]) for n in (1, 2, 4)]
    assert all(error[:, 0].max() < 1.01 * error[::8, 0].max() for error in off)
    across = np.array([error[:, 1].max() for error in off])
    assert across[-1] < 1e-7
    assert np.log2(across[:-1] / across[1:]).min() > 3.5


@pytest.mark.parametrize("kind", [{"elements": 4}, {"volumes": 2, "elements_per_volume": 2}])
def test_values_along_a_cantilever(kind):
    """Moment of the tip force about each node, positive where it bends towards +y; tension; F x^2 (3 L - x) / 6 EJ."""
    result = at_rest({"f_x": 1e-3, "f_y": 2e-3}, **kind)
    values = {v.name: v for v in curve_of(result).values}
    assert [(v.name, v.unit) for v in values.values()] == [
        ("bending moment", "N.m"),
        ("bending moment y", "N.m"),
        ("torque", "N.m"),
        ("axial force", "N"),
        ("deflection", "m"),
        ("deflection z", "m"),
    ]
    x, arm = np.arange(5) / 4, result["beam.frame_b.r_0"][0] - result["beam.node_r_0"][0]
    asked = {name: v.entries() if callable(v.entries) else v.entries for name, v in values.items()}
    moment, _, _, force, deflection, _ = (result[entries][0] for entries in asked.values())
    assert all(not np.any(result[asked[name]]) for name in ("bending moment y", "torque", "deflection z"))
    np.testing.assert_allclose(moment, np.cross(arm, (1e-3, 2e-3, 0))[:, 2], atol=1e-12)
    np.testing.assert_allclose(moment, 2e-3 * (1 - x), atol=1e-3 * 2e-3)
    slope = 2e-3 * (2 * x - x**2) / 2
    np.testing.assert_allclose(force, 1e-3 + 2e-3 * slope, rtol=2e-3 * slope[-1])
    np.testing.assert_allclose(deflection, 2e-3 * x**2 * (3 - x) / 6, rtol=1e-3)


def test_axial_force_is_along_the_deflected_axis():
    """Of a beam bent by a torque, a tip force along x has the part cos(angle) across each section."""
    result = at_rest({"f_x": 0.5, "m_z": 0.3}, elements=4)
    angle = result["beam.node_deflection"][0, :, 5]
    force = result[value_of(result, "axial force")][0]
    np.testing.assert_allclose(force, 0.5 * np.cos(angle), rtol=1e-9)
    assert angle[-1] > 0.1


def test_loads_are_built_only_where_they_are_asked_for(monkeypatch):
    """They cost most; deflections cost little, and can be chosen in every page."""
    result = at_rest({"f_y": 1.0}, elements=2)
    for name in ("node_moment", "node_force"):
        monkeypatch.setattr(vars(FlexibleBeam)[name], "compute", lambda beam: 1 / 0)
    curve = curve_of(result)
    assert np.isfinite(result[curve.tangents]).all()
    for values in curve.values[:4]:
        with pytest.raises(ZeroDivisionError):
            values.entries()


def test_section_is_the_ellipse_of_the_moments_of_area():
    """Of a round bar of radius 0.02 the circle; of another one A a^2 / 4 and A b^2 / 4 are the moments."""
    A, J = np.pi * 0.02**2, np.pi * 0.02**4 / 4
    result = at_rest({}, A=A, J=J)
    np.testing.assert_allclose(result[curve_of(result).section][0], 0.02)
    result = at_rest({}, A=A, J=J, J_y=4 * J)
    np.testing.assert_allclose(result[curve_of(result).section][0], [0.02, 0.04])


@pytest.mark.parametrize("volumes", [1, 2])
def test_deformation_is_measured_from_the_chord_in_a_loop(volumes):
    tree = compiled(SliderCrank, rod_volumes=volumes).tree
    assert all(next(iter(bar.shapes())).rest is None for bar in (tree.crank_bar, tree.rod_bar))


@pytest.mark.filterwarnings("ignore:.*linear frames:acausal.AcausalWarning")
@pytest.mark.parametrize(
    "make",
    [
        lambda: compiled(FreeVibration),
        lambda: compiled(FlexiblePendulum, formulation="substructured"),
        lambda: compiled(FlexiblePendulum, reference="pinned"),
        lambda: compiled(FlexiblePendulum),
    ],
)
def test_deformation_is_measured_from_the_root_elsewhere(make):
    """Where it is undeformed, the beam is on its points at rest; its root stays on them."""
    result = ac.simulate(make(), stop_time=0.1, intervals=2)
    curve = curve_of(result)
    assert curve.rest is not None
    rest = np.einsum("tij,tki->tkj", result[curve.rest.T], result[curve.rest_points]) + result[curve.rest.r][:, None]
    points, length = result[curve.points], result["beam.length"][0]
    np.testing.assert_allclose(points[:, 0], rest[:, 0], atol=1e-12 * length)
    # The root section keeps its direction: what is near it deflects with the square of the distance.
    away = np.linalg.norm(points - rest, axis=2)[-1]
    assert 0 < away[1] < 0.5 * away[-1]
    if "pendulum" in result.title.lower():
        np.testing.assert_allclose(points[0], rest[0], atol=1e-12 * length)


class Held(Model):
    """A heavy beam that is clamped at one of its ends, and moves."""

    end: str = structural("what is clamped", default="frame_b")
    reference: str = structural("reference frame", default="tangent")
    volumes: int = structural("volumes", default=0)
    world = World(g=0.3)

    @part
    def beam(self):
        values = UNIT | {"reference": self.reference}
        return SubstructuredBeam(**values, volumes=self.volumes) if self.volumes else FlexibleBeam(**values, elements=3)

    def connections(self):
        yield connect(self.world.frame_b, getattr(self.beam, self.end))


@pytest.mark.parametrize("volumes", [0, 3])
@pytest.mark.parametrize("reference", ["tangent", "pinned"])
@pytest.mark.parametrize("end", ["frame_a", "frame_b"])
def test_deformation_is_measured_from_the_end_that_is_held(end, reference, volumes):
    """Clamped, this end stands still on the place and along the tangent of the beam at rest, and the other one moves."""
    result = ac.simulate(Held(end=end, reference=reference, volumes=volumes), stop_time=0.5, intervals=4)
    curve, sense = curve_of(result), 1 if end == "frame_a" else -1
    rest = np.einsum("tij,tki->tkj", result[curve.rest.T], result[curve.rest_points]) + result[curve.rest.r][:, None]
    x = np.arange(4) / 3
    expected = np.stack([x if end == "frame_a" else x - 1, 0 * x, 0 * x], axis=1)
    np.testing.assert_allclose(rest, np.broadcast_to(expected, rest.shape), atol=1e-9)
    off = np.linalg.norm(result[curve.points] - rest, axis=2)[-1, ::sense]
    assert off[0] < 1e-9
    assert off[-1] > 1e-3
