"""Stops of joints: elastic parts on the drive of a joint, at any angle or distance."""

from __future__ import annotations

import numpy as np
import pytest

import acausal as ac
from acausal import Model, chain, connect, fixed
from components import Body, FixedTranslation, Prismatic, Revolute, World, rotational, translational

g = 9.80665


class Barrier(Model):
    """A bar that falls on a stop 0.3 rad below the horizontal; the other one is 0.9 rad above it."""

    world, hinge = World(), Revolute(use_axis_flange=True, phi=fixed(0), w=fixed(0))
    arm, weight = FixedTranslation(r=(0.5, 0, 0)), Body(m=2)
    stop = rotational.ElastoBacklash(c=5e3, d=100, b=1.2, phi_rel0=0.3)

    def connections(self):
        yield chain(self.world, self.hinge, self.arm, self.weight)
        yield connect(self.hinge.support, self.stop.flange_a)
        yield connect(self.stop.flange_b, self.hinge.axis)


def test_barrier_rests_on_its_stop():
    result = ac.simulate(Barrier(), stop_time=5, tolerance=1e-8)
    phi = result["hinge.phi"]
    assert 0.3 < -phi.min() < 0.3 + np.sqrt(2 * 2 * g * 0.5 * np.sin(0.35) / 5e3)  # undamped: c x^2 / 2 = m g h
    assert 5e3 * (phi[-1] + 0.3) == pytest.approx(-2 * g * 0.5 * np.cos(phi[-1]), rel=1e-5)


class Shuttle(Model):
    """A slide between stops at 0.1 m and 0.4 m."""

    world, slide, body = World(), Prismatic(use_axis_flange=True, s=fixed(0.25), v=fixed(2)), Body(m=1)
    low, high = translational.ElastoGap(c=1e6, d=0, s_rel0=0.1), translational.ElastoGap(c=1e6, d=0, s_rel0=-0.4)

    def connections(self):
        yield chain(self.world, self.slide, self.body)
        yield chain(self.slide.support, self.low, self.slide.axis)
        yield chain(self.slide.axis, self.high, self.slide.support)


def test_shuttle_bounces_between_its_stops():
    """A period is twice the way between the stops at the speed, and a half period of the spring at each."""
    period = 2 * 0.3 / 2 + 2 * np.pi * np.sqrt(1 / 1e6)
    result = ac.simulate(Shuttle(), stop_time=3 * period, tolerance=1e-9)
    deep = 2 * np.sqrt(1 / 1e6)
    assert result["slide.s"][-1] == pytest.approx(0.25, abs=1e-5)
    assert result["slide.v"][-1] == pytest.approx(2, abs=1e-5)
    assert result["slide.s"].max() == pytest.approx(0.4 + deep, abs=2e-4)
    assert result["slide.s"].min() == pytest.approx(0.1 - deep, abs=2e-4)
