"""Lateral buckling of a beam between forks under equal end moments, at pi sqrt(EJ_y GJ_t) / L."""

from __future__ import annotations

from math import pi

import numpy as np
import pytest
from scipy.optimize import brentq

import acausal as ac
from acausal import Model, Scalar, chain, connect, guess, parameter, part, sin
from components import Prismatic, Revolute, SubstructuredBeam, World
from components.beams import Load
from components.rotational import Torque


class Forks(Model):
    """Both ends turn about z and y, not about x; one slides along x. EJ_y = GJ_t = L = 1, EJ_z = 1e4."""

    M: Scalar = parameter("end moment about z", unit="N.m", default=1.0)
    p: Scalar = parameter("side load in the middle", unit="N/m", default=0.0)
    volumes = 8
    world = World(gravity=None)
    az, ay = Revolute(use_axis_flange=True), Revolute(n=(0, 1, 0))
    bz, by, slide = Revolute(use_axis_flange=True), Revolute(n=(0, 1, 0)), Prismatic(s=guess(1.0))
    at_a, at_b = Torque(tau=-M), Torque(tau=M)

    @part
    def beam(self):
        p = self.p
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
            volumes=self.volumes,
            geometric_stiffness=True,
            initial="static",
            distributed=Load(lambda s, t, r, v, R: (0.0, 0.0, p * sin(pi * s))),
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


class FinerForks(Forks):
    """The error of the critical moment is of order 2."""

    volumes = 10


def test_side_load_is_amplified_by_the_moment():
    """EJ_y w'' = -M phi + m_p and GJ_t phi' = M w': w = w_p / (1 - (M / M_cr)^2), phi = M w / GJ_t, at 0.9 M_cr.

    A crookedness w_p grows in the same way. The static start in a closed loop gives w, and the beam stays at rest.
    """
    load = 1e-4
    model = ac.compile(FinerForks(p=load * pi**4))
    for ratio in (0.0, 0.5, 0.9):
        found = ac.simulate(model, stop_time=1e-3, intervals=1, parameters={"M": ratio * pi})
        w, phi = found["beam.node_r_0"][0, 5, 2], found["beam.node_deflection"][0, 5, 3]
        assert w == pytest.approx(load / (1 - ratio**2), rel=5e-2)
        assert phi == pytest.approx(ratio * pi * w, rel=1e-3, abs=1e-9)
        for k in range(10):
            assert np.max(np.abs(found[f"beam.volume[{k}].qdd"][0])) < 1e-3 * load * pi**4
