"""Two statements that set one variable at one instant to different values."""

from __future__ import annotations

import re

import numpy as np
import pytest

import acausal as ac
from acausal import Model, Scalar, chain, der, discrete, parameter, reinit, time, variable, when
from components import Body, FixedTranslation, Revolute, World
from tests.shared import compiled


class Cradle(Model):
    """Newton's cradle of touching pendulums; equal balls exchange their speeds, a statement for each pair."""

    play: Scalar = parameter("play", unit="rad", default=0.0)
    world = World(g=9.81)
    rails = [FixedTranslation(r=(0.05 * i, 0, 0)) for i in range(5)]  # noqa: RUF012
    pins = [Revolute(phi=ac.fixed(-np.pi / 2 - 0.5 * (i == 0)), w=ac.fixed(0)) for i in range(5)]  # noqa: RUF012
    strings = [FixedTranslation(r=(0.5, 0, 0)) for i in range(5)]  # noqa: RUF012
    balls = [Body(m=0.1) for i in range(5)]  # noqa: RUF012

    def connections(self):
        for parts in zip(self.rails, self.pins, self.strings, self.balls, strict=True):
            yield chain(self.world, *parts)

    def equations(self):
        for p, q in zip(self.pins[:-1], self.pins[1:], strict=True):
            yield when((p.phi >= q.phi + self.play) & (p.w > q.w), reinit(p.w, q.w), reinit(q.w, p.w))


class Struck(Model):
    """A mass meets a wall at the instant at which a clock stops it."""

    stops: Scalar = parameter("speed that the clock sets", unit="m/s", default=0.5)
    x: Scalar = variable("position", unit="m", start=0, fixed=True)
    v: Scalar = variable("speed", unit="m/s", start=1, fixed=True)

    def equations(self):
        yield der(self.x) == self.v
        yield der(self.v) == 0
        yield when(time >= 0.5, reinit(self.v, -self.v))
        yield when(time > 0.5, reinit(self.v, self.stops))


class Counted(Model):
    """Two counters of one instant share a discrete variable."""

    count: Scalar = discrete("count")
    x: Scalar = variable("position", unit="m", start=0, fixed=True)

    def equations(self):
        yield der(self.x) == ac.quantity(1, "m/s")
        yield when(self.x > 0.5, reinit(self.count, self.count + 1))
        yield when(time > 0.5, reinit(self.count, self.count + 10))


def contradicted(error: ac.SimulationError, variable: str) -> bool:
    """True if a message names both statements with their lines and what they set."""
    lines = re.findall(r"test_two_jumps\.py:\d+, reinit of", str(error))
    return len(lines) == 2 and variable in str(error)


def test_no_impact_of_the_cradle_is_lost() -> None:
    """The energy stays, or, where rounding lets two pairs meet at one instant, the run ends with both statements."""
    change, told = 0.0, None
    try:
        result = ac.simulate(compiled(Cradle), stop_time=5, tolerance=1e-8, intervals=1000, energy=True)
        change = result.stats.energy_stored_change
    except ac.SimulationError as error:
        told = error
    assert contradicted(told, ".w") if told else abs(change) < 1e-4


@pytest.mark.parametrize(("model", "variable"), [(Struck, "v"), (Counted, "count")])
def test_different_values_at_one_instant_end_the_run(model: type[Model], variable: str) -> None:
    with pytest.raises(ac.SimulationError) as caught:
        ac.simulate(compiled(model), stop_time=1.0)
    assert contradicted(caught.value, f"`{variable}`")


def test_with_play_the_energy_stays() -> None:
    result = ac.simulate(compiled(Cradle, play=1e-4), stop_time=2.4, tolerance=1e-8, energy=True)
    assert result.stats.events > 10
    assert abs(result.stats.energy_stored_change) < 1e-4


def test_two_statements_that_agree_are_one() -> None:
    result = ac.simulate(compiled(Struck), stop_time=1.0, parameters={"stops": -1.0})
    assert result["v"][-1] == -1
    assert result["x"][-1] == pytest.approx(0, abs=1e-6)
