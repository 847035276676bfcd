"""Joints as constraints move as the joints do, also in loops whose constraints follow from one another."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

import acausal as ac
import components as joints
from acausal import Model, chain, connect, fixed, part, structural
from components import (
    Body,
    BodyBox,
    BodyShape,
    FixedRotation,
    FixedTranslation,
    FreeMotion,
    Spring,
    World,
    constraints,
)
from tests.components.scenes.constraints import SPEED


class Hung(Model):
    """A body on a spring, free but for a constraint."""

    it: Any = constraints.Spherical()
    world, tilt = World(), FixedRotation(r=(0.2, -0.3, 0.2), n=(1, 2, 1), angle=0.7)
    body = BodyShape(m=1, I=np.diag([1, 2, 1.5]), r=(0.4, 0.1, 0), r_CM=(0.2, 0, 0.1))
    spring, anchor = Spring(c=20), FixedTranslation(r=(0.8, 0, 0.3))
    free = FreeMotion()

    def connections(self):
        yield chain(self.world, self.tilt, self.it, self.body, self.spring, self.anchor.frame_b)
        yield connect(self.anchor.frame_a, self.world.frame_b)
        if self.free is not None:
            yield connect(self.tilt.frame_b, self.free.frame_a)
            yield connect(self.free.frame_b, self.body.frame_a)


class Spherical(Hung):
    it, free = constraints.Spherical(), FreeMotion(angles_fixed=True, w_rel_a=fixed((1, 2, 3)))


class Revolute(Hung):
    it = constraints.Revolute()

    def initial_equations(self):
        yield self.free.w_rel_a[1] == SPEED
        yield self.free.Q[1] == np.sin(0.1)


class Universal(Hung):
    it = constraints.Universal(n_b=(1, 1, 0))

    def initial_equations(self):
        yield self.free.w_rel_a[0] == 2 * SPEED
        yield self.free.w_rel_a[1] == SPEED
        yield self.free.Q[0] == 0
        yield self.free.Q[1] == 0


class Prismatic(Hung):
    it, free = constraints.Prismatic(x_locked=False), FreeMotion(r_rel_a=fixed((0, 0, 0)), v_rel_a=fixed((0, 0, 0)))


PAIRS = {
    Spherical: joints.Spherical(angles_fixed=True, w_rel_a=fixed((1, 2, 3))),
    Revolute: joints.Revolute(n=(0, 1, 0), phi=fixed(0.2), w=fixed(3)),
    Universal: joints.Universal(n_b=(1, 1, 0), phi_a=fixed(0), phi_b=fixed(0), w_a=fixed(3), w_b=fixed(3 * np.sqrt(2))),
    Prismatic: joints.Prismatic(s=fixed(0), v=fixed(0)),
}


@pytest.mark.parametrize("model", PAIRS, ids=lambda model: model.__name__)
def test_constraint_moves_as_the_joint(model):
    run = {"stop_time": 2, "tolerance": 1e-9, "intervals": 40}
    found, known = ac.simulate(model(), **run), ac.simulate(Hung(it=PAIRS[model], free=None), **run)
    assert np.ptp(known["body.frame_b.r_0"]) > 0.05
    np.testing.assert_allclose(found["body.frame_b.r_0"], known["body.frame_b.r_0"], atol=1e-7)
    np.testing.assert_allclose(found["it.frame_a.f"], known["it.frame_a.f"], atol=1e-5)
    np.testing.assert_allclose(found["it.frame_a.t"], known["it.frame_a.t"], atol=1e-5)


@pytest.mark.parametrize("kind", ["Spherical", "Revolute", "Universal", "Prismatic"])
def test_directions_that_are_not_locked(kind):
    """Two slides and the turns take no energy."""

    class Sliding(Hung):
        it = getattr(constraints, kind)(x_locked=False, z_locked=False)

    result = ac.simulate(Sliding(), stop_time=1, tolerance=1e-8, energy=True, initial="guesses")
    assert np.all(np.ptp(result["free.r_rel_a"], axis=0)[[0, 2]] > 0.05)
    assert np.max(np.abs(result["free.r_rel_a"][:, 1])) < 1e-8
    assert np.max(np.abs(result["it.frame_a.f"][:, [0, 2]])) == 0
    assert abs(result.stats.energy_method) < 1e-6


class FourBar(Model):
    """A planar four-bar."""

    closed = structural("whether a constraint closes the loop", default=True)
    world, ground = World(), FixedTranslation(r=(1, 0, 0))
    j1, j2, j4 = joints.Revolute(phi=fixed(1), w=fixed(0)), joints.Revolute(), joints.Revolute()
    crank, coupler, rocker = (
        BodyBox(r=(0.4, 0, 0), width=0.05),
        BodyBox(r=(0.8, 0.3, 0), width=0.05),
        BodyBox(r=(0.1, 0.7, 0), width=0.05),
    )

    @part
    def j3(self):
        return constraints.Revolute(n=(0, 0, 1)) if self.closed else joints.Revolute()

    def connections(self):
        yield chain(self.world, self.j1, self.crank, self.j2, self.coupler, self.j3)
        yield chain(self.world, self.ground, self.j4, self.rocker)
        yield connect(self.rocker.frame_b, self.j3.frame_b)


def test_planar_loop():
    """Three of the five constraints hold anyway."""
    found, known = (
        ac.simulate(FourBar(closed=closed), stop_time=2, tolerance=1e-8, energy=True) for closed in (True, False)
    )
    assert np.ptp(known["j1.phi"]) > 1
    np.testing.assert_allclose(found["j4.phi"], known["j4.phi"], atol=1e-6)
    assert abs(found.stats.energy_method) < 1e-6


class Bar(Model):
    """A shaft in two bearings, and a weight beside it."""

    world, body = World(), Body(m=1, I=np.eye(3))
    left, right = FixedTranslation(r=(0, 0, -0.3)), FixedTranslation(r=(0, 0, 0.3))
    post, far = FixedTranslation(r=(0, 0, -0.3)), FixedTranslation(r=(0, 0, 0.3))
    one, two = constraints.Revolute(n=(0, 0, 1)), constraints.Revolute(n=(0, 0, 1))
    arm = FixedTranslation(r=(0.5, 0, 0))
    weight = Body(m=2)

    def connections(self):
        yield chain(self.world, self.post, self.one, self.left.frame_b)
        yield chain(self.world, self.far, self.two, self.right.frame_b)
        yield connect(self.left.frame_a, self.body.frame_a)
        yield connect(self.right.frame_a, self.body.frame_a)
        yield chain(self.body.frame_a, self.arm, self.weight)


def test_two_bearings_of_one_shaft():
    """(I + m l^2) der(w) = -m g l at the start; each bearing carries a half."""
    result = ac.simulate(Bar(), stop_time=1, tolerance=1e-8, initial="guesses")
    assert len(result.stats.redundant_in_parts) > 0
    turning = -2 * 9.80665 * 0.5 / (1 + 2 * 0.5**2)
    assert result["body.z_a"][0] == pytest.approx([0, 0, turning], abs=1e-6)
    for bearing in ("one", "two"):
        assert result[f"{bearing}.frame_a.f"][0] == pytest.approx([0, (3 * 9.80665 + turning) / 2, 0], abs=1e-5)


def test_axes_of_a_universal_joint_on_one_line():
    with pytest.raises(ac.DeclarationError, match="`n_b` is parallel to `n_a`"):
        ac.compile(Hung(it=constraints.Universal(n_a=(0, 2, 0)), free=None))
