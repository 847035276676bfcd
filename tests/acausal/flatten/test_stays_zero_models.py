"""Unknowns that stay 0 for ever: closed loops, the linear system, the report, and the same results on all scenes."""

from __future__ import annotations

import copy
from functools import cache

import numpy as np
import pytest

import acausal as ac
import models
from acausal import Model, Scalar, chain, connect, fixed, guess, output
from acausal.compiler.report import compressed
from acausal.flatten.assembly import Assembly
from components import BodyRod, FixedTranslation, Revolute, World
from components.fe import FEBody, ReducedBody, box, reduce_body
from models import FEPendulum, FourBarSpatial, NFourBar, SimplePendulum, SpinUp
from tests.acausal.flatten.test_stays_zero import ACROSS, Arm, agree
from tests.shared import CONTRACT


@cache
def coupler() -> ReducedBody:
    """Return a soft bar that bends in both planes and twists, between two frames."""
    M, K, nodes = box((1.0, 0.03, 0.02), (4, 1, 1), "hex20", E=2e8, nu=0.3, rho=1000.0)
    ends = {name: [k for k, x in enumerate(nodes[:, 0]) if abs(x - at) < 1e-9] for name, at in (("a", 0), ("b", 1))}
    return reduce_body(M, K, nodes, frames=ends, hold="a", modes=6)


class Loop(Model):
    """A planar four-bar with an elastic coupler."""

    world = World(g=9.81)
    joint_1, joint_2 = Revolute(phi=fixed(1.2), w=fixed(0)), Revolute(phi=guess(-0.8))
    joint_3, joint_4 = Revolute(phi=guess(1.2)), Revolute(phi=guess(-1.6))
    crank, rocker, base = BodyRod(r=(0.4, 0, 0), m=1), BodyRod(r=(0.8, 0, 0), m=1), FixedTranslation(r=(1.0, 0, 0))
    bar = FEBody(reduced=coupler(), check_range=False)
    angle: Scalar = output("angle of the rocker", unit="rad")
    z: Scalar = output("position across", unit="m")

    def connections(self):
        yield chain(self.world, self.joint_1, self.crank, self.joint_2, self.bar.a)
        yield chain(self.bar.b, self.joint_3, self.rocker, self.joint_4, self.base.frame_b)
        yield connect(self.world.frame_b, self.base.frame_a)

    def equations(self):
        yield self.angle == self.joint_4.phi
        yield self.z == self.rocker.frame_a.r_0[2]


def test_an_elastic_coupler_between_rigid_links():
    """Its closures across depend on each other, so that the flows that work on them are not determined one by one."""
    assert agree(Loop(), members=(), stop_time=0.1, tolerance=1e-4).nx == 20


class TwoElastic(Loop):
    """The crank is elastic as well: the closures across are independent."""

    crank = FEBody(reduced=coupler(), check_range=False)

    def connections(self):
        yield chain(self.world, self.joint_1, self.crank.a)
        yield chain(self.crank.b, self.joint_2, self.bar.a)
        yield chain(self.bar.b, self.joint_3, self.rocker, self.joint_4, self.base.frame_b)
        yield connect(self.world.frame_b, self.base.frame_a)


def test_two_elastic_links_in_a_planar_loop():
    across = [f"{part}.{name}[{k}]" for part in ("crank", "bar") for name in ("q", "qd") for k in (0, 2, 4)]
    compiled = agree(TwoElastic(), members=tuple(across), stop_time=0.05, tolerance=1e-4)
    assert (compiled.nx, ac.compile(TwoElastic(), full=True).nx) == (20, 32)
    (loop,) = compiled.report["loops"]
    assert (loop["constraints"], loop["redundant"]) == (6, 3), "three closures hold, as nothing moves across"


def test_closures_that_vanish_are_used_and_not_redundant():
    """Their flows are determined: 0 = 0 would set these flows to 0 in place of equations that hold them."""
    spatial = ac.compile(FourBarSpatial())
    assert spatial.report["stays_zero"] == []
    result = ac.simulate(spatial, stop_time=0.2, tolerance=1e-8)
    full = ac.simulate(ac.compile(FourBarSpatial(), full=True), stop_time=0.2, tolerance=1e-8)
    np.testing.assert_allclose(result["j1_phi"], full["j1_phi"], atol=1e-7)


@pytest.mark.parametrize("scene", list(CONTRACT))
def test_scenes_give_the_same_results(scene: str):
    cls = next(c for c in vars(models).values() if isinstance(c, type) and _name(c) == scene.replace("-", ""))
    outputs, stop_time = CONTRACT[scene]
    reduced, full = ac.compile(cls()), ac.compile(cls(), full=True)
    if reduced.report["unknowns_at_zero"] == 0:
        assert reduced.states == full.states
        assert reduced.algebraic == full.algebraic
        return
    how = {"stop_time": min(stop_time, 0.3), "intervals": 10, "tolerance": 1e-8}
    small, large = (ac.simulate(m, **how) for m in (reduced, full))
    for name in outputs:
        size = max(np.abs(large[name]).max(), 1e-3)
        np.testing.assert_allclose(small[name], large[name], atol=1e-5 * size, err_msg=name)


def _name(cls: type) -> str:
    return cls.__name__.lower().removeprefix("flexible")


def test_linearize_has_all_unknowns():
    compiled, full = ac.compile(FEPendulum()), ac.compile(FEPendulum(), full=True)
    expected = ac.linearize(full)
    assert (compiled.nx, len(expected.states)) == (10, 20)
    for model in (compiled, FEPendulum()):
        found = ac.linearize(model)
        assert found.states == expected.states == full.states
        np.testing.assert_array_equal(found.A, expected.A)
    assert ac.linearize(compiled, parameters={"world.g": 5.0}).A.shape == (20, 20)


def test_the_full_system_is_compiled_once(monkeypatch: pytest.MonkeyPatch):
    compiled, plain = ac.compile(Arm()), ac.compile(SimplePendulum())
    ac.linearize(compiled, initial="guesses")
    made = len(compiled.memo)
    monkeypatch.setattr(Assembly, "flat_model", None)  # nothing is flattened any more
    ac.linearize(compiled, initial="guesses")
    ac.linearize(plain, initial="guesses")
    assert len(compiled.memo) == made


def test_a_model_without_its_source_is_linearised_as_it_is(tmp_path):
    ac.export_dae(ac.compile(Arm()), path := tmp_path / "arm.dae")
    loaded = ac.load_dae(path)
    assert loaded.report["stays_zero"] == list(ACROSS)
    assert ac.linearize(loaded, initial="guesses").states == ("hinge.phi", "hinge.w")


def test_copies_and_full_models_keep_what_they_are():
    full = ac.compile(Arm(), full=True)
    assert copy.copy(full).nx == full.nx == 4
    assert full.source is not None
    assert full.source.make(full.source.model, full.source.parameters).nx == 4


def test_the_report_names_what_stays_zero():
    compiled = ac.compile(FEPendulum())
    assert (
        "stays zero body.q[0], body.q[2:4], body.q[6:8], body.qd[0], body.qd[2:4], body.qd[6:8], by 23 unknowns: "
        "a disturbance across needs a start value or a force"
    ) in " ".join(compiled.summary().split())
    assert "stays zero" in ac.compile(SpinUp()).summary()
    assert "stays zero" not in ac.compile(NFourBar()).summary(), "forces alone are no motion"


def test_names_are_compressed():
    names = ["a.q[0]", "a.q[1]", "a.q[3]", "b", "c", "der(a.q[3])", "der(a.q[4])", "T[0,1]", "T[0,2]", "x[0]"]
    expected = ["a.q[0:2]", "a.q[3]", "b", "c", "der(a.q[3:5])", "T[0,1]", "T[0,2]", "x[0]"]
    assert compressed(names) == expected
    assert compressed([]) == []
