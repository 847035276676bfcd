"""Saturations in feedback that are carried from limit to limit: exported models find what is between, as a run does."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

pytest.importorskip("fmpy")

from tests.acausal.export.hybrid import exported, simulated
from tests.acausal.solve.saturated import Row, Turned

NAMES = ["a", "b", "c"]


@pytest.mark.parametrize("version", [2, 3])
@pytest.mark.parametrize("kind", ["CoSimulation", "ModelExchange"])
def test_a_step_from_limits_to_between_them(kind: str, version: int, tmp_path: Path) -> None:
    found = simulated(exported(Row(), tmp_path / "a.fmu", version), kind, 1.0, output=NAMES)
    before, after = found["time"] < 0.499, found["time"] > 0.501
    for name in NAMES:
        np.testing.assert_allclose(found[name][before], 4, atol=1e-9)
        np.testing.assert_allclose(found[name][after], 0, atol=1e-9)


@pytest.mark.parametrize("kind", ["CoSimulation", "ModelExchange"])
def test_a_step_of_a_law_that_is_not_monotone(kind: str, tmp_path: Path) -> None:
    path = exported(Turned(), tmp_path / "a.fmu", 3, parameters={"m": 1.0, "k": -1.2})
    found = simulated(path, kind, 1.0, output=["acceleration"])
    beside = abs(found["time"] - 0.5) > 1e-3
    expected = np.where(found["time"] < 0.5, -2, 2)
    np.testing.assert_allclose(found["acceleration"][beside], expected[beside], atol=1e-9)


def test_a_start_between_limits_from_one_at_them(tmp_path: Path) -> None:
    path = exported(Row(), tmp_path / "a.fmu", 3)
    found = simulated(path, "CoSimulation", 0.4, output=NAMES, start_values={"level": 0.0})
    for name in NAMES:
        np.testing.assert_allclose(found[name], 0, atol=1e-9)
