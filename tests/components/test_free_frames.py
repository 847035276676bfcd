"""Free bodies beside equations of one's own that name variables of their frames."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

import acausal as ac
from acausal import Component, Model, Scalar, chain, connect, fixed, guess, output, port, sin, time, variable
from components import Body, FixedTranslation, Frame, World
from components.orientation import resolve2


class Falling(Model):
    """A free body."""

    world = World(g=9.81)
    body = Body(m=2.0, I=np.diag([1, 2, 3]), r_0=guess((0, 1, 0)), v_0=guess(0), w_a=guess((0, 0, 3)))


def equations_of(frame: Any) -> list[Any]:
    return [
        frame.r_0[1] == 1.0,
        frame.v[1] == 0,
        frame.R.w[2] == 5 + sin(time),
        frame.r_0[1] == 0.1 * frame.r_0[0],
    ]


@pytest.mark.parametrize("which", range(4))
def test_an_equation_too_many_is_refused(which: int) -> None:
    """It takes the place of no rate."""

    class Over(Falling):
        def equations(self):
            yield equations_of(self.body.frame_a)[which]

    with pytest.raises(ac.UnbalancedModelError, match=r"1 more equation than unknowns(.|\n)*Over"):
        ac.compile(Over())


@pytest.mark.parametrize("turned", [False, True])
def test_an_output_follows_a_free_frame(turned: bool) -> None:
    class Shown(Falling):
        height: Scalar = output("height", unit="m")

        def equations(self):
            y = self.body.frame_a.r_0[1]
            yield y == self.height if turned else self.height == y

    result = ac.simulate(Shown(), stop_time=1.0, initial="guesses", tolerance=1e-9)
    np.testing.assert_allclose(result["height"], 1 - 9.81 / 2 * result.time**2, atol=1e-7)


class Plane(Component):
    """Holds a point in the plane y = 0."""

    frame_a: Frame = port(Frame, "the point")
    force: Scalar = variable("force across", unit="N")

    def equations(self):
        yield self.frame_a.r_0[1] == 0
        yield self.frame_a.f == resolve2(self.frame_a.R, (0, self.force, 0))
        yield self.frame_a.t == (0, 0, 0)


class Edge(Component):
    """Lets a point move along the axis x and z of its frame alone."""

    frame_a: Frame = port(Frame, "the point")
    force: Scalar = variable("force across", unit="N")

    def equations(self):
        yield self.frame_a.v[1] == 0
        yield self.frame_a.f == (0, self.force, 0)
        yield self.frame_a.t == (0, 0, 0)


@pytest.mark.parametrize("part", [Plane, Edge])
def test_constraints_at_a_free_frame_are_those_behind_a_rigid_link(part: type[Component]) -> None:
    class Direct(Model):
        world = World(g=9.81)
        body = Body(
            m=2.0,
            r_CM=(0.3, 0.1, 0),
            I=np.diag([0.1, 0.15, 0.2]),
            r_0=guess(0),
            angles_fixed=True,
            angles_start=(0.3, 0, 0.2),
            w_a=fixed((0.5, 1, 2)),
        )
        held = part()

        def connections(self):
            yield connect(self.held.frame_a, self.body.frame_a)

    class Linked(Direct):
        link = FixedTranslation(r=(0, 0, 0))

        def connections(self):
            yield chain(self.body.frame_a, self.link, self.held.frame_a)

    runs = [
        ac.simulate(m(), stop_time=1.0, tolerance=1e-9, initial="guesses", energy=True, intervals=50)
        for m in (Direct, Linked)
    ]
    for name in ("body.r_0", "body.w_a", "held.force"):
        np.testing.assert_allclose(runs[0][name], runs[1][name], rtol=1e-7, atol=1e-7)
    stats: Any = runs[0].stats
    assert abs(stats.energy_method) < 1e-6  # a thousand tolerances, with whichever method
    assert abs(stats.energy_supplied) < 1e-12
    assert abs(runs[0]["body.w_a"][-1, 0] - 0.5) > 0.1


def test_a_fixed_velocity_leaves_the_guessed_angles() -> None:
    class Thrown(Model):
        world = World(g=9.81)
        body = Body(m=2.0, I=np.diag([1, 2, 3]), r_0=fixed((0, 1, 0)), v_0=fixed((1, 2, 3)), w_a=fixed((0, 0, 3)))

    result = ac.simulate(Thrown(), stop_time=0.1, initial="guesses")
    np.testing.assert_allclose(result["body.v_0"][0], (1, 2, 3), atol=1e-12)
    np.testing.assert_allclose(result["body.frame_a.Q"][0], (0, 0, 0, 1), atol=1e-12)
