"""Events without end in exported models: a ball whose bounces die out."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

pytest.importorskip("fmpy")

from fmpy.fmi1 import FMICallException

import acausal as ac
from tests.acausal.export.hybrid import Ball, exported, simulated

KINDS = ("CoSimulation", "ModelExchange")


@pytest.fixture(scope="module", params=[2, 3])
def ball(request: pytest.FixtureRequest, tmp_path_factory: pytest.TempPathFactory) -> Path:
    return exported(Ball(), tmp_path_factory.mktemp("ball") / "ball.fmu", request.param)


def rests(e: float) -> float:
    """Return when the last of infinitely many bounces is over."""
    return float(np.sqrt(2 / 9.81) * (1 + e) / (1 - e))


@pytest.mark.parametrize("e", [0.2, 0.5, 0.8])
def test_simulate_ends(e: float) -> None:
    with pytest.raises(ac.SimulationError, match="events repeat without end") as caught:
        ac.simulate(Ball(e=e), stop_time=1.2 * rests(e))
    assert caught.value.result.time[-1] == pytest.approx(rests(e), rel=0.02)  # type: ignore[union-attr]


@pytest.mark.parametrize("e", [0.2, 0.5, 0.8])
@pytest.mark.parametrize("kind", KINDS)
def test_the_fmu_reports_an_error(kind: str, e: float, ball: Path) -> None:
    with pytest.raises(FMICallException):
        simulated(ball, kind, 1.2 * rests(e), start_values={"e": e})


@pytest.mark.parametrize("kind", KINDS)
def test_the_fmu_goes_on_as_long_as_the_bounces_do(kind: str, ball: Path) -> None:
    found = simulated(ball, kind, 0.95 * rests(0.5), start_values={"e": 0.5})
    assert found["height"][-1] > -1e-3
    assert found["count"][-1] >= 4
