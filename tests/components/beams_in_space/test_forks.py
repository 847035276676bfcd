"""Lateral buckling of a beam between forks under equal end moments, at pi sqrt(EJ_y GJ_t) / L."""

from __future__ import annotations

from math import pi

import numpy as np
import pytest
from scipy.optimize import brentq

import acausal as ac
from acausal import Model, Scalar, chain, connect, guess, parameter, part
from components import Prismatic, Revolute, SubstructuredBeam, World
from components.rotational import Torque


class Forks(Model):
    """Both ends turn about z and y, not about x; one slides along x. EJ_y = GJ_t = L = 1, EJ_z = 1e4."""

    M: Scalar = parameter("end moment about z", unit="N.m", default=1.0)
    world = World(gravity=None)
    az, ay = Revolute(use_axis_flange=True), Revolute(n=(0, 1, 0))
    bz, by, slide = Revolute(use_axis_flange=True), Revolute(n=(0, 1, 0)), Prismatic(s=guess(1.0))
    at_a, at_b = Torque(tau=-M), Torque(tau=M)

    @part
    def beam(self):
        return SubstructuredBeam(
            length=1.0,
            E=1e6,
            G=1e6,
            rho=1.0,
            A=1.0,
            J=1e-2,
            J_y=1e-6,
            J_t=1e-6,
            torsional_inertia=1e-3,
            volumes=8,
            geometric_stiffness=True,
            initial="static",
        )

    def connections(self):
        yield chain(self.world, self.az, self.ay, self.beam)
        yield chain(self.world, self.slide, self.bz, self.by, self.beam.frame_b)
        yield connect(self.at_a.flange, self.az.axis)
        yield connect(self.at_b.flange, self.bz.axis)


@pytest.mark.slow
def test_lowest_eigenvalue_across_changes_sign_at_the_critical_moment():
    model = ac.compile(Forks())

    def lowest(M: float) -> float:
        found = ac.linearize(model, parameters={"M": M})
        return float(np.sort(-(np.linalg.eigvals(found.A) ** 2).real)[:2].mean())

    assert brentq(lowest, 3.0, 3.3, xtol=1e-5) == pytest.approx(pi, rel=1e-2)
