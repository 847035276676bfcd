"""Incidence of residuals, and their constant coefficients."""

from __future__ import annotations

import casadi as ca
import numpy as np

import acausal as ac
from acausal import Model, chain, fixed, guess
from acausal.reduce.flat_incidence import jacobian
from components import BodyCylinder, BodyShape, FixedTranslation, Revolute, Spherical, World

x, p, t = ca.SX.sym("x", 3), ca.SX.sym("p"), ca.SX.sym("t")


def test_coefficients_of_numbers_and_parameters_are_explicit() -> None:
    residuals = ca.vertcat(2 * x[0] - p * x[1], x[0] * x[1] + x[2], t * x[2] - x[0], ca.sin(p) * 3 - t)
    found = jacobian(residuals, x, t)
    assert [sorted(row) for row in found.rows] == [[0, 1], [0, 1, 2], [0, 2], []]
    assert {place: str(c) for place, c in found.explicit.items()} == {
        (0, 0): "2",
        (0, 1): "(-p)",
        (1, 2): "1",
        (2, 0): "-1",
    }


def test_what_cancels_is_no_entry() -> None:
    assert jacobian(ca.vertcat(x[0] + x[1] - x[0]), x, t).rows == ((1,),)


def test_unknowns_that_cancel_are_told() -> None:
    residuals = ca.vertcat(x[2] - t, p * x[0] * x[1] - p * x[1] * x[0] + x[2])
    found = jacobian(residuals, x, t)
    assert found.rows == ((2,), (2,))
    assert found.cancelled == {1: [0, 1]}


class Disc(Model):
    """A round disc on a ball joint on a planar loop: its gyroscopic torque about its axis cancels."""

    world = World(gravity=None)
    first = Revolute(phi=fixed(2.106), w=fixed(-1.29))
    crank = BodyShape(r=(0.307, 0, 0), m=0.11, r_CM=(0.1535, 0, 0))
    second = Revolute(phi=guess(-1.6228))
    coupler = BodyShape(r=(1.1254407479668564, 0, 0), m=0.842, r_CM=(0.5627, 0, 0))
    ground = FixedTranslation(r=(1.013, 0, 0))
    fourth = Revolute(phi=guess(1.7872))
    rocker = BodyShape(r=(0.8057902953002103, 0, 0), m=0.806, r_CM=(0.4029, 0, 0))
    third = Revolute()
    ball = Spherical(angles_fixed=True, angles_start=(0.8, -0.9, 0.128), w_rel=fixed((0.053, 0.263, 1.611)))
    disc = BodyCylinder(r=(0.2, 0, 0), diameter=0.2)

    def connections(self):
        yield chain(self.world, self.first, self.crank, self.second, self.coupler, self.third, self.rocker.frame_b)
        yield chain(self.world, self.ground, self.fourth, self.rocker)
        yield chain(self.coupler.frame_a, self.ball, self.disc)


def test_a_torque_that_cancels_leaves_the_order_of_solution_alone() -> None:
    result = ac.simulate(Disc(), stop_time=0.5, tolerance=1e-9, energy=True)
    spin = result["disc.body.frame_a.R.w"][:, 0]
    np.testing.assert_allclose(spin, spin[0], atol=1e-6)
    assert abs(result.stats.energy_method) < 1e-6
