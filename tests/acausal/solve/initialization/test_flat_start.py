"""Loops that lie flat and rest: nothing tells how they go on, which is said at once, whatever the method."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

import acausal as ac
from acausal import Model, chain, fixed, guess, structural
from components import BodyRod, Fixed, Revolute, World
from tests.shared import pairwise


class Flat(Model):
    """A four-bar with all links along x."""

    lengths: Any = structural("crank, coupler, rocker and ground in m", default=(1.0, 2.0, 1.0, 2.0))
    gravity: float = structural("acceleration of gravity", default=9.81)
    given: bool = structural("whether the rocker's start is given too", default=True)
    world = World(g=gravity)
    foot1, pin1, pin2 = Revolute(phi=fixed(0), w=fixed(0)), Revolute(), Revolute()

    @ac.part
    def foot2(self):
        """Bearing of the rocker."""
        return Revolute(phi=fixed(0), w=fixed(0)) if self.given else Revolute()

    @ac.part
    def far(self):
        """Ground."""
        return Fixed(r=(self.lengths[3], 0, 0))

    @ac.parts
    def links(self):
        """Crank, coupler and rocker."""
        return [BodyRod(r=(length, 0, 0), m=1) for length in self.lengths[:3]]

    def connections(self):
        crank, coupler, rocker = self.links
        yield chain(self.world, self.foot1, crank, self.pin1, coupler, self.pin2, rocker.frame_b)
        yield chain(self.far, self.foot2, rocker)


@pytest.mark.parametrize(
    ("gravity", "lengths", "method"),
    pairwise(
        [0.0, 9.81], [(1.0, 2.0, 1.0, 2.0), (1.0, 2.0, 0.5, 2.5), (1.0, 1.0, 1.0, 1.0)], ["auto", "idas", "rosenbrock"]
    ),
)
def test_a_flat_four_bar_at_rest_is_refused(method: str, lengths: tuple[float, ...], gravity: float) -> None:
    with pytest.raises(ac.InitializationError, match="singular configuration at rest"):
        ac.simulate(Flat(lengths=lengths, gravity=gravity), stop_time=1, method=method)


def test_a_flat_four_bar_that_takes_its_guesses_is_refused() -> None:
    with pytest.raises(ac.InitializationError, match="singular configuration at rest"):
        ac.simulate(Flat(given=False), stop_time=1, initial="guesses")


class Turned(Flat):
    """The same with all links along a line that is turned by an angle, so that the rank is lost up to rounding only."""

    angle: float = structural("of the line, in rad", default=0.3)
    speed: Any = structural("of crank and rocker in rad/s", default=(0.0, 0.0))

    @ac.part
    def foot1(self):
        """Bearing of the crank."""
        return Revolute(phi=fixed(self.angle), w=fixed(self.speed[0]))

    @ac.part
    def foot2(self):
        """Bearing of the rocker."""
        return (
            Revolute(phi=fixed(self.angle), w=fixed(self.speed[1])) if self.given else Revolute(phi=guess(self.angle))
        )

    @ac.part
    def far(self):
        """Ground."""
        length = self.lengths[3]
        return Fixed(r=(length * np.cos(self.angle), length * np.sin(self.angle), 0))


@pytest.mark.parametrize(
    ("angle", "lengths", "method"),
    pairwise([0.3, 1.0, np.pi / 2], [(1.0, 2.0, 1.0, 2.0), (1.0, 2.0, 0.5, 2.5)], ["auto", "idas", "rosenbrock"]),
)
def test_a_turned_flat_four_bar_at_rest_is_refused(method: str, lengths: tuple[float, ...], angle: float) -> None:
    with pytest.raises(ac.InitializationError, match="singular configuration at rest"):
        ac.simulate(Turned(lengths=lengths, angle=angle), stop_time=1, method=method)


@pytest.mark.parametrize("method", ["auto", "rosenbrock"])
def test_a_turned_flat_four_bar_that_takes_its_guesses_is_refused(method: str) -> None:
    with pytest.raises(ac.InitializationError, match="singular configuration at rest"):
        ac.simulate(Turned(given=False), stop_time=1, initial="guesses", method=method)


@pytest.mark.parametrize("method", ["auto", "rosenbrock"])
@pytest.mark.parametrize("angle", [0.3, *(pytest.param(angle, marks=pytest.mark.slow) for angle in (0.0, 2.0))])
def test_a_speed_leads_on_from_a_turned_flat_position(method: str, angle: float) -> None:
    model = Turned(angle=angle, speed=(1.0, 1.0), gravity=0.0)
    result = ac.simulate(model, stop_time=0.5, method=method, tolerance=1e-8)
    np.testing.assert_allclose(result["foot1.phi"][-1], angle + 0.5, atol=1e-6)
    np.testing.assert_allclose(result["foot2.phi"][-1], angle + 0.5, atol=1e-6)


class Crossed(Turned):
    """Three rates are given, of which the loop leaves two."""

    pin1 = Revolute(w=fixed(5.0))


@pytest.mark.parametrize("method", ["auto", "rosenbrock"])
@pytest.mark.parametrize("angle", [0.0, 0.3])
def test_rates_with_which_the_loop_opens_are_named(method: str, angle: float) -> None:
    with pytest.raises(ac.InitializationError, match=r"(?s)does not close.*`pin1.w`.*Free"):
        ac.simulate(Crossed(angle=angle, speed=(1.0, 7.0)), stop_time=1, method=method)


class Stuck(Flat):
    """Speeds that are on no branch: from a flat position at which crank and rocker would have to part."""

    foot1 = Revolute(phi=fixed(0), w=fixed(1))

    @ac.part
    def foot2(self):
        """Bearing of the rocker."""
        return Revolute()


def test_a_start_that_cannot_leave_a_singular_position_says_so() -> None:
    with pytest.raises(ac.InitializationError, match="singular configuration") as caught:
        ac.simulate(Stuck(lengths=(1.0, 2.0, 0.5, 2.5)), stop_time=1, initial="guesses", method="rosenbrock")
    assert "no reason" not in str(caught.value)
