"""Soft bodies on springs, whose modes go far from their guesses."""

from __future__ import annotations

from functools import cache

import numpy as np
import pytest

from acausal import Model, Scalar, chain, guess, parameter
from components import Revolute, World
from components import rotational as rot
from components.fe import FEBody, ReducedBody, box, reduce_body
from tests.acausal.solve.start.test_steady import moved, started


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
