"""Effects of beams: energy with every set of them, what each removes, and that off means gone."""

from __future__ import annotations

from collections.abc import Callable
from functools import partial
from typing import Any

import numpy as np
import pytest

import acausal as ac
from acausal import Model, chain, connect, fixed, part, sin, structural, time
from acausal.language.component import Component
from components import (
    Body,
    BodyShape,
    FlexibleBeam,
    Revolute,
    Spherical,
    SubstructuredBeam,
    World,
    WorldForce,
    rotational,
)
from tests.shared import pairwise

RUBBER = {"length": 1.0, "E": 1e7, "rho": 1000.0, "A": 1e-3, "J": 2e-7, "J_y": 3e-7, "torsional_inertia": 1e-2}
DAMPED = {"alpha": 0.5, "beta": 1e-3}
TIP_MASS = 0.3


def make(**kind: Any) -> FlexibleBeam | SubstructuredBeam:
    values = RUBBER | kind
    return SubstructuredBeam(**values) if "volumes" in values else FlexibleBeam(**values)


class Driven(Model):
    """A beam on a driven hinge, askew in gravity, with a body off its tip and a force."""

    bar: Component = structural("the beam", default=None)
    world, drive = World(), rotational.Torque(tau=2 * sin(5 * time))
    hinge = Revolute(n=(0, 1, 1), phi=fixed(0.3), w=fixed(4.0), use_axis_flange=True)
    load = WorldForce(force=(0.3 * sin(9 * time), 2 * sin(7 * time), 0.5))
    tip = Body(m=TIP_MASS, r_CM=(0.05, 0.02, 0.03), I=np.diag([2e-3, 3e-3, 4e-3]))

    @part
    def beam(self):
        return self.bar

    def connections(self):
        yield chain(self.world, self.hinge, self.beam, self.tip)
        yield connect(self.beam.frame_b, self.load.frame_b)
        yield connect(self.drive.flange, self.hinge.axis)


def driven(tolerance: float = 1e-8, **kind: Any) -> ac.Result:
    return ac.simulate(Driven(bar=make(**kind)), stop_time=0.3, tolerance=tolerance, intervals=6, energy=True)


EFFECTS = "axial", "bending", "torsion", "shear", "geometric_stiffness", "rotary_inertia", "reference"
CHOICES = pairwise(
    ("dynamic", "quasi_static", "none"),
    ("both", "xy", "xz", "none"),
    (True, False),
    (False, True),
    (False, True),
    (False, True),
    ("tangent", "pinned"),
)
SETS = [
    pytest.param(
        dict(zip(EFFECTS, choice.values, strict=True)), marks=choice.marks, id="-".join(map(str, choice.values))
    )
    for k, choice in enumerate(CHOICES)
    if not choice.marks or k % 9 == 0
]


@pytest.mark.parametrize("effects", SETS)
def test_power_balance(effects):
    balanced(elements=2, **effects)


@pytest.mark.parametrize("shear", [False, pytest.param(True, marks=pytest.mark.slow)])
@pytest.mark.parametrize("axial", [pytest.param("dynamic", marks=pytest.mark.slow), "quasi_static", "none"])
def test_power_balance_of_volumes(axial, shear):
    balanced(axial, "tangent", geometric_stiffness=True, rotary_inertia=True, shear=shear, volumes=2)


@pytest.mark.parametrize("effects", SETS)
def test_internal_forces_at_the_root(effects):
    """They are those of the frame; alpha would act on the root as well, which guides the reference frame."""
    at_root(driven(beta=1e-3, elements=2, **effects), 0, effects["reference"])


def at_root(result: ac.Result, volumes: int, reference: str) -> None:
    T_a, T = (result[f"{name}.R.T"] for name in ("beam.frame_a", root_frame(volumes, reference)))
    for cut, name in (("node_force", "f"), ("node_moment", "t")):
        expected = -np.einsum("kij,klj,kl->ki", T, T_a, result[f"beam.frame_a.{name}"])
        np.testing.assert_allclose(result[f"beam.{cut}"][:, 0], expected, atol=1e-7)


@pytest.mark.parametrize("axial", ["quasi_static", "none"])
def test_internal_forces_at_the_root_of_volumes(axial):
    kind = {"geometric_stiffness": True, "rotary_inertia": True, "volumes": 2}
    at_root(driven(axial=axial, beta=1e-3, **kind), 2, "tangent")


def balanced(axial: str, reference: str, **kind: Any) -> None:
    result = driven(axial=axial, reference=reference, **DAMPED, **kind)
    stats, missing = result.stats, result.stats["energy_method"]
    if axial == "quasi_static":
        unpaid = lifting(result, kind.get("volumes", 0), reference)
        assert np.ptp(unpaid) > 1e-5
        missing += unpaid[-1] - unpaid[0]
    assert abs(stats["energy_supplied"]) > 0.1
    bending, twists = kind.get("bending", "both"), kind.get("torsion", True)
    if bending != "none" or twists or axial == "dynamic":
        assert stats["energy_dissipated"] > (1e-3 if bending != "none" else 1e-8)
    moved = np.abs(result["beam.node_deflection"]).max(axis=(0, 1))
    assert (moved[1] > 0.05) == (bending in ("both", "xy"))
    assert (moved[2] > 0.01) == (bending in ("both", "xz"))
    if not kind.get("volumes"):
        assert (moved[3] > 0.01) == twists
    assert abs(missing) < 4e-6 * (abs(stats["energy_supplied"]) + abs(stats["energy_stored_change"]))


def root_frame(volumes: int, reference: str) -> str:
    """Reference frame at the root."""
    return ("beam.volume[0]." if volumes else "beam.") + ("chord" if reference == "pinned" else "frame_a")


def lifting(result: ac.Result, volumes: int, reference: str) -> np.ndarray:
    """Energy in J by which stretch lifts what lies beyond: no velocity knows of that stretch, so nothing pays for it."""
    EA, energy = RUBBER["E"] * RUBBER["A"], np.zeros(result.time.size)
    for k in range(volumes or 1):
        name = f"beam.volume[{k}]" if volumes else "beam"
        mean = result[f"{name}.tension"].mean(axis=1)
        upwards = result[f"{name}.{'chord' if reference == 'pinned' else 'frame_a'}.R.T"][:, 0, 1]
        beyond = TIP_MASS + (1 - (k + 1) / (volumes or 1)) * RUBBER["rho"] * RUBBER["A"]
        energy += 9.80665 * beyond * mean * result[f"{name}.length"] / EA * upwards
    return energy


@pytest.mark.parametrize("geometric_stiffness", [False, pytest.param(True, marks=pytest.mark.slow)])
def test_quasi_static_stretch_moves_nothing_else(geometric_stiffness):
    kind = {"elements": 2, "geometric_stiffness": geometric_stiffness}
    stretched, rigid = driven(axial="quasi_static", **kind), driven(axial="none", **kind)
    for name in ("beam.q", "hinge.phi", "tip.v_0"):
        np.testing.assert_allclose(stretched[name], rigid[name], atol=1e-6)
    shift = stretched["tip.r_0"] - rigid["tip.r_0"]
    lengths = stretched["beam.tension"].sum(axis=1) * 0.5 / (RUBBER["E"] * RUBBER["A"])
    axis = stretched["beam.frame_a.R.T"][:, 0]
    np.testing.assert_allclose(shift, lengths[:, None] * axis, atol=1e-6)
    assert np.abs(lengths).max() > 5e-4


@pytest.mark.parametrize("geometric_stiffness", [pytest.param(False, marks=pytest.mark.slow), True])
def test_stretch_with_its_vibrations_tends_to_none(geometric_stiffness):
    """With ten times the stiffness along alone, the tip is ten times as near to that of a beam that does not stretch."""
    kind, distances = {"elements": 2, "geometric_stiffness": geometric_stiffness, "beta": 1e-3}, []
    for factor in (10, 100):
        stiff = {"E": 1e7 * factor, "J": 2e-7 / factor, "J_y": 3e-7 / factor}
        near, rigid = (driven(axial=axial, **kind, **stiff) for axial in ("dynamic", "none"))
        distances.append(np.abs(near["tip.r_0"] - rigid["tip.r_0"]).max())
    assert distances[0] < 1e-3
    assert distances[0] / distances[1] == pytest.approx(10, rel=0.2)


class Swing(Model):
    """A bar on a spherical joint with a body off its tip, tumbling in gravity."""

    bar: Component = structural("the bar", default=None)
    world, joint = World(), Spherical(angles_fixed=True, w_rel_a=fixed((2.0, 1.0, 3.0)))
    tip = Body(m=0.5, r_CM=(0.1, 0.05, 0.02), I=np.diag([0.02, 0.03, 0.04]))

    @part
    def beam(self):
        return self.bar

    def connections(self):
        yield chain(self.world, self.joint, self.beam, self.tip)


@pytest.mark.parametrize("rotary_inertia", [False, True])
def test_without_bending_torsion_and_stretch_it_is_the_rigid_bar(rotary_inertia):
    kind = {"elements": 3, "axial": "none", "bending": "none", "torsion": False, "geometric_stiffness": True}
    sections = rotary_inertia * RUBBER["rho"] * RUBBER["length"] * np.array([0, RUBBER["J_y"], RUBBER["J"]])
    inertia = np.diag(sections + np.array([RUBBER["torsional_inertia"], 1 / 12, 1 / 12]))
    body = BodyShape(r=(1.0, 0, 0), m=1.0, r_CM=(0.5, 0, 0), I=inertia)
    beam, rigid = (ac.compile(Swing(bar=bar)) for bar in (make(rotary_inertia=rotary_inertia, **kind), body))
    assert beam.report["states"] == rigid.report["states"]
    assert beam.report["equations_reduced"] == rigid.report["equations_reduced"]
    one, other = (ac.simulate(c, stop_time=1.0, tolerance=1e-10, intervals=20) for c in (beam, rigid))
    assert np.ptp(other["tip.r_0"], axis=0).min() > 0.5
    for name in ("tip.r_0", "tip.v_0", "tip.frame_a.R.T"):
        np.testing.assert_allclose(one[name], other[name], atol=1e-9)


class Pendulum(Model):
    """A beam on a hinge in gravity."""

    gravity = structural("kind of gravity", default="uniform")
    bar: Component = structural("the beam", default=None)
    world, hinge = World(gravity=gravity), Revolute(phi=fixed(0.0), w=fixed(0.0))

    @part
    def beam(self):
        return self.bar

    def connections(self):
        yield chain(self.world, self.hinge, self.beam)


def counts(scene: Callable[..., Model] = Pendulum, **kind: Any) -> dict[str, int]:
    """Equations, states and operations of a damped beam of four elements on a hinge in gravity."""
    report = ac.compile(scene(bar=make(**{"elements": 4} | DAMPED | kind))).report
    names = ("equations_flat", "equations_reduced", "operations", "jacobian_nonzeros")
    return {name: report[name] for name in names} | {"states": len(report["states"])}


@pytest.mark.parametrize(
    ("on", "off", "fewer"),
    [
        ({"axial": "dynamic"}, {"axial": "quasi_static"}, ("states", "equations_reduced", "operations")),
        ({"axial": "quasi_static"}, {"axial": "none"}, ("equations_flat",)),
        ({"bending": "both"}, {"bending": "xy"}, ("equations_flat",)),  # what stays zero leaves by itself
        ({"bending": "xy"}, {"bending": "none"}, ("equations_flat", "states", "equations_reduced", "operations")),
        ({"torsion": True}, {"torsion": False}, ("equations_flat",)),
        ({"shear": True}, {"shear": False}, ("operations",)),
        ({"rotary_inertia": True}, {"rotary_inertia": False}, ("operations",)),
        ({"centrifugal": True}, {"centrifugal": False}, ("operations",)),
        ({"coriolis": True}, {"coriolis": False}, ("operations",)),
        ({"geometric_stiffness": True}, {"geometric_stiffness": False}, ("operations",)),
        (
            {"geometric_stiffness": True, "axial": "none"},
            {"geometric_stiffness": False, "axial": "none"},
            ("equations_flat", "operations"),
        ),
        ({"damping": True}, {"damping": False}, ("operations",)),
        ({"weight": True}, {"weight": False}, ("operations",)),
    ],
)
def test_an_effect_that_is_off_leaves_less(on, off, fewer):
    before, after = counts(**on), counts(**off)
    assert all(after[name] <= before[name] for name in before)
    assert all(after[name] < before[name] for name in fewer)


@pytest.mark.parametrize(
    ("on", "off"),
    [
        ({"bending": "both"}, {"bending": "xy"}),
        ({"bending": "both"}, {"bending": "xz"}),
        ({"bending": "xz"}, {"bending": "none"}),
        ({"torsion": True}, {"torsion": False}),
        ({"shear": True}, {"shear": False}),
        ({"rotary_inertia": True}, {"rotary_inertia": False}),
    ],
)
def test_an_effect_that_is_off_leaves_less_in_space(on, off):
    before, after = counts(scene=Swing, **{"elements": 2} | on), counts(scene=Swing, **{"elements": 2} | off)
    assert after["operations"] < before["operations"]
    if not on.keys() & {"shear", "rotary_inertia"}:
        assert all(after[name] < before[name] for name in before)


def test_damping_off_is_no_damping():
    assert counts(damping=False) == counts(alpha=0, beta=0)
    one, other = (driven(elements=2, damping=False, **DAMPED), driven(elements=2))
    np.testing.assert_array_equal(one["beam.q"], other["beam.q"])
    assert one.stats["energy_dissipated"] == 0


def test_weight_off_is_no_gravity():
    without = counts(partial(Pendulum, gravity=None))
    assert counts(weight=False) == without
    weightless = ac.simulate(Pendulum(bar=make(weight=False)), stop_time=0.5, intervals=5)
    np.testing.assert_array_equal(weightless["hinge.phi"], 0)
    heavy = ac.simulate(Pendulum(bar=make()), stop_time=0.5, intervals=5)
    assert heavy["hinge.phi"][-1] < -0.5


@pytest.mark.parametrize("effect", ["centrifugal", "coriolis"])
def test_forces_of_a_turning_frame_vanish_with_its_speed(effect):
    """A beam falls while its hub turns: the difference falls with the speed, and is 0 at rest."""

    class Falling(Model):
        bar: Component = structural("the beam", default=None)
        speed: ac.Scalar = ac.parameter("speed of the hub", unit="rad/s", default=1.0)
        world, hub = World(), Revolute(use_axis_flange=True)
        drive, tip = rotational.Position(phi_ref=speed * time), Body(m=TIP_MASS)

        @part
        def beam(self):
            return self.bar

        def connections(self):
            yield chain(self.world, self.hub, self.beam, self.tip)
            yield connect(self.drive.flange, self.hub.axis)

    kind: dict = {"elements": 2, "geometric_stiffness": True}
    models = [ac.compile(Falling(bar=make(**kind | effects))) for effects in ({}, {effect: False})]
    differences = []
    for speed in (0.0, 0.5, 1.0):
        how = {"parameters": {"speed": speed}, "stop_time": 0.2, "tolerance": 1e-9, "intervals": 5}
        full, without = (ac.simulate(model, **how) for model in models)
        differences.append(np.abs(full["beam.q"] - without["beam.q"]).max())
    assert differences[0] < 1e-9
    assert 1e-6 < differences[1] < 0.6 * differences[2]
