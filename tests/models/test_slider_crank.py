"""The elastic slider-crank: energy, the break, elastic against rigid, convergence, and cost without asking."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

import acausal as ac
from acausal.result import Result
from models import SliderCrank
from tests.benchmarks.slider_crank_by_hand import build
from tests.benchmarks.slider_crank_methods import CONVERGED
from tests.benchmarks.slider_crank_methods import simulate as by_hand

RANGE, BEND = 0.304, 2.4e-3


def run(stop_time: float = 1.6, tolerance: float = 1e-6, intervals: int = 400, **settings: Any) -> Result:
    return ac.simulate(
        SliderCrank(**settings), stop_time=stop_time, tolerance=tolerance, intervals=intervals, energy=True
    )


@pytest.mark.parametrize(
    "settings",
    [
        {},
        pytest.param({"crank": "rigid"}, marks=pytest.mark.slow),
        {"rod": "rigid"},
        pytest.param({"rod_volumes": 4}, marks=pytest.mark.slow),
    ],
)
def test_energy_up_to_the_break_is_stored(settings: dict[str, Any]) -> None:
    stats = run(0.7, tolerance=1e-7, intervals=175, **settings).stats
    assert abs(stats["energy_method"]) < 1e-6 * stats["energy_supplied"]


def test_defaults_break_where_the_torque_does_and_cost_little() -> None:
    stats = run(tolerance=1e-5).stats
    assert stats["break_times"] == [0.7]
    assert stats["energy_supplied"] > 0
    assert abs(stats["energy_method"]) < 1e-3 * stats["energy_supplied"]
    assert abs(stats["energy_dissipated"]) < 1e-12
    assert "rosenbrock" in stats["method"]
    assert stats["damped"]
    assert stats["steps"] < 4000


@pytest.mark.slow
def test_defaults_against_the_time_converged_equations_by_hand() -> None:
    exact = by_hand(build(), CONVERGED).outputs
    result = run()
    assert np.abs(result["slider_position"] - exact[1]).max() < 1e-4 * RANGE
    assert np.abs(result["rod_mid_deflection"] - exact[3]).max() < 1e-2 * BEND


@pytest.mark.slow
def test_elastic_and_rigid_crank_nearly_coincide() -> None:
    elastic, rigid = run(), run(crank="rigid")
    assert np.abs(elastic["slider_position"] - rigid["slider_position"]).max() < 5e-3 * RANGE
    assert rigid.stats["states"] < elastic.stats["states"]


@pytest.mark.slow
def test_deflection_converges_with_elements() -> None:
    """At the break, before ringing: the error falls by far with every doubling."""
    found = [run(0.7, intervals=70, rod_elements=n, tolerance=1e-8)["rod_mid_deflection"] for n in (1, 2, 4, 16)]
    errors = [np.abs(f - found[-1]).max() for f in found[:-1]]
    assert errors[1] < errors[0] / 3
    assert errors[2] < errors[1] / 8


def test_resolve_follows_the_ringing() -> None:
    model = ac.compile(SliderCrank(rod="rigid"))
    span: dict[str, Any] = {"stop_time": 0.8, "tolerance": 1e-5, "intervals": 320}
    damped, resolved = (ac.simulate(model, **span, method=m) for m in ("rosenbrock", "resolve"))
    assert (damped.stats["method"], resolved.stats["method"]) == ("rosenbrock", "idas")
    assert resolved.stats["steps"] > 3 * damped.stats["steps"]
    assert np.abs(damped["slider_position"] - resolved["slider_position"]).max() < 1e-4 * RANGE


def test_dead_centre_and_full_turns_of_the_rigid_mechanism() -> None:
    """Turns of a heavy crank through both dead centres keep the closed form of the slider's position."""
    result = run(crank="rigid", rod="rigid", stop_time=4, tolerance=1e-9)
    phi = result["crank_angle"]
    r, length = 0.152, 0.304
    assert np.ptp(phi) > 2 * np.pi
    exact = r * np.cos(phi) + np.sqrt(length**2 - (r * np.sin(phi)) ** 2)
    assert result["slider_position"] == pytest.approx(exact, abs=1e-12)


@pytest.mark.slow
def test_many_elements_pass_the_break() -> None:
    """Stiff elements: rounding of their forces moves accelerations more than a tolerance of initial values."""
    stats = run(0.75, tolerance=1e-5, intervals=150, rod_elements=32).stats
    assert stats["break_times"] == [0.7]
    assert abs(stats["energy_method"]) < 1e-3 * stats["energy_supplied"]
