"""Long runs with few outputs take the steps of runs with many."""

from __future__ import annotations

import pytest

import acausal as ac
from acausal import Model, Scalar, der, quantity, variable
from models import SimplePendulum
from tests.shared import compiled


class Duffing(Model):
    """A mass on a spring that stiffens, without damping."""

    x: Scalar = variable("position", unit="m", start=1, fixed=True)
    v: Scalar = variable("speed", unit="m/s", start=0, fixed=True)

    def equations(self):
        yield der(self.x) == self.v
        yield der(self.v) == -quantity(4, "1/s2") * self.x - quantity(40, "1/(m2.s2)") * self.x**3

    def stored_energy(self):
        return quantity(1, "kg") * (
            self.v**2 / 2 + quantity(2, "1/s2") * self.x**2 + quantity(10, "1/(m2.s2)") * self.x**4
        )


def steps_and_energy(model: type[Model], stop: float, outputs: int) -> tuple[int, float]:
    """Return the steps of a run, and the change of an energy that should stay."""
    result = ac.simulate(compiled(model), stop_time=stop, intervals=outputs, energy=True)
    assert result.time[-1] == stop
    return result.stats.steps, abs(result.stats.energy_stored_change)


@pytest.mark.parametrize(
    ("model", "stop", "few", "many"),
    [
        (SimplePendulum, 6.5e3, 100, 400),
        (Duffing, 4e3, 100, 400),
        pytest.param(SimplePendulum, 3e4, 10, 10_000, marks=pytest.mark.slow),
    ],
)
def test_few_outputs_take_the_steps_of_many(model: type[Model], stop: float, few: int, many: int) -> None:
    (steps, change), (expected, usual) = (steps_and_energy(model, stop, outputs) for outputs in (few, many))
    assert steps < 1.05 * expected
    assert change < 1.5 * usual
