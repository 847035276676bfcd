"""Soft bodies on springs, whose modes go far from their guesses."""

from __future__ import annotations

from functools import cache

import numpy as np
import pytest

import acausal as ac
from acausal import Component, Model, Scalar, chain, connect, guess, parameter, part, structural
from components import BodyRod, FixedTranslation, FlexibleBeam, Revolute, SubstructuredBeam, World
from components import rotational as rot
from components.fe import FEBody, ReducedBody, box, reduce_body
from tests.acausal.solve.initialization.test_equilibrium import moved, started


@cache
def rod() -> ReducedBody:
    M, K, nodes = box((0.4, 0.05, 0.04), (4, 1, 1), "hex8", E=5e6, nu=0.3, rho=1100.0)
    ends = {name: np.flatnonzero(np.isclose(nodes[:, 0], x)) for name, x in (("frame_a", 0), ("frame_b", 0.4))}
    return reduce_body(M, K, nodes, frames=ends, hold="frame_a", modes=6)


class TwoRods(Model):
    """Two rods in a chain, on hinges with springs."""

    stiffness: Scalar = parameter("factor of the rods' stiffness", unit="1", default=1.0)
    world = World()
    first, second = (Revolute(use_axis_flange=True, phi=guess(0)) for _ in range(2))
    stiff, soft = rot.SpringDamper(c=20, d=0.1), rot.SpringDamper(c=10, d=0.1)
    upper = FEBody(reduced=rod(), stiffness=stiffness, damping_ratio=0.02, check_range=False)
    lower = FEBody(reduced=rod(), stiffness=stiffness, damping_ratio=0.02, check_range=False)

    def connections(self):
        yield chain(self.world, self.first, self.upper, self.second, self.lower)
        yield chain(self.first.support, self.stiff, self.first.axis)
        yield chain(self.second.support, self.soft, self.second.axis)


@pytest.mark.parametrize("stiffness", [0.05, 0.2, 0.5, 0.9, 1.2, 2.0])
def test_soft_rods_sag(stiffness: float) -> None:
    """However soft they are, and whatever the stop time."""
    names = ("first.phi", "second.phi", "upper.q", "lower.q")
    runs = [started(TwoRods(stiffness=stiffness), stop_time) for stop_time in (0.01, 10.0)]
    assert all(moved(run, *names) < 1e-6 for run in runs)
    assert all(run["first.phi"][0] < -0.01 for run in runs)
    assert runs[0]["second.phi"][0] == pytest.approx(runs[1]["second.phi"][0], abs=1e-9)


class Swing(Model):
    """A soft beam that hangs on two rods: a closed loop."""

    J: float = structural("second moment of area, m^4", default=1e-9)
    volumes: int = structural("volumes of the beam; 0: one frame", default=0)
    world, ground = World(), FixedTranslation(r=(1, 0.2, 0))
    left, right = Revolute(use_axis_flange=True, phi=guess(0)), Revolute(phi=guess(0))
    near, far = Revolute(), Revolute()
    short, long = BodyRod(r=(0, -1, 0), m=1), BodyRod(r=(0, -1.2, 0), m=1)
    brake = rot.Damper(d=2)

    @part
    def beam(self) -> Component:
        """The beam, whose own damping ends what the brake does not reach."""
        made = {"length": 1, "E": 2e8, "rho": 2700, "A": 1e-4, "J": self.J, "beta": 1e-3, "check_range": False}
        if self.volumes:
            return SubstructuredBeam(volumes=self.volumes, elements_per_volume=2, **made)
        return FlexibleBeam(elements=4, **made)

    def connections(self):
        yield chain(self.world, self.left, self.short, self.near, self.beam, self.far, self.long.frame_b)
        yield chain(self.world, self.ground, self.right, self.long)
        yield connect(self.brake.flange_a, self.left.support)
        yield connect(self.brake.flange_b, self.left.axis)


@pytest.mark.parametrize("volumes", [0, 2])
@pytest.mark.parametrize("J", [3e-9, 1.2e-9, 5e-10])
def test_a_soft_beam_in_a_loop_sags(J: float, volumes: int) -> None:
    """As far as its motion leads."""
    model, angles = Swing(J=J, volumes=volumes), ("left.phi", "right.phi", "near.phi", "far.phi")
    rest = started(model, 1.0)
    assert moved(rest, *angles) < 1e-6
    final = ac.simulate(model, initial="guesses", stop_time=100.0, intervals=10)
    for name in angles:
        assert rest[name][0] == pytest.approx(final[name][-1], abs=1e-3)


@pytest.mark.parametrize("turn", [-1.5, 1.0, pytest.param(3.0, marks=pytest.mark.slow)])
def test_rest_of_a_loop_does_not_depend_on_the_stop_time(turn: float) -> None:
    """How fast a run returns to its constraints follows from that; the search has its own."""
    model = Swing(J=3e-9, left=Revolute(use_axis_flange=True, phi=guess(turn)))
    runs = [started(model, stop_time) for stop_time in (0.01, 1.0, 10.0)]
    for name in ("left.phi", "right.phi", "near.phi", "far.phi"):
        assert max(abs(run[name][0] - runs[0][name][0]) for run in runs) < 1e-6
