"""Starts in steady state: every velocity and acceleration is 0, and a second of simulation moves nothing."""

from __future__ import annotations

import warnings
from typing import Any

import numpy as np
import pytest

import acausal as ac
from acausal import Model, Scalar, chain, connect, der, guess, structural, variable
from components import (
    Body,
    BodyRod,
    FixedTranslation,
    FlexibleBeam,
    Prismatic,
    Revolute,
    Spherical,
    Spring,
    SpringDamperParallel,
    World,
)
from models import FlexiblePendulum, FreeVibration, NFourBar, SliderCrank, SpinUp

I = 0.01 * np.eye(3)


def started(model: Any, stop_time: float = 1.0) -> ac.Result:
    with warnings.catch_warnings():
        warnings.simplefilter("error", ac.AcausalWarning)
        warnings.filterwarnings("ignore", ".*linear frames")  # what beams neglect is not what is looked at
        return ac.simulate(model, stop_time=stop_time, intervals=20, initial="steady", tolerance=1e-8)


def moved(result: ac.Result, *names: str) -> float:
    return max(float(np.max(np.ptp(result[name], axis=0))) for name in names)


class Cantilever(Model):
    """A rod that hangs on the tip of a cantilever."""

    phi: float = structural("guess of the rod's angle", default=-1.5)
    initial: str = structural("start of the beam", default="free")
    world, tip, rod = World(g=9.81), Revolute(phi=guess(phi)), BodyRod(r=(0.5, 0, 0), m=0.3)
    beam = FlexibleBeam(length=1, E=2e9, rho=1000, A=1e-4, J=1e-9, elements=4, initial=initial)

    def connections(self):
        yield chain(self.world, self.beam, self.tip, self.rod)


@pytest.mark.parametrize("phi", [-1.5, 0.0, 1.4])
@pytest.mark.parametrize("initial", ["free", "undeformed", "static"])
def test_a_rod_hangs_on_a_cantilever(phi: float, initial: str) -> None:
    result = started(Cantilever(phi=phi, initial=initial))
    assert moved(result, "rod.frame_b.r_0", "beam.q") < 1e-7
    hinge, end = result["rod.frame_a.r_0"][0], result["rod.frame_b.r_0"][0]
    assert end - hinge == pytest.approx([0, -0.5, 0], abs=1e-7)
    assert result["rod.a_0"][0] == pytest.approx(np.zeros(3), abs=1e-6)


class Stewart(Model):
    """A plate on six springs along universal joints, prismatic legs and ball joints."""

    tilt: Any = structural("guess of the plate's orientation", default=(0.1, 0.05, 0))
    d: float = structural("damping of the legs", default=0.0)
    world = World(g=9.81, n=(0, 0, -1))
    plate = Body(m=10, I=np.diag([0.5, 0.5, 0.9]), r_0=guess((0, 0, 1)), angles_start=tilt)

    @ac.parts
    def bases(self):
        """Feet of the legs."""
        return [FixedTranslation(r=(np.cos(a), np.sin(a), 0)) for a in np.radians([20, 100, 140, 220, 260, 340])]

    @ac.parts
    def tops(self):
        """Heads of the legs."""
        angles = np.radians([50, 70, 170, 190, 290, 310])
        return [FixedTranslation(r=(0.5 * np.cos(a), 0.5 * np.sin(a), 0)) for a in angles]

    @ac.parts
    def across(self):
        """First axis of each universal joint."""
        return [Revolute(n=(1, 0, 0)) for _ in range(6)]

    @ac.parts
    def along(self):
        """Second axis of each universal joint."""
        return [Revolute(n=(0, 1, 0)) for _ in range(6)]

    @ac.parts
    def legs(self):
        """Sliding legs."""
        return [Prismatic(n=(0, 0, 1), s=guess(1.1)) for _ in range(6)]

    @ac.parts
    def rods(self):
        """Masses of the legs."""
        return [Body(m=0.5, r_CM=(0, 0, -0.3), I=I) for _ in range(6)]

    @ac.parts
    def balls(self):
        """Joints at the plate."""
        return [Spherical() for _ in range(6)]

    @ac.parts
    def springs(self):
        """What carries the plate."""
        return [SpringDamperParallel(c=2000, d=self.d, s_unstretched=1.2) for _ in range(6)]

    def connections(self):
        for k, leg in enumerate(self.legs):
            yield chain(self.world, self.bases[k], self.across[k], self.along[k], leg, self.balls[k])
            yield connect(self.balls[k].frame_b, self.tops[k].frame_b)
            yield connect(self.tops[k].frame_a, self.plate.frame_a)
            yield connect(leg.frame_b, self.rods[k].frame_a)
            yield connect(leg.frame_b, self.springs[k].frame_b)
            yield connect(self.springs[k].frame_a, self.along[k].frame_b)


@pytest.mark.slow
@pytest.mark.parametrize("tilt", [(0.1, 0.05, 0), (0, 0, 0)])
def test_a_stewart_platform(tilt: tuple[float, ...]) -> None:
    result = started(Stewart(tilt=tilt))
    assert moved(result, "plate.r_0", "legs[0].s") < 1e-7
    assert result["plate.a_0"][0] == pytest.approx(np.zeros(3), abs=1e-6)
    # By symmetry each leg carries a sixth of what does not rest on the feet: the plate and some of the legs.
    forces = [result[f"springs[{k}].f"][0] for k in range(6)]
    assert forces == pytest.approx([forces[0]] * 6, rel=1e-6)
    assert result["plate.r_0"][0, :2] == pytest.approx([0, 0], abs=1e-7)


class Ball(Model):
    """A body on a ball joint."""

    angles: Any = structural("guess of the orientation", default=(0.3, 0.2, -1.2))
    world, joint, rod = World(g=9.81), Spherical(angles_start=angles), Body(r_CM=(0.5, 0, 0), m=0.3, I=I)

    def connections(self):
        yield chain(self.world, self.joint, self.rod)


@pytest.mark.parametrize("angles", [(0.3, 0.2, -1.2), (0, 0, -np.pi / 2), (0, 0, 1.4), (0, 0, 0)])
def test_a_pendulum_on_a_ball_joint_hangs(angles: tuple[float, ...]) -> None:
    result = started(Ball(angles=angles))
    assert result["rod.frame_a.R.T"][0, 0] == pytest.approx([0, -1, 0], abs=1e-7)
    assert np.linalg.norm(result["joint.Q"], axis=1) == pytest.approx(1)
    assert moved(result, "joint.Q") < 1e-8


class OnSprings(Model):
    """A free body in six springs."""

    world, body = World(g=9.81), Body(m=1, I=10 * I, angles_start=(0.1, 0.2, 0.1), r_0=guess((0, 0, 0.5)))

    @ac.parts
    def bases(self):
        """Feet of the springs."""
        return [FixedTranslation(r=(np.cos(a), np.sin(a), 0)) for a in (0.2, -0.2, 2.3, 1.9, 4.4, 4.0)]

    @ac.parts
    def tops(self):
        """Heads of the springs."""
        return [FixedTranslation(r=(np.cos(a) / 2, np.sin(a) / 2, 0)) for a in (0.9, -0.9, 1.2, 2.99, 3.3, 5.1)]

    @ac.parts
    def springs(self):
        """Springs."""
        return [Spring(c=1000, s_unstretched=0.8) for _ in range(6)]

    def connections(self):
        for k, spring in enumerate(self.springs):
            yield chain(self.world, self.bases[k], spring, self.tops[k].frame_b)
            yield connect(self.body.frame_a, self.tops[k].frame_a)


def test_a_free_body_on_six_springs() -> None:
    result = started(OnSprings())
    assert moved(result, "body.r_0", "body.frame_a.Q") < 1e-7
    pulls = sum(result[f"springs[{k}].frame_b.f"][0] for k in range(6))
    weight = result["body.frame_a.R.T"][0] @ [0, -9.81, 0]
    assert pulls == pytest.approx(weight, abs=1e-6)


class Double(Model):
    """Two rods in a row."""

    first: float = structural("guess of the first angle", default=-1.0)
    second: float = structural("guess of the second angle", default=0.5)
    world, hinge, knee = World(g=9.81), Revolute(phi=guess(first)), Revolute(phi=guess(second))
    upper, lower = BodyRod(r=(1, 0, 0), m=1), BodyRod(r=(1, 0, 0), m=1)

    def connections(self):
        yield chain(self.world, self.hinge, self.upper, self.knee, self.lower)


@pytest.mark.parametrize(("first", "second"), [(-1, 0.5), (1.3, 0.2), (-1.5, 3), (0, 0)])
def test_a_double_pendulum_comes_out_hanging(first: float, second: float) -> None:
    result = started(Double(first=first, second=second))
    assert result["lower.frame_b.r_0"][0] == pytest.approx([0, -2, 0], abs=1e-8)


def test_an_equilibrium_that_was_asked_for_is_kept_and_told_to_be_unstable() -> None:
    with pytest.warns(ac.AcausalWarning, match="unstable"):
        linear = ac.linearize(Double(first=np.pi / 2, second=0), initial="steady")
    assert np.max(np.real(linear.eigenvalues)) > 1


class OnACart(Model):
    """A pendulum on a cart, which may stand anywhere."""

    world, rail = World(g=9.81), Prismatic(s=guess(0.7))
    cart, hinge, rod = Body(m=1), Revolute(phi=guess(0.3)), BodyRod(r=(1, 0, 0), m=1)

    def connections(self):
        yield chain(self.world, self.rail, self.hinge, self.rod)
        yield connect(self.rail.frame_b, self.cart.frame_a)


class Wheel(Model):
    """A wheel that may stand at any angle, and is guessed to turn."""

    world, hinge, disc = World(g=9.81), Revolute(phi=guess(0.4), w=guess(3)), Body(m=1, I=I)

    def connections(self):
        yield chain(self.world, self.hinge, self.disc)


def test_what_nothing_determines_takes_its_guess() -> None:
    result = started(OnACart())
    assert result["rail.s"][0] == pytest.approx(0.7, abs=1e-7)
    assert result["hinge.phi"][0] == pytest.approx(-np.pi / 2)
    result = started(Wheel())
    assert result["hinge.phi"] == pytest.approx(0.4, abs=1e-9)


@pytest.mark.parametrize("N", [1, 3])
def test_loops_hang(N: int) -> None:
    class Hanging(NFourBar):
        @ac.parts
        def foot(self):
            """Bearings, guessed above the horizontal."""
            return [Revolute(phi=guess(0.9)) for _ in range(self.N + 1)]

    result = started(Hanging(N=N))
    assert moved(result, "b0_x", "b0_y") < 1e-8
    assert result["b0_y"][0] == pytest.approx(-1, abs=1e-8)


@pytest.mark.parametrize("formulation", ["fem", "substructured", "rigid"])
@pytest.mark.parametrize("phi", [0.0, -1.4])
def test_flexible_pendulums_hang(formulation: str, phi: float) -> None:
    class Hanging(FlexiblePendulum):
        hinge = Revolute(phi=guess(phi))

    result = started(Hanging(formulation=formulation, elements=4, volumes=3), 0.2)
    assert result["swing_angle"] == pytest.approx(-np.pi / 2, abs=1e-7)
    assert moved(result, "tip_x", "tip_y") < 1e-7


def test_scenes_that_rest() -> None:
    """Beams without load are straight; a drive at rest moves nothing before it starts."""
    assert started(FreeVibration(elements=4), 0.1)["tip_deflection"] == pytest.approx(0, abs=1e-12)
    for model in (SpinUp(volumes=2), SliderCrank(crank="rigid", rod="rigid")):
        result = started(model, 1e-4)
        assert moved(result, *(name for name in ("tip_deflection", "slider_position") if name in model.fields)) < 1e-7


def test_first_order_systems() -> None:
    """Two tanks that empty through weirs, of which the second feeds on the first."""

    class Tanks(Model):
        first: Scalar = variable("level", start=0.2)
        second: Scalar = variable("level", start=5.0)

        def equations(self):
            yield der(self.first) == 2 - ac.sqrt(self.first)
            yield der(self.second) == ac.sqrt(self.first) - self.second**2 / 8

    result = started(Tanks())
    assert result["first"] == pytest.approx(4, abs=1e-8)
    assert result["second"] == pytest.approx(4, abs=1e-8)
