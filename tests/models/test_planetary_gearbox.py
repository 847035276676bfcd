"""The planetary gear box of models.vehicle: speeds, torques and energy in each gear and in shifts."""

from __future__ import annotations

from functools import cache

import numpy as np
import pytest

import acausal as ac
from models.vehicle import Shifting
from tests.shared import compiled

GEARS = {"first": (0.5, 3.0, 1), "second": (3.5, 6.0, 2), "third": (6.5, 9.0, 3)}


@cache
def ran(ratio_1: float, ratio_2: float) -> ac.Result:
    """A run through all gears."""
    teeth = {"gearbox.ratio_1": ratio_1, "gearbox.ratio_2": ratio_2}
    return ac.simulate(compiled(Shifting), stop_time=9.0, tolerance=1e-8, parameters=teeth, energy=True)


def expected(i_1: float, i_2: float, gear: int) -> tuple[float, float]:
    """Speeds of the motor and of the first carrier over that of the load."""
    if gear == 1:  # the first sun stands: (1 + i_1) carrier = i_1 load, (1 + i_2) load = motor + i_2 carrier
        carrier = i_1 / (1 + i_1)
        return 1 + i_2 - i_2 * carrier, carrier
    return (1.0, 1.0) if gear == 2 else (i_1 / (1 + i_1), i_1 / (1 + i_1))


@pytest.mark.parametrize("name", GEARS)
@pytest.mark.parametrize("teeth", [(2.0, 2.0), (2.5, 1.8)])
def test_ratio_and_acceleration(name, teeth):
    """Speeds by Willis' equations; acceleration of all inertias reduced to the load."""
    result, (start, end, gear) = ran(*teeth), GEARS[name]
    now = (result.time > start) & (result.time < end)
    motor, carrier = expected(*teeth, gear)
    w = result["load.w"][now]
    np.testing.assert_allclose(result["motor.w"][now], motor * w, rtol=1e-6)
    np.testing.assert_allclose(result["gearbox.carrier.w"][now], carrier * w, rtol=1e-6)
    sun = (1 + teeth[0]) * carrier - teeth[0]
    inertia = 4 + 0.2 * motor**2 + 0.05 * carrier**2 + 0.05 * sun**2
    np.testing.assert_allclose(result["load.a"][now], (100 * motor - 100 * (w / 200) ** 2) / inertia, rtol=1e-6)


def test_energy_is_lost_in_shifts_alone():
    result = ran(2.0, 2.0)
    assert abs(result.stats["energy_method"]) < 1e-4 * result.stats["energy_dissipated"]
    slip = [
        result[f"gearbox.{name}.tau"] * result[f"gearbox.{name}.w_rel"] for name in ("to_sun", "to_carrier", "hold")
    ]
    losses = np.sum(slip, axis=0)
    assert losses.min() > -1e-6
    shifting = (result.time > 3) & (result.time < 3.31) | (result.time > 6) & (result.time < 6.31)
    np.testing.assert_allclose(losses[~shifting], 0, atol=1e-3)
    assert losses[shifting].max() > 1e3


def test_a_brake_that_breaks_away_is_not_redundant(recwarn):
    result = ac.simulate(compiled(Shifting), stop_time=3.3, parameters={"gearbox.J": 0.01})
    assert not recwarn.list
    left = result.time > 3.18
    assert np.all(result["gearbox.hold.mode"][left & (result.time < 3.3)] != 0)
