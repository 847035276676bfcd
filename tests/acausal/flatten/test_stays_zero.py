"""Unknowns that stay 0 for ever, of machines that move in a plane although their parts could leave it."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

import acausal as ac
from acausal import Model, Scalar, chain, connect, fixed, guess, input, output, parameter, reinit, time, when
from components import Body, BodyRod, FixedRotation, FixedTranslation, Revolute, Spherical, World, WorldForce
from components.rotational import Spring
from models import FEPendulum, FEPlate

INERTIA = np.diag((1e-3, 2e-2, 2e-2))
REST = {"phi": fixed(0), "w": fixed(0)}
ACROSS = ("across.phi", "across.w")


class Arm(Model):
    """A pendulum in the plane of gravity, with a second hinge across that lets it leave the plane."""

    world, hinge = World(g=9.81), Revolute(phi=fixed(0.3), w=fixed(0))
    across = Revolute(n=(0, 1, 0), **REST)
    body = Body(m=0.5, r_CM=(0.4, 0, 0), I=INERTIA)
    x: Scalar = output("position in the plane", unit="m")
    y: Scalar = output("height", unit="m")
    z: Scalar = output("position across", unit="m")

    def connections(self):
        yield chain(self.world, self.hinge, self.across, self.body)

    def equations(self):
        yield self.x == self.body.r_0[0] + 0.4 * self.body.frame_a.R.T[0, 0]
        yield self.y == self.body.r_0[1] + 0.4 * self.body.frame_a.R.T[0, 1]
        yield self.z == self.body.r_0[2] + 0.4 * self.body.frame_a.R.T[0, 2]


def agree(model: Model, *, members: tuple[str, ...] | None = None, tolerance: float = 1e-5, **run) -> ac.CompiledModel:
    """Compile and run a model with and without the unknowns that stay 0; return the reduced model."""
    reduced, full = ac.compile(model), ac.compile(model, full=True)
    assert full.report["stays_zero"] == []
    if members is not None:
        assert set(reduced.report["stays_zero"]) == set(members)
    run = {"stop_time": 0.6, "intervals": 20, "tolerance": 1e-8} | run
    small, large = (ac.simulate(m, **run) for m in (reduced, full))
    for name in reduced.outputs:
        np.testing.assert_allclose(small[name], large[name], atol=tolerance)
    return reduced


def test_planar_motion_needs_no_states_across():
    compiled = agree(Arm(), members=ACROSS)
    assert compiled.states == ("hinge.phi", "hinge.w")
    assert ac.compile(Arm(), full=True).nx == 4


def test_members_are_read_as_zeros(tmp_path: Path):
    names = (*ACROSS, "across.a", "body.frame_a.f[2]", "body.r_0[2]", "z")
    result = ac.simulate(Arm(), stop_time=0.2, intervals=4)
    for name in names:
        np.testing.assert_array_equal(result[name], np.zeros(5))
    result.to_csv(path := tmp_path / "arm.csv", "x", *names)
    table = np.genfromtxt(path, delimiter=",", names=True)
    np.testing.assert_array_equal(np.array(table.tolist())[:, 2:], 0)


def test_energies_are_those_of_the_full_model():
    how = {"stop_time": 0.5, "tolerance": 1e-9, "energy": True}
    reduced, full = (ac.simulate(ac.compile(Arm(), full=f), **how).stats for f in (False, True))
    for name in ("energy_supplied", "energy_stored_change", "energy_dissipated"):
        assert reduced[name] == pytest.approx(full[name], abs=1e-7)


class GravityAcross(Arm):
    world = World(g=9.81, n=(0, -1, -0.2))


class Displaced(Arm):
    across = Revolute(n=(0, 1, 0), phi=fixed(0.01), w=fixed(0))


class Pushed(Arm):
    across = Revolute(n=(0, 1, 0), phi=fixed(0), w=fixed(0.1))


class Kicked(Arm):
    def equations(self):
        yield from super().equations()
        yield when(time > 0.1, reinit(self.across.w, 0.5))


class OffPlane(Arm):
    body = Body(m=0.5, r_CM=(0.4, 0, 0.02), I=INERTIA)


class Skew(Arm):
    body = Body(m=0.5, r_CM=(0.4, 0, 0), I=INERTIA + 1e-4 * np.array([[0, 0, 1], [0, 0, 0], [1, 0, 0]]))


class Stated(Arm):
    """The start across as an initial equation that does not vanish."""

    across = Revolute(n=(0, 1, 0), w=fixed(0))

    def initial_equations(self):
        yield self.across.phi == 0.01


class StatedByParameter(Stated):
    angle: Scalar = parameter("angle at the start", unit="rad", default=0.02)

    def initial_equations(self):
        yield self.across.phi == self.angle


class Loaded(Arm):
    """A force across that is an input."""

    force: Scalar = input("force across", unit="N", default=0.0)
    tip, load = FixedTranslation(r=(0.8, 0, 0)), WorldForce()

    def connections(self):
        yield from super().connections()
        yield chain(self.body.frame_a, self.tip, self.load.frame_b)

    def equations(self):
        yield from super().equations()
        yield self.load.force == (0, 0, self.force)


class Turned(Arm):
    """The whole machine turned out of the coordinate planes: what vanishes is round-off, not 0."""

    turn = FixedRotation(n=(0, 1, 0), angle=30.0)

    def connections(self):
        yield chain(self.world, self.turn, self.hinge, self.across, self.body)


@pytest.mark.parametrize("model", [GravityAcross, Displaced, Pushed, Kicked, OffPlane, Skew, Stated, StatedByParameter])
def test_motion_across_remains(model: type[Model]):
    compiled = agree(model(), members=())
    assert compiled.nx == 4
    assert np.ptp(ac.simulate(compiled, stop_time=0.6)["z"]) > 1e-6 or model is Skew


def test_a_load_across_is_no_zero():
    compiled = agree(Loaded(), members=())
    assert np.ptp(ac.simulate(compiled, stop_time=0.5, inputs={"force": lambda t: 1.0 + 0 * t})["z"]) > 0.1


def test_a_turned_machine_gives_the_same_motion():
    assert agree(Turned(), members=ACROSS).nx == 2


class Free(Arm):
    across = Revolute(n=(0, 1, 0))


class Guessed(Arm):
    across = Revolute(n=(0, 1, 0), phi=guess(0.01), w=fixed(0))


class HalfFixed(Arm):
    across = Revolute(n=(0, 1, 0), phi=fixed(0))


@pytest.mark.parametrize("model", [Free, Guessed, HalfFixed])
def test_missing_conditions_are_reported_as_without_the_pass(model: type[Model]):
    compiled = ac.compile(model())
    assert compiled.report["stays_zero"] == []
    with pytest.raises(ac.InitializationError, match="across"):
        ac.simulate(compiled, stop_time=0.1)


class Ball(Model):
    world, joint = World(g=9.81), Spherical(w_rel=fixed((0, 0, 0)))
    body = Body(m=0.5, r_CM=(0.4, 0, 0), I=INERTIA)
    z: Scalar = output("position across", unit="m")

    def connections(self):
        yield chain(self.world, self.joint, self.body)

    def equations(self):
        yield self.z == self.body.r_0[2] + 0.4 * self.body.frame_a.R.T[0, 2]


class Held(Ball):
    joint = Spherical(angles_start=(0, 0, 0.3), angles_fixed=True, w_rel=fixed((0, 0, 0)))


def test_a_ball_joint_without_fixed_angles_keeps_its_states():
    assert ac.compile(Ball()).nx == ac.compile(Ball(), full=True).nx == 7


def test_a_ball_joint_with_fixed_angles_moves_in_the_plane():
    agree(Held(), members=("joint.Q[0]", "joint.Q[1]", "joint.w_rel[0]", "joint.w_rel[1]"))


class Conditioned(Arm):
    """Start values that hold members by themselves, more of them than needed."""

    def initial_equations(self):
        yield self.across.phi == 0
        yield self.body.frame_a.v[2] == 0


def test_satisfied_conditions_are_dropped_without_a_word(recwarn: pytest.WarningsRecorder):
    compiled = agree(Conditioned(), members=ACROSS)
    texts = [str(c.text) for c in compiled.reduced.flat.equations.initial]
    assert texts == ["hinge.phi = 0.3", "hinge.w = 0"]
    assert [w for w in recwarn if "redundant" in str(w.message)] == []


def test_flexible_bodies_lose_their_modes_across():
    pendulum, plate = ac.compile(FEPendulum()), ac.compile(FEPlate())
    assert (pendulum.nx, plate.nx) == (10, 19)
    assert (ac.compile(FEPendulum(), full=True).nx, ac.compile(FEPlate(), full=True).nx) == (20, 33)
    assert set(plate.report["stays_zero"]) >= {"body.ref.r_0[1]", "body.ref.Q[0]", "body.ref.R.w[0]", "body.q[1]"}


def test_parameters_stay_changeable():
    compiled = ac.compile(Arm())
    light, heavy = (ac.simulate(compiled, parameters={"body.m": m}, stop_time=0.5) for m in (0.5, 5.0))
    assert abs(light["y"][-1] - heavy["y"][-1]) > 1e-6
    with pytest.raises(ac.DeclarationError, match="exactly 0"):
        ac.simulate(compiled, parameters={"body.r_CM": (0.4, 0, 0.02)}, stop_time=0.5)


def test_a_free_parameter_of_0_is_a_symbol():
    compiled = ac.compile(Arm(), free=("body.r_CM[2]",))
    assert compiled.report["stays_zero"] == []
    changed = ac.simulate(compiled, parameters={"body.r_CM": (0.4, 0, 0.02)}, stop_time=0.5, tolerance=1e-8)
    anew = ac.simulate(OffPlane(), stop_time=0.5, tolerance=1e-8)
    np.testing.assert_allclose(changed["across.phi"], anew["across.phi"], atol=1e-6)


def test_a_spring_across_holds_the_plane():
    class Sprung(Arm):
        across = Revolute(n=(0, 1, 0), use_axis_flange=True, **REST)
        spring = Spring(c=3.0)

        def connections(self):
            yield from super().connections()
            yield connect(self.spring.flange_b, self.across.axis)
            yield connect(self.spring.flange_a, self.across.support)

    agree(Sprung(), members=ACROSS)


def test_a_rod_without_inertia_about_its_axis_is_no_member():
    class Rod(Arm):
        body = BodyRod(r=(0.8, 0, 0), m=0.5)

    agree(Rod(), members=ACROSS)


def test_a_hinge_across_that_sticks_keeps_its_states():
    class Sticking(Arm):
        across = Revolute(n=(0, 1, 0), friction="stiction", tau_dry=0.5, **REST)

    assert "across.phi" in ac.compile(Sticking()).states
