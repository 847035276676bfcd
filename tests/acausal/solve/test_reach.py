"""Sizes of coordinates in loops follow the unit of length; where all coordinates are alike, they are nominal values."""

from __future__ import annotations

import numpy as np
import pytest

import acausal as ac
from acausal import guess
from acausal.solve.problem import Problem
from acausal.solve.reach import reaches
from components import Prismatic
from models import FourBar, SimplePendulum, Squeezer
from tests.hard.test_units_of_length import LENGTHS, SliderCrank, Yoke


def sizes(model: ac.Component) -> dict[str, float]:
    compiled = ac.compile(model)
    problem = Problem(compiled, compiled.parameter_values(None))
    return dict(zip(compiled.states, reaches(compiled, problem.p).tolist(), strict=True))


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
    np.testing.assert_array_equal(reaches(compiled, compiled.parameter_values(None)), compiled.nominal[: compiled.nx])


def test_declared_nominal_values_stay():
    class Declared(SliderCrank):
        slide = Prismatic(s=guess(0.5, nominal=1000.0))

    found = sizes(Declared())
    assert found["slide.s"] == 1000.0
    assert 1000.0 < found["joint.phi"] < 10_000.0
