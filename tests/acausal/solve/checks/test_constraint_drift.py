"""Constraints of parts that followed from others and no longer do: the run ends with their names."""

from __future__ import annotations

import pytest

import acausal as ac
from acausal import fixed
from components import FixedTranslation, Prismatic
from tests.acausal.solve.wheels import Car, Steered


def test_a_skate_that_is_steered_away_ends_the_run() -> None:
    with pytest.raises(
        ac.SimulationError, match=r"redundant constraint no longer follows[^\n]*\n  other \(Skate\), "
    ) as caught:
        ac.simulate(Steered(), stop_time=1, tolerance=1e-8)
    result = caught.value.result
    assert 0.5 < result.time[-1] < 0.6
    assert "other (Skate)" in result.stats["stopped"]


def test_wheels_steered_by_one_angle_lock_the_car() -> None:
    with pytest.raises(
        ac.SimulationError, match=r"redundant constraint no longer follows[^\n]*\n  (three|four) \(Skate\), "
    ):
        ac.simulate(Car(ackermann=False), stop_time=1, tolerance=1e-8)


class AtRest(Steered):
    """Turns on the spot: any direction of the skates agrees with that."""

    x = Prismatic(s=fixed(0), v=fixed(0))
    right, left = FixedTranslation(r=(0, 0, 0)), FixedTranslation(r=(0, 0, 0))


def test_a_steered_skate_may_turn_where_nothing_moves_across_it() -> None:
    result = ac.simulate(AtRest(), stop_time=1, tolerance=1e-8)
    assert result["turn.phi"][-1] == pytest.approx(2, abs=1e-6)
