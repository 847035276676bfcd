"""Frames along a beam, against beams in series."""

from __future__ import annotations

import numpy as np
import pytest

import acausal as ac
from acausal import Model, chain, connect, fixed, part, structural
from components import Body, FlexibleBeam, Spherical, SubstructuredBeam, World, WorldForceAndTorque
from tests.components.beams_in_space.scenes import beam_of

RUBBER: dict = {"length": 1.0, "E": 4e5, "G": 1.6e5, "rho": 1e3, "A": 1e-3, "J": 2e-6, "J_y": 1e-6, "J_t": 1.5e-6}
BODY = {"m": 0.3, "r_CM": (0.02, 0.03, -0.01), "I": np.diag([2e-3, 3e-3, 4e-3])}


class Swing(Model):
    """A beam on a ball joint, with bodies on it and at its tip."""

    kind: dict = structural("values of the beam", default=None)
    world, joint = World(), Spherical(angles_fixed=True, w_rel_a=fixed((1.0, 1.0, 2.0)))
    first, second, tip = Body(**BODY), Body(m=0.2), Body(m=0.1)

    @part
    def beam(self):
        return beam_of(**RUBBER | {"frames_at": (0.25, 0.75)} | self.kind)

    def connections(self):
        yield chain(self.world, self.joint, self.beam, self.tip)
        yield connect(self.beam.frames_inner[0], self.first.frame_a)
        yield connect(self.beam.frames_inner[1], self.second.frame_a)


class InSeries(Model):
    """The same, of a volume for each part of the beam."""

    kind: dict = structural("values of the beams", default=None)
    world, joint = World(), Spherical(angles_fixed=True, w_rel_a=fixed((1.0, 1.0, 2.0)))
    first, second, tip = Body(**BODY), Body(m=0.2), Body(m=0.1)

    def _piece(self, volumes: int) -> SubstructuredBeam:
        return SubstructuredBeam(**RUBBER | {"length": volumes / 4, "volumes": volumes} | self.kind)

    @part
    def a(self):
        return self._piece(1)

    @part
    def b(self):
        return self._piece(2)

    @part
    def c(self):
        return self._piece(1)

    def connections(self):
        yield chain(self.world, self.joint, self.a, self.b, self.c, self.tip)
        yield connect(self.a.frame_b, self.first.frame_a)
        yield connect(self.b.frame_b, self.second.frame_a)


def run(model: Model) -> ac.Result:
    return ac.simulate(model, stop_time=0.2, intervals=4, tolerance=1e-9, energy=True)


@pytest.mark.parametrize("kind", [{}, {"geometric_stiffness": True, "rotary_inertia": True}])
def test_volumes_with_inner_frames_are_beams_in_series(kind):
    one, other = run(Swing(kind={"volumes": 4} | kind)), run(InSeries(kind=kind))
    for name in ("first.r_0", "second.r_0", "tip.r_0", "first.frame_a.R.T"):
        np.testing.assert_allclose(one[name], other[name], atol=1e-7)


@pytest.mark.parametrize(
    "kind",
    [
        {"elements": 4, "geometric_stiffness": True},
        {"elements": 4, "reference": "pinned", "geometric_stiffness": True},
        {"volumes": 2, "elements_per_volume": 2},
    ],
)
def test_power_balance_and_section_loads(kind):
    result = run(Swing(kind=kind))
    assert abs(result.stats["energy_stored_change"]) < 1e-6
    frame = {"tangent": "frame_a", "pinned": "chord"}[kind.get("reference", "tangent")]
    name = f"beam.volume[0].{frame}" if "volumes" in kind else f"beam.{frame}"
    T, T_a = result[f"{name}.R.T"], result["beam.frame_a.R.T"]
    for cut, flow in (("node_force", "f"), ("node_moment", "t")):
        expected = -np.einsum("kij,klj,kl->ki", T, T_a, result[f"beam.frame_a.{flow}"])
        np.testing.assert_allclose(result[f"beam.{cut}"][:, 0], expected, atol=1e-7)


def test_static_load_in_the_middle():
    """P a^2 (3 L - a) / 6 EJ at the tip of a cantilever."""

    class Cantilever(Model):
        world, load = World(gravity=None), WorldForceAndTorque(force=(0, 1e-3, 0), torque=(0, 0, 0))
        beam = FlexibleBeam(**RUBBER, elements=4, frames_at=(0.5,), initial="static")

        def connections(self):
            yield chain(self.world, self.beam)
            yield connect(self.load.frame_b, self.beam.frames_inner[0])

    result = ac.simulate(Cantilever(), stop_time=1e-3, intervals=1)
    EJ = RUBBER["E"] * RUBBER["J"]
    assert result["beam.frame_b.r_0"][0, 1] == pytest.approx(1e-3 * 0.25 * 2.5 / (6 * EJ), rel=1e-4)


def test_static_stretch_moves_inner_frames():
    """P x / EA at x."""

    class Bar(Model):
        world, load = World(gravity=None), WorldForceAndTorque(force=(1e-3, 0, 0), torque=(0, 0, 0))
        beam = FlexibleBeam(**RUBBER, elements=4, frames_at=(0.25, 0.5), axial="quasi_static", bending="none")

        def connections(self):
            yield chain(self.world, self.beam)
            yield connect(self.load.frame_b, self.beam.frame_b)

    result = ac.simulate(Bar(), stop_time=1e-3, intervals=1)
    EA = RUBBER["E"] * RUBBER["A"]
    for k, x in enumerate((0.25, 0.5)):
        assert result[f"beam.frames_inner[{k}].r_0"][0, 0] - x == pytest.approx(1e-3 * x / EA, rel=1e-6)


@pytest.mark.parametrize("kind", [{"elements": 1}, {"volumes": 1}, {"volumes": 1, "elements_per_volume": 2}])
def test_elements_are_split_for_inner_frames(kind):
    """0.25 and 0.75 need 4 elements."""
    finer = {next(iter(kind)): 4 // kind.get("elements_per_volume", 1)}
    one, other = run(Swing(kind=kind)), run(Swing(kind=kind | finer))
    assert one["beam.node_r_0"].shape[1] == 5
    for name in ("first.r_0", "tip.r_0", "beam.node_force"):
        np.testing.assert_array_equal(one[name], other[name])


@pytest.mark.parametrize(
    ("places", "text"), [((0.5, 1.0), "1.0, which is not between 0 and 1"), ((0.123, 0.5), "up to 100 elements")]
)
def test_places_without_nodes_are_refused(places, text):
    for kind in ({"elements": 4}, {"volumes": 4}):
        with pytest.raises(ac.DeclarationError, match=rf"beam \((Flexible|Substructured)Beam\), .*frames_at .*{text}"):
            ac.compile(Swing(kind=kind | {"frames_at": places}))
