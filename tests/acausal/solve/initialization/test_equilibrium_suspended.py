"""Free bodies find where they hang."""

from __future__ import annotations

import numpy as np
import pytest

import acausal as ac
from acausal import Model, chain, connect, guess
from components import (
    Body,
    BodyBox,
    Fixed,
    FixedTranslation,
    Spring,
    World,
)
from tests.acausal.solve.initialization.test_equilibrium import moved, started


def test_a_box_that_hangs_by_two_springs_turns_over() -> None:
    """Guessed above its springs' feet, it comes out below them."""

    class Hung(Model):
        world, box = World(g=9.81), BodyBox(r=(0.4, 0, 0), width=0.1, density=500, r_0=guess((0.1, 0.3, 0.1)))
        left, right = Spring(c=400, s_unstretched=0.3), Spring(c=400, s_unstretched=0.3)
        foot = FixedTranslation(r=(0.6, 0, 0))

        def connections(self):
            yield chain(self.world, self.left, self.box)
            yield chain(self.world, self.foot, self.right, self.box.frame_b)

    result = started(Hung())
    assert result["box.r_0"][0, 1] < 0
    assert moved(result, "box.r_0") < 1e-7


ABOVE = [(1, 0, 1), (-0.5, 0.866, 1), (-0.5, -0.866, 1)]
BELOW = [(0.3, 0.1, 0), (-0.2, 0.25, 0), (-0.2, -0.3, 0)]


class Suspended(Model):
    """A free body on six springs; guesses are far from where it hangs."""

    world = World(g=3.0, n=(0, 0, -1))
    body = Body(m=2, I=0.1 * np.eye(3), r_0=guess((0.02, 0.01, 0.05)), angles_start=(0.02, 0.01, 0.3))
    anchors = tuple(Fixed(r=r) for r in ABOVE * 2)
    arms = tuple(FixedTranslation(r=BELOW[k]) for k in (0, 1, 2, 1, 2, 0))
    springs = tuple(Spring(c=400, s_unstretched=0.9) for _ in range(6))

    def connections(self):
        for anchor, spring, arm in zip(self.anchors, self.springs, self.arms, strict=True):
            yield chain(anchor.frame_b, spring, arm.frame_b)
            yield connect(arm.frame_a, self.body.frame_a)


class Askew(Suspended):
    body = Body(m=2, I=0.1 * np.eye(3), r_0=guess((0.3, -0.2, 0.4)), angles_start=(0.5, -0.4, 1.5))


class Soft(Suspended):
    springs = tuple(Spring(c=150, s_unstretched=0.5) for _ in range(6))


@pytest.mark.filterwarnings("error")
@pytest.mark.parametrize("model", [Suspended, Askew, Soft])
def test_a_free_body_finds_where_it_hangs(model: type[Model]) -> None:
    result = ac.simulate(model(), stop_time=0.1, initial="steady")
    np.testing.assert_allclose(result["body.r_0"], np.broadcast_to(result["body.r_0"][0], (401, 3)), atol=1e-6)
    assert np.max(ac.linearize(model(), initial="steady").eigenvalues.real) < 1e-6
