"""What a law of an exported model holds stays where it is, however long the run."""

from __future__ import annotations

from pathlib import Path

import pytest

pytest.importorskip("fmpy")

import acausal as ac
from tests.acausal.export.hybrid import exported, simulated
from tests.acausal.solve.events.test_friction import Brakes


class Long(Brakes):
    """The same, to be run for long."""

    stop_time = 1000.0


@pytest.mark.filterwarnings("ignore:.*faster than they are checked:acausal.AcausalWarning")
@pytest.mark.parametrize("version", [2, 3])
def test_brakes_hold_however_long_the_run_is(version: int, tmp_path: Path) -> None:
    """They stop within 7 ms; what an event leaves of their speeds would stay."""
    path = exported(ac.compile(Long()), tmp_path / "a.fmu", version)
    w = 70 / 27
    found = simulated(path, "CoSimulation", Long.stop_time, output=["a.phi", "b.phi"])
    assert found["a.phi"][-1] == pytest.approx((10**2 - w**2) / 1e4 + w**2 / 1e3, rel=1e-8)
    assert found["b.phi"][-1] == pytest.approx(-(5**2) / 1.2e4 + w**2 / 8e3 + w**2 / 1e3, rel=1e-8)
