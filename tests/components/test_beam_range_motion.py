"""What beams tell of their range while they move."""

from functools import cache

import numpy as np
import pytest

import acausal as ac
from acausal import (
    Model,
    Scalar,
    chain,
    connect,
    fixed,
    guess,
    parameter,
    part,
    structural,
)
from components import (
    Body,
    FixedTranslation,
    FlexibleBeam,
    Prismatic,
    Revolute,
    SubstructuredBeam,
    World,
    rotational,
)
from models import FlexiblePendulum, FreeVibration, SliderCrank, SpinUp
from tests.components.test_beam_range import AXIAL, SECTION, SLOPE, Cantilever, check, doubts, tip_error
from tests.shared import compiled


@cache
def stiffened(scene):
    formulation = {"formulation": "fem"} if scene is SpinUp else {}
    return ac.compile(scene(**formulation), {"beam.geometric_stiffness": True})


def spin_up(omega, **values):
    return doubts(compiled(SpinUp, **values), parameters={"omega": omega}, stop_time=9.0, tolerance=1e-5)


@pytest.mark.parametrize(("omega", "warns"), [(0.2, False), (2, True), (4, True)])
def test_one_frame_that_turns(omega, warns):
    texts, linear = spin_up(omega, formulation="fem")
    assert any(AXIAL in text for text in texts) == warns
    quiet, right = doubts(stiffened(SpinUp), parameters={"omega": omega}, stop_time=9.0, tolerance=1e-5)
    assert not quiet
    error = np.abs(linear["tip_deflection"] - right["tip_deflection"]).max() / np.abs(right["tip_deflection"]).max()
    assert error > 0.1 if warns else error < 0.01


class OtherWayRound(SpinUp):
    """The beam of the spin-up held at its frame_b."""

    beam = FlexibleBeam(length=8, E=6.895e10, A=7.299e-5, J=8.214e-9, rho=2767, elements=5)

    def connections(self):
        yield from (chain(self.world, self.hub, self.beam.frame_b), connect(self.drive.flange, self.hub.axis))


def free_end(result, clamped, free):
    """Deflection of the free end of a beam from the tangent at the clamped one."""
    r = result[f"beam.{free}.r_0"] - result[f"beam.{clamped}.r_0"]
    return np.einsum("ij,ij->i", result[f"beam.{clamped}.R.T"][:, 1], r)


@pytest.mark.parametrize("omega", [0.7, 1.4])
@pytest.mark.parametrize(("scene", "ends"), [(SpinUp, ("frame_a", "frame_b")), (OtherWayRound, ("frame_b", "frame_a"))])
@pytest.mark.slow
def test_told_size_of_one_frame_that_turns(scene, ends, omega):
    formulation = {"formulation": "fem"} if scene is SpinUp else {}
    options = {"stop_time": 9.0, "tolerance": 1e-6}
    texts, linear = doubts(scene(omega=omega, **formulation), **options)
    right = free_end(doubts(stiffened(scene), parameters={"omega": omega}, **options)[1], *ends)
    error = np.abs(free_end(linear, *ends) - right).max() / np.abs(right).max()
    assert error > 0.019  # 1.965 % and more, converged in time
    check(texts, error)


class Translating(Model):
    """The coupler of a parallelogram: on a platform that moves on a circle without turning."""

    speed: Scalar = parameter("speed on the circle", unit="rad/s", default=5)
    world, slider = World(gravity=None), Body(m=0.05)
    drive, back = rotational.Speed(w_ref=speed), rotational.Speed(w_ref=-speed)
    bearing, level = Revolute(use_axis_flange=True, phi=fixed(0.3)), Revolute(use_axis_flange=True, phi=fixed(-0.3))
    pin, wrist = Revolute(phi=guess(0)), Revolute(phi=guess(0))
    crank, ground, guide = FixedTranslation(r=(0.15, 0, 0)), FixedTranslation(r=(1, 0, 0)), Prismatic(s=guess(0))
    beam = FlexibleBeam(length=1, E=7e10, rho=2700, A=1e-4, J=8e-11)

    def connections(self):
        yield connect(self.drive.flange, self.bearing.axis)
        yield connect(self.back.flange, self.level.axis)
        yield chain(self.world, self.bearing, self.crank, self.level, self.pin, self.beam, self.wrist, self.slider)
        yield chain(self.level, self.ground, self.guide, self.slider)


@pytest.mark.parametrize("reference", ["tangent", "pinned"])
@pytest.mark.parametrize("speed", [2, 7, 10])
@pytest.mark.slow
def test_coupler_that_does_not_turn(speed, reference):
    # Damped in proportion to stiffness, the first vibration is gone after a turn.
    section: dict = {"length": 1, "E": 7e10, "rho": 2700, "A": 1e-4, "J": 8e-11, "beta": 5e-3, "initial": "static"}
    section |= {"axial": "none", "reference": reference}
    fine = SubstructuredBeam(volumes=6, geometric_stiffness=True, **section)
    options = {"stop_time": 12 / speed, "tolerance": 1e-6, "intervals": 200}
    texts, linear = doubts(Translating(speed=speed, beam=FlexibleBeam(elements=6, **section)), **options)
    ends, half = ("frame_a", "frame_b"), 100
    _, right = doubts(Translating(speed=speed, beam=fine), **options)
    bends = [free_end(r, *ends)[half:] for r in (linear, right)]
    check(texts, np.abs(bends[0] - bends[1]).max() / np.abs(bends[1]).max())


class Pendulum(FlexiblePendulum):
    beam = FlexibleBeam(length=0.4, E=1e9, A=18e-4, J=1.215e-8, rho=5540)


@cache
def pendulum(beam, **values):
    section: dict = {"length": 0.4, "E": 1e9, "A": 18e-4, "J": 1.215e-8, "rho": 5540, "beta": 2.5e-3}
    return ac.compile(Pendulum(beam=beam(initial="static", nominal_rate=68, **section, **values)))


@pytest.mark.parametrize("E", [1e9, 8e9, 3e10])
def test_pendulum(E):
    values = {"beam.E": E, "beam.beta": 2e6 / E + 5e-4}
    options = {"stop_time": 0.7, "tolerance": 1e-6, "intervals": 200, "parameters": values}
    texts, linear = doubts(pendulum(FlexibleBeam, elements=6), **options)
    fine = pendulum(SubstructuredBeam, volumes=6, geometric_stiffness=True)
    right = doubts(fine, **options)[1]["tip_deflection"]
    check(texts, np.abs(linear["tip_deflection"] - right).max() / np.abs(right).max())


@pytest.mark.slow
def test_slider_crank():
    options = {"stop_time": 0.7, "tolerance": 1e-6}
    texts, linear = doubts(SliderCrank(), **options)
    right = doubts(ac.compile(SliderCrank(), {"rod_bar.geometric_stiffness": True}), **options)[1]["rod_tip_deflection"]
    check(texts, np.abs(linear["rod_tip_deflection"] - right).max() / np.abs(right).max(), "rod_bar")


@pytest.mark.slow
def test_fine_volumes_that_turn_are_quiet():
    assert spin_up(4, volumes=5)[0]  # errs by 2.5 %
    assert not spin_up(4, volumes=20)[0]  # 0.16 %


class Coupler(Model):
    """A coupler between a crank that turns at one speed and a slider."""

    speed: Scalar = parameter("speed of the crank", unit="rad/s", default=40)
    stiff: bool = structural("whether the coupler is stiffened", default=False, choices=(True, False))
    world, drive, slider = World(gravity=None), rotational.Speed(w_ref=speed), Body(m=0.05)
    bearing, pin, wrist = Revolute(use_axis_flange=True, phi=fixed(0.3)), Revolute(), Revolute(phi=guess(0))
    crank, guide = FixedTranslation(r=(0.15, 0, 0)), Prismatic(s=guess(1.1))

    @part
    def rod(self):
        return FlexibleBeam(
            length=1, E=7e10, rho=2700, A=1e-4, J=8e-11, elements=6, alpha=20, reference="pinned", axial="none",
            geometric_stiffness=self.stiff,
        )  # fmt: skip

    def connections(self):
        yield connect(self.drive.flange, self.bearing.axis)
        yield chain(self.world, self.bearing, self.crank, self.pin, self.rod, self.wrist, self.slider)
        yield chain(self.world, self.guide, self.slider)


@pytest.mark.parametrize(
    ("speed", "warns"),
    [*(pytest.param(speed, warns, marks=pytest.mark.slow) for speed, warns in [(1, False), (20, True)]), (30, True)],
)
def test_coupler(speed, warns):
    options = {"stop_time": 12 / speed, "tolerance": 1e-5, "parameters": {"speed": speed}}
    texts, linear = doubts(compiled(Coupler), **options)
    quiet, right = doubts(compiled(Coupler, stiff=True), **options)
    assert not quiet
    assert any(AXIAL in text for text in texts) == warns
    bends = [r["rod.middle_deflection"] for r in (linear, right)]
    assert (np.abs(bends[0] - bends[1]).max() > 0.05 * np.abs(bends[1]).max()) == warns


def test_small_vibration_is_quiet_and_a_large_one_is_not():
    assert not doubts(FreeVibration(), stop_time=0.2, tolerance=1e-4)[0]
    assert any(SLOPE in text for text in doubts(FreeVibration(tip=0.4), stop_time=0.2, tolerance=1e-4)[0])


@pytest.mark.parametrize("kind", [FlexibleBeam, SubstructuredBeam])
def test_warnings_can_be_switched_off(kind):
    assert not tip_error(ac.compile(Cantilever(beam=kind(check_range=False, **SECTION))), 3)[0]
