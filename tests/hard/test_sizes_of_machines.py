"""The same machine from micrometres to planetary size moves alike: lengths times L, masses times L^3, inertias times L^5."""

from __future__ import annotations

from functools import cache

import numpy as np
import pytest

import acausal as ac
from acausal import Model, chain, fixed, guess, structural
from components import Body, BodyShape, FixedTranslation, Prismatic, Revolute, Spherical, World
from tests.shared import every_other

LENGTHS = (1e-6, 1e-3, 1e3, 1e6, 1e8)


class Machine(Model):
    """A machine of the length L, on the ground or on a free body."""

    L: float = structural("unit of length", default=1.0)
    free: bool = structural("whether a free body carries it", default=False, choices=(True, False))
    world = World(gravity=None)

    @ac.part
    def base(self):
        """A free body, at rest at the start."""
        zero, starts = (0, 0, 0), {}
        if self.free:
            starts = {"angles_fixed": True, "r_0": fixed(zero), "v_0": fixed(zero), "w_a": fixed(zero)}
        return Body(m=self.L**3, I=self.L**5 * np.eye(3), **starts) if self.free else None

    def bar(self, *r: float) -> BodyShape:
        """A body of unit density with its centre of mass in the middle."""
        r_CM = tuple(self.L * x / 2 for x in r)
        return BodyShape(r=tuple(self.L * x for x in r), m=self.L**3, r_CM=r_CM, I=1e-3 * self.L**5 * np.eye(3))

    @property
    def carrier(self):
        """What carries the machine."""
        return self.base.frame_a if self.free else self.world.frame_b


class SliderCrank(Machine):
    joint, pin, wrist = Revolute(phi=fixed(1.0), w=fixed(1.0)), Revolute(phi=guess(-1.255)), Revolute(phi=guess(0.255))

    @ac.parts
    def bars(self):
        """Crank, rod and slider."""
        return [self.bar(0.3, 0, 0), self.bar(1, 0, 0), self.bar(0, 0, 0)]

    @ac.part
    def slide(self):
        """The rail."""
        return Prismatic(s=guess(1.13 * self.L))

    def connections(self):
        crank, rod, slider = self.bars
        yield chain(self.carrier, self.joint, crank, self.pin, rod, self.wrist, slider.frame_a)
        yield chain(self.carrier, self.slide, slider.frame_a)


class FourBar(Machine):
    joint, pin = Revolute(phi=fixed(1.0), w=fixed(1.0)), Revolute(phi=guess(-0.7))
    wrist, hinge = Revolute(phi=guess(-1.5)), Revolute(phi=guess(1.2))

    @ac.parts
    def bars(self):
        """Crank, coupler and rocker."""
        return [self.bar(length, 0, 0) for length in (0.3, 1, 0.8)]

    @ac.part
    def ground(self):
        """From bearing to bearing."""
        return FixedTranslation(r=(0.9 * self.L, 0, 0))

    def connections(self):
        crank, coupler, rocker = self.bars
        yield chain(self.carrier, self.joint, crank, self.pin, coupler, self.wrist, rocker.frame_b)
        yield chain(self.carrier, self.ground, self.hinge, rocker.frame_a)


class SpatialSlider(Machine):
    joint, ball = Revolute(n=(1, 0, 0), phi=fixed(0.5), w=fixed(1.0)), Spherical()
    pin, wrist = Revolute(n=(0, 1, 0)), Revolute()

    @ac.parts
    def bars(self):
        """Crank, rod and slider."""
        return [self.bar(0, 0.3, 0), self.bar(1, -0.3, 0.1), self.bar(0, 0, 0)]

    @ac.part
    def beside(self):
        """From the bearing to the rail."""
        return FixedTranslation(r=(0, 0, 0.1 * self.L))

    @ac.part
    def slide(self):
        """The rail."""
        return Prismatic(s=guess(0.9 * self.L))

    def connections(self):
        crank, rod, slider = self.bars
        yield chain(self.carrier, self.joint, crank, self.ball, rod, self.pin, self.wrist, slider.frame_a)
        yield chain(self.carrier, self.beside, self.slide, slider.frame_a)


@cache
def motion(machine: type[Machine], free: bool, length: float) -> np.ndarray:
    result = ac.simulate(machine(L=length, free=free), stop_time=1.0, tolerance=1e-6, intervals=20)
    return np.array([result["joint.phi"], result["pin.phi"]])


@pytest.mark.parametrize("machine", [SliderCrank, FourBar, pytest.param(SpatialSlider, marks=pytest.mark.slow)])
@pytest.mark.parametrize("free", [False, True])
@pytest.mark.parametrize("length", every_other(LENGTHS))
def test_angles_do_not_depend_on_the_size(machine, free, length):
    found, expected = motion(machine, free, length), motion(machine, free, 1.0)
    assert np.ptp(expected[0]) > 0.8, "it moves"
    np.testing.assert_allclose(found, expected, atol=1e-4)


@pytest.mark.parametrize("length", every_other(LENGTHS))
def test_redundant_constraints_do_not_depend_on_the_size(length):
    def redundant(length: float) -> list[tuple[int, int]]:
        result = ac.simulate(SliderCrank(L=length, free=True), stop_time=0.01)
        return [(loop["constraints"], loop["redundant"]) for loop in result.stats["loops"]]

    assert redundant(length) == redundant(1.0) == [(6, 3)]
