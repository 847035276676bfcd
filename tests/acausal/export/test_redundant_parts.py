"""Exported models with redundant constraints of parts: they move as in `simulate`, or are refused."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

import acausal as ac
from tests.acausal.solve.wheels import Car, Steered, TwoSkates

fmpy = pytest.importorskip("fmpy")


@pytest.mark.parametrize(
    ("model", "names"),
    [(TwoSkates, ("x.s", "turn.phi", "skate.f", "other.f")), (Car, ("turn.phi", "one.f", "three.f", "four.f"))],
)
def test_an_importer_finds_the_same(model: type[ac.Model], names: tuple[str, ...], tmp_path: Path) -> None:
    path = tmp_path / "model.fmu"
    ac.export_fmu(model(), path, fmi_version=2)
    found = fmpy.simulate_fmu(str(path), stop_time=1, output_interval=0.1, output=list(names), fmi_type="CoSimulation")
    right = ac.simulate(model(), stop_time=1, intervals=10, tolerance=1e-8)
    for name in names:
        np.testing.assert_allclose(found[name], right[name], atol=1e-4)


def test_a_model_in_which_they_stop_holding_is_refused(tmp_path: Path) -> None:
    with pytest.raises(ac.SimulationError, match="a redundant constraint no longer follows"):
        ac.export_fmu(Steered(), tmp_path / "model.fmu")
