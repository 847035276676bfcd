"""Pictures of beams in space: the direction and the size of their sections, and the values along them."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

import acausal as ac
from acausal import Model, Vector3, chain, connect, geometry, parameter, part, structural
from components import Circle, Rectangle, Section, Tube, World, WorldForce, WorldTorque
from tests.components.beams_in_space.scenes import beam_of

TURN = 0.7  # angle of pre-twist at the tip, rad


def blade(s: float) -> Rectangle:
    return Rectangle(0.06 - 0.02 * s, 0.02 - 0.01 * s, angle=TURN * s)


class Loaded(Model):
    """A clamped beam with a force and a torque at its tip, both resolved in the world."""

    kind: dict = structural("values of the beam", default=None)
    force: Vector3 = parameter("force at the tip", unit="N", default=(0, 0, 0))
    torque: Vector3 = parameter("torque at the tip", unit="N.m", default=(0, 0, 0))
    world = World()
    push, turn = WorldForce(force=force), WorldTorque(torque=torque)

    @part
    def beam(self):
        return beam_of(**{"length": 1.0, "E": 2e9, "rho": 1500.0, "check_range": False} | self.kind)

    def connections(self):
        yield chain(self.world, self.beam, self.push.frame_b)
        yield connect(self.turn.frame_b, self.beam.frame_b)


def ran(time: float = 1e-6, **kind: Any) -> ac.Result:
    loads = {"force": (3.0, 4.0, -5.0), "torque": (3.0, 1.0, -1.0)}
    return ac.simulate(Loaded(kind=kind, **loads), stop_time=time, intervals=2)


def curve_of(result: ac.Result) -> geometry.Curve:
    (curve,) = result.tree.beam.shapes()
    return curve


def values_of(result: ac.Result) -> dict[str, np.ndarray]:
    found = {v.name: v.entries for v in curve_of(result).values}
    return {name: result[entries() if callable(entries) else entries] for name, entries in found.items()}


KINDS = {
    "one frame": {"elements": 4},
    "second order": {"elements": 4, "geometric_stiffness": True},
    "chord": {"elements": 4, "reference": "pinned"},
    "chain": {"volumes": 2, "elements_per_volume": 2, "geometric_stiffness": True},
}


@pytest.mark.parametrize("name", KINDS)
def test_sections_turn_with_the_end_frames_and_by_the_pre_twist(name):
    result = ran(initial="static", section=blade, **KINDS[name])
    assert result["beam.node_deflection"][0, -1, 3] > 0.05
    z_axes = result[curve_of(result).up]
    for frame, k, angle in (("frame_a", 0, 0.0), ("frame_b", -1, TURN)):
        T = result[f"beam.{frame}.R.T"]
        expected = np.cos(angle) * T[:, 2] - np.sin(angle) * T[:, 1]
        np.testing.assert_allclose(z_axes[:, k], expected, atol=1e-12)


def test_sections_between_the_ends_turn_linearly_under_a_torque():
    """By M x / G J_t, and by the angle of a section that is turned everywhere."""
    section = Rectangle(0.06, 0.02, angle=0.3)
    kind = {"initial": "static", "elements": 5, "section": section, "weight": False}
    result = ac.simulate(Loaded(kind=kind, torque=(10.0, 0, 0)), stop_time=1e-6, intervals=1)
    angle = 0.3 + 10 * np.arange(6) / 5 / (2e9 / 2.6 * section.J_t)
    expected = np.stack([0 * angle, -np.sin(angle), np.cos(angle)], axis=1)
    np.testing.assert_allclose(result[curve_of(result).up][0], expected, atol=1e-9)
    assert angle[-1] > 0.4


@pytest.mark.parametrize("kind", [KINDS["one frame"], KINDS["chain"]])
def test_a_tapered_beam_has_its_half_axes_at_the_nodes(kind):
    curve = curve_of(result := ran(section=blade, **kind))
    x = np.arange(5) / 4
    np.testing.assert_allclose(result[curve.section][0], np.stack([0.03 - 0.01 * x, 0.01 - 0.005 * x], axis=1))
    assert curve.profile == "rectangle"


STIFF = Section(EA=1e6, EJ_y=25.0, EJ_z=100.0, GJ_t=50.0, mass=1.0, I_y=1e-4, I_z=1e-4)


@pytest.mark.parametrize(
    ("section", "half_axes", "profile"),
    [
        (Circle(0.04), (0.02, 0.02), "ellipse"),
        (Tube(0.04, 0.03), (0.02, 0.02), "ellipse"),
        (Rectangle(0.04, 0.01), (0.02, 0.005), "rectangle"),
        (STIFF, (0.02, 0.01), "ellipse"),  # A a^2 / 4 is the second moment of an ellipse
    ],
)
def test_sections_have_their_outline(section, half_axes, profile):
    curve = curve_of(result := ran(section=section))
    np.testing.assert_allclose(result[curve.section][0], half_axes)
    assert curve.profile == profile


@pytest.mark.parametrize("name", KINDS)
def test_values_at_the_ends_are_the_reactions_and_the_loads(name):
    """Of a beam that vibrates in space, both resolved in the sections at the ends."""
    result = ran(0.1, section=blade, **KINDS[name])
    assert np.abs(result["beam.frame_b.R.T"][-1] - np.eye(3)).max() > 0.05
    values = values_of(result)
    assert list(values) == [
        "bending moment",
        "bending moment y",
        "torque",
        "axial force",
        "deflection",
        "deflection z",
    ]
    for frame, k, sign in (("frame_a", 0, -1), ("frame_b", -1, 1)):
        moment = np.stack([values[v][:, k] for v in ("torque", "bending moment y", "bending moment")], axis=1)
        np.testing.assert_allclose(moment, sign * result[f"beam.{frame}.t"], rtol=1e-9, atol=1e-9)
        np.testing.assert_allclose(values["axial force"][:, k], sign * result[f"beam.{frame}.f"][:, 0], rtol=1e-9)
    tip = result["beam.frame_b.r_0"] - (1, 0, 0)
    found = np.stack([values["deflection"][:, -1], values["deflection z"][:, -1]], axis=1)
    if "chord" not in name:
        np.testing.assert_allclose(found, tip[:, 1:], atol=1e-12)
