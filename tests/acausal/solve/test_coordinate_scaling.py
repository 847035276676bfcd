"""Sizes of coordinates in loops follow the unit of length; where all coordinates are alike, they are nominal values."""

from __future__ import annotations

import numpy as np
import pytest

import acausal as ac
from acausal import Model, Scalar, chain, fixed, guess, parameter
from acausal.solve.coordinate_scaling import loop_scales as scales
from acausal.solve.problem import Problem
from components import BodyBox, Fixed, FixedTranslation, PointMass, Prismatic, Revolute, SphericalSpherical, World
from models import FourBar, SimplePendulum, Squeezer
from tests.hard.test_units_of_length import LENGTHS, SliderCrank, Yoke


def sizes(model: ac.Component) -> dict[str, float]:
    compiled = ac.compile(model)
    problem = Problem(compiled, compiled.parameter_values(None))
    return dict(zip(compiled.states, scales(compiled, problem.p).tolist(), strict=True))


@pytest.mark.parametrize(("scene", "slide"), [(SliderCrank, "slide.s"), (Yoke, "way.s")])
def test_a_slide_counts_in_lengths_of_the_machine(scene, slide):
    found = [sizes(scene(L=length)) for length in LENGTHS]
    over = np.array([one[slide] / one["joint.phi"] for one in found])
    np.testing.assert_allclose(over, over[1] * np.array(LENGTHS), rtol=0.5)
    assert 0.1 < over[1] < 1.0, "the crank is 0.3 long"
    for one in found:
        assert one["joint.phi"] == one["pin.phi"]
        assert one["joint.w"] / one[slide.replace(".s", ".v")] == pytest.approx(one["joint.phi"] / one[slide])


@pytest.mark.parametrize("scene", [FourBar, Squeezer, SimplePendulum])
def test_coordinates_of_one_unit_count_in_nominal_values(scene):
    compiled = ac.compile(scene())
    np.testing.assert_array_equal(scales(compiled, compiled.parameter_values(None)), compiled.nominal[: compiled.nx])


def test_declared_nominal_values_stay():
    class Declared(SliderCrank):
        slide = Prismatic(s=guess(0.5, nominal=1000.0))

    found = sizes(Declared())
    assert found["slide.s"] == 1000.0
    assert 1000.0 < found["joint.phi"] < 10_000.0


class Across(Model):
    """A slide across a rod of 1.4 m, on a swing: where it is in the middle it does not change the length of the rod."""

    guessed: Scalar = parameter("guess of the slide", unit="m", default=0.5)
    world, base = World(), Fixed(r=(2, 0, 0))
    swing, bar = Revolute(phi=fixed(0), w=fixed(0)), BodyBox(r=(-1.4141, 0, 0))
    slide, arm, mass = Prismatic(n=(0, 0, 1), s=guess(guessed)), FixedTranslation(r=(-1, 1, 0)), PointMass(m=10)
    rod = SphericalSpherical(rod_length=2**0.5)

    def connections(self):
        yield chain(self.base, self.swing, self.bar, self.slide, self.arm, self.mass)
        yield chain(self.world, self.rod, self.arm.frame_b)


def test_a_slide_counts_as_much_wherever_its_iteration_begins():
    middle, far = (sizes(Across(guessed=at)) for at in (1e-3, 0.9))
    assert middle["slide.s"] == pytest.approx(far["slide.s"], rel=0.2)
    assert 0.5 < middle["slide.s"] / middle["swing.phi"] < 10


def test_a_guess_near_the_middle_costs_no_accuracy():
    middle, far = (ac.simulate(Across(guessed=at), stop_time=5.0, tolerance=1e-7) for at in (1e-3, 0.9))
    assert middle["slide.s"][0] == pytest.approx(far["slide.s"][0], abs=1e-9)
    np.testing.assert_allclose(middle["swing.phi"], far["swing.phi"], atol=3e-5)
