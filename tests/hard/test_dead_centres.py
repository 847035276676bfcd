"""Slider-cranks at and near dead centres, against one equation of motion in the crank angle."""

from __future__ import annotations

import numpy as np
import pytest

import acausal as ac
from acausal import Model, chain, connect, fixed, guess, structural
from components import Body, BodyRod, Prismatic, Revolute, World
from components.rotational import Torque
from tests.hard.measure import single_coordinate, travel_time, with_slope, within
from tests.reference import slider_crank


class Rigid(Model):
    """Rigid crank of 1 m and rod, 1 kg for each metre, and a slider; the crank starts at an angle with a speed."""

    rod_length: float = structural("length of the rod in m", default=2.0)
    slider_mass: float = structural("mass of the slider in kg", default=0.5)
    angle: float = structural("angle of the crank at the start", default=0.0)
    speed: float = structural("speed of the crank at the start", default=0.0)
    tau: float = structural("torque on the crank", default=0.0)
    bent: bool = structural("whether the rod starts folded over the crank", default=False)
    world, guide, slider = World(gravity=None), Prismatic(), Body(m=slider_mass)
    bearing = Revolute(use_axis_flange=True, phi=fixed(angle), w=fixed(speed))
    pin, wrist = Revolute(phi=guess(-angle)), Revolute()
    crank = BodyRod(r=(1, 0, 0), m=1)
    drive = Torque(tau=tau)

    @ac.part
    def rod(self):
        """The rod."""
        return BodyRod(r=(self.rod_length, 0, 0), m=self.rod_length)

    def connections(self):
        yield connect(self.drive.flange, self.bearing.axis)
        yield chain(self.world, self.bearing, self.crank, self.pin, self.rod, self.wrist, self.slider)
        yield chain(self.world, self.guide, self.slider)


def reference(rod: float = 2.0) -> slider_crank.SliderCrank:
    return slider_crank.SliderCrank(1.0, rod, 1.0, 0.5)


LONGER = 1 + 1e-6


@pytest.mark.parametrize(
    "tolerance", [1e-6, *(pytest.param(tolerance, marks=pytest.mark.slow) for tolerance in (1e-8, 1e-10))]
)
def test_full_turns_with_a_rod_hardly_longer_than_the_crank(tolerance):
    """At 90 and 270 degrees the slider stops within an angle of sqrt(2 (rod - crank)) = 1.4e-3 rad."""
    model = Rigid(rod_length=LONGER, speed=2 * np.pi)
    result = ac.simulate(model, stop_time=10.0, tolerance=tolerance, intervals=500, energy=True)
    phi, w, ref = result["bearing.phi"], result["bearing.w"], reference(LONGER)
    x = np.cos(phi) + np.sqrt(LONGER**2 - np.sin(phi) ** 2)
    energy = np.array([ref.energy(a, b) for a, b in zip(phi, w, strict=True)])
    # 1,000 times the tolerance, what oscillating bodies lose, on entering and on leaving each of 14 passes; w counts twice.
    within("turns of the crank, missing from 6", 6 - phi[-1] / (2 * np.pi), 0)
    within("slider against closed form, m", np.abs(result["guide.s"] - x).max(), 1e-10)
    within("energy, relative", np.abs(energy / energy[0] - 1).max(), 4 * 14 * 1000 * tolerance)
    steep = [(k + 0.5) * np.pi for k in range(20)]
    late = travel_time(lambda q: 2 * ref.energy(q, 1.0), energy[0], 0.0, phi[-1], steep) - 10
    within("time of the last position, s", abs(late), 10 * 14 * 1000 * tolerance)


@pytest.mark.parametrize("angle", [0.0, np.pi, np.pi + 1e-9])
@pytest.mark.parametrize(("speed", "tau"), [(2.0, 0.0), (0.0, 1.0), (-1.0, 0.5)])
def test_start_in_a_dead_centre(angle, speed, tau):
    result = ac.simulate(Rigid(angle=angle, speed=speed, tau=tau), stop_time=4.0, tolerance=1e-8, intervals=40)
    ref = reference()
    phi = single_coordinate(with_slope(lambda q: 2 * ref.energy(q, 1.0)), result.time, angle, speed, tau)
    within("crank, rad", np.abs(result["bearing.phi"] - phi).max(), 1e-5)
    within("slider, m", np.abs(result["guide.s"] - ref.slider_position(phi)).max(), 1e-5)


class HeldBySlider(Rigid):
    """The slider's place at its dead centre is the condition for positions, the speed of the crank that for speeds."""

    guide = Prismatic(s=fixed(3.0))
    bearing = Revolute(use_axis_flange=True, w=fixed(2.0), phi=guess(0.1))


def test_dead_centre_given_by_the_slider():
    """The slider's place depends on the square of the angle there: the start is found only to the root of rounding."""
    result = ac.simulate(HeldBySlider(), stop_time=2.0, tolerance=1e-8, intervals=20)
    ref = reference()
    phi = single_coordinate(with_slope(lambda q: 2 * ref.energy(q, 1.0)), result.time, 0.0, 2.0)
    within("angle at the start, rad", abs(result["bearing.phi"][0]), 1e-4)
    within("crank, rad", np.abs(result["bearing.phi"] - result["bearing.phi"][0] - phi).max(), 1e-3)


class BySliderSpeed(Rigid):
    """The speed of the slider at its dead centre says nothing about that of the crank."""

    guide = Prismatic(v=fixed(0.0))
    bearing = Revolute(use_axis_flange=True, phi=fixed(0.0))


def test_speed_of_the_slider_in_a_dead_centre_is_no_start():
    with pytest.raises(ac.InitializationError, match=r"1 start value is missing[\s\S]*Revolute\(w=fixed"):
        ac.simulate(BySliderSpeed(), stop_time=1.0)
