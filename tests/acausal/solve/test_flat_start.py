"""Loops that lie flat and rest: nothing tells how they go on, which is said at once, whatever the method."""

from __future__ import annotations

from typing import Any

import pytest

import acausal as ac
from acausal import Model, chain, fixed, structural
from components import BodyRod, Fixed, Revolute, World


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


@pytest.mark.parametrize("method", ["auto", "idas", "rosenbrock"])
@pytest.mark.parametrize("lengths", [(1.0, 2.0, 1.0, 2.0), (1.0, 2.0, 0.5, 2.5), (1.0, 1.0, 1.0, 1.0)])
@pytest.mark.parametrize("gravity", [0.0, 9.81])
def test_a_flat_four_bar_at_rest_is_refused(method: str, lengths: tuple[float, ...], gravity: float) -> None:
    with pytest.raises(ac.InitializationError, match="singular position at rest"):
        ac.simulate(Flat(lengths=lengths, gravity=gravity), stop_time=1, method=method)


def test_a_flat_four_bar_that_takes_its_guesses_is_refused() -> None:
    with pytest.raises(ac.InitializationError, match="singular position at rest"):
        ac.simulate(Flat(given=False), stop_time=1, initial="guesses")
