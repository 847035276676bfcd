"""`fe-plate` by four methods: floating frame, rigid, and steps in inertial frames, as printed and corrected."""

from __future__ import annotations

from functools import cache

import numpy as np
import pytest

import acausal as ac
from acausal import part, structural
from components import Body, World
from components.fe import FEBody, FrameLoad, as_result, run_reconfigured, simulate_reconfigured
from models import FEPendulum, FEPlate
from models.fe_plate import PULSE, plate
from tests.models.test_fe_scenes import PLATE
from tests.models.test_fe_scenes import plate as deviation
from tests.reference.reconfigured_limit import LimitBody

TIMES = np.linspace(0, 0.3, 301)
STEPS = ("as printed", "corrected", "controlled")


@cache
def compiled(**values) -> ac.CompiledModel:
    return ac.compile(FEPlate(mesh=PLATE, **values))


def run(model: ac.CompiledModel, times=TIMES, dt=1e-3 / 12, **options) -> ac.Result:
    return run_reconfigured(model, times[-1], times, dt, **{"loads": [PULSE]} | options)


def test_rigid_plate():
    """Against the rigid columns of the reference; the elastic ones are far off, see test_fe_scenes.py."""
    assert (
        deviation("plate_halfsine_sym", FEPlate(mesh=PLATE, formulation="rigid"), 1e-9, "rigid_") < (1e-5, 1e-7)
    ).all()


def test_outputs_of_the_scene_are_those_of_the_motion():
    found = run(compiled())
    motion = simulate_reconfigured(plate(PLATE, 10), [PULSE], 0.3, 1e-3 / 12, damping=0.05)
    for k, axis in enumerate("xyz"):
        np.testing.assert_allclose(found[f"P1_{axis}"], motion.place("P1")[::12, k], rtol=0, atol=1e-15)
        np.testing.assert_allclose(found[f"w_{axis}"], motion.w[::12, k], rtol=0, atol=1e-15)
    plain = as_result(motion, times=TIMES)
    for name in plain:
        size = np.abs(plain[name]).max(initial=0.0)
        np.testing.assert_allclose(found[name], plain[name], rtol=0, atol=1e-12 * size, err_msg=name)
    assert found.outputs == compiled().outputs
    # Everything that the scene has beside, accelerations being those of the variant.
    np.testing.assert_allclose(found["push.frame_b.a"], found["body.end.a"], atol=1e-12)
    np.testing.assert_allclose(found["push.force"], [PULSE.force(t) for t in TIMES], atol=1e-12)
    assert {"damping", "body.frame_force", "body.embedded.P1.r_0"} <= set(found)
    assert found.stats.steps == 3600


@pytest.mark.parametrize(("variant", "w", "place"), [("corrected", 2e-5, 2.3e-6), ("paper", 2.5e-5, 5e-6)])
def test_beside_the_floating_frame(variant, w, place):
    """Angular velocity in rad/s and P1 in m, for which the issue of the method has these bounds at steps of 1e-4 s."""
    exact = ac.simulate(compiled(), stop_time=0.3, intervals=300, tolerance=1e-9)
    found = run(compiled(), dt=1e-4, variant=variant)
    assert np.abs(found["body.w_a"] - exact["body.w_a"]).max() < w
    assert np.abs(found["body.P1.r_0"] - exact["body.P1.r_0"]).max() < place
    # Both have the force that acts, in the axes of the plate.
    np.testing.assert_allclose(found["body.end.f"], exact["body.end.f"], atol=2e-3)


def test_corrected_accelerations_are_the_derivatives_of_the_velocities():
    """Of the variant, and not of the floating frame, at what the scene adds as well."""
    times = np.linspace(0, 0.01, 1001)
    model = compiled(spin=(2, -6, 3), load="none", damping=0.0)
    found = run(model, times, 1e-5, loads=())
    np.testing.assert_allclose(np.gradient(found["body.v_0"], times, axis=0)[1:-1], found["body.a_0"][1:-1], atol=1e-5)


def thrown(body: type[FEBody], g: float) -> ac.CompiledModel:
    """A plate that is thrown while it is pushed, in other axes."""

    class Thrown(FEPlate):
        world = World(g=g, n=(0, 0, -2))

        @part
        def body(self):
            start: dict = {"angles_start": (0.3, -0.2, 0.5), "angles_fixed": True, "r_0": ac.fixed((1, 2, 3))}
            start |= {"v_0": ac.fixed((0.1, 0.2, 4.0)), "w_a": ac.fixed((1, -2, 0.5))}
            # The limit knows no factor of the stiffness in its damping.
            damping = 0.02 if body is FEBody else 0.02 * 0.8**0.5
            return body(reduced=plate(PLATE, 10), modes=6, stiffness=0.8, damping_ratio=damping, **start)

    return ac.compile(Thrown())


def test_start_gravity_and_body_are_those_of_the_scene():
    """Against the limit of the steps as an ordinary differential equation, by the engine; gravity moves the centre of mass alone.

    The floating frame is 1.8e-3 rad/s away, about the long axis, as the plate turns while it is bent.
    """
    # IDAS would follow the vibrations between so few outputs at order 2.
    how: dict = {"stop_time": 0.1, "intervals": 20, "tolerance": 1e-11, "method": "rosenbrock"}
    model = thrown(FEBody, 3.7)
    exact, limit = ac.simulate(model, **how), ac.simulate(thrown(LimitBody, 0.0), **how)
    found = [run(model, np.linspace(0, 0.1, 21), dt) for dt in (2e-4, 1e-4)]
    np.testing.assert_allclose(found[1]["body.r_0"], exact["body.r_0"], rtol=0, atol=1e-9)
    for name, bound in (("body.w_a", 5e-12), ("body.q", 1e-11)):
        coarse, fine = (np.abs(result[name] - limit[name]).max() for result in found)
        assert fine < bound
        assert coarse / fine == pytest.approx(16, rel=0.1)


@pytest.mark.slow
def test_study(tmp_path):
    """Errors against time: the steps end at their gap, which is told."""
    found = ac.study(FEPlate(mesh=PLATE), tolerances=(1e-5, 1e-9), dt=(2.5e-4, 1.25e-4), repeats=1, workers=2)
    assert not [row.remark for row in found.rows if row.remark]
    rows = {}
    for row in found.rows:
        rows.setdefault(row.case.formulation, []).append(row)
    assert list(rows) == ["floating frame", "rigid", *(f"reconfigured, {how}" for how in STEPS)]
    assert found.reference.case.formulation == "floating frame"
    assert set(found.reference.values) == {"P1_x", "P1_z", "w_y"}
    assert rows["floating frame"][-1].error < 2e-5
    assert [row.limit for row in rows["rigid"] + rows["reconfigured, corrected"]] == ["model"] * 4
    coarse, fine = (row.error for row in rows["reconfigured, as printed"])
    assert 5e-4 < fine < 0.7 * coarse
    # P1_z, 2.2e-6 m of 6.4e-3 m.
    assert [row.error for row in rows["reconfigured, corrected"]] == pytest.approx([3.5e-4] * 2, rel=0.02)
    assert [row.error for row in rows["reconfigured, controlled"]] == pytest.approx([3.5e-4] * 2, rel=0.02)
    assert [gap.partition(":")[0] for gap in found.gaps()] == ["rigid", *list(rows)[3:]]
    found.plot(tmp_path / "a.png")


class Held(FEPendulum):
    """A body with its frame at an interface."""


class Two(FEPlate):
    other = Body(
        m=1, I=np.eye(3), r_0=ac.fixed((0, 0, 0)), v_0=ac.fixed((0, 0, 0)), angles_fixed=True, w_a=ac.fixed((0, 0, 0))
    )


class Point(FEPlate):
    world = World(gravity="point")
    far: bool = structural("whether it is far from the centre", default=True)

    @part
    def body(self):
        start: dict = {
            "angles_fixed": True,
            "r_0": ac.fixed((7e6, 0, 0)),
            "v_0": ac.fixed((0, 0, 0)),
            "w_a": ac.fixed((0, 0, 0)),
        }
        return FEBody(reduced=plate(PLATE, 10), **start)


@pytest.mark.parametrize(
    ("model", "options", "words"),
    [
        (
            {},
            {"loads": ()},
            r"the force at `end` at t = .* is \(.*\) and \(0.0, 0.0, 0.0\) N in the scene and in the loads",
        ),
        ({}, {"loads": [PULSE, PULSE]}, "the force at `end` at t = "),
        ({}, {"loads": [PULSE, FrameLoad("P1", force=(0, 1e-3, 0))]}, "the force at `P1` at t = "),
        ({"load": "none"}, {}, "the force at `end` at t = "),
        ({}, {"loads": [PULSE, FrameLoad(node=3, force=(0, 0, 1))]}, "not at nodes"),
        ({}, {"tolerance": 1e-5}, "tolerance"),
        ({}, {"body": "plate"}, "plate"),
        ({}, {"body": "world"}, "`world` is not an FEBody"),
        ({}, {"dt": 1e-3}, "the limit is 2.91"),
        ({}, {"variant": "best"}, "variant must be one of"),
        ({"body.coriolis": False}, {}, "need centrifugal and Coriolis forces"),
        (Two, {}, "values of 1 of 34 states are missing: `other"),
        (Point, {}, "not point gravity"),
        (Held, {"loads": ()}, "has its reference frame at `hinge`"),
    ],
)
def test_scenes_that_steps_cannot_run(model, options, words):
    scene = ac.compile(FEPlate(mesh=PLATE), model) if isinstance(model, dict) else None
    if scene is None:
        scene = ac.compile(model(mesh=PLATE) if issubclass(model, FEPlate) else model())
    with pytest.raises(ac.DeclarationError, match=words):
        run(scene, **{"times": np.linspace(0, 0.05, 51), "dt": 1e-4} | options)


def test_times_at_which_no_step_ends():
    motion = simulate_reconfigured(plate(PLATE, 10), [], 0.01, 1e-4)
    assert as_result(motion, times=[0, 0.005, 0.01])["body.q"].shape == (3, 10)
    for wrong in ([0, 1.5e-4], [0, 0.02], [-1e-3, 0]):
        with pytest.raises(ac.DeclarationError, match="no step ends"):
            as_result(motion, times=wrong)
