"""What is differentiated must not jump in exported models: an error with the words of `simulate`."""

from __future__ import annotations

import pytest

pytest.importorskip("fmpy")

from fmpy.fmi1 import FMICallException

import acausal as ac
from tests.acausal.export.hybrid import exported, simulated
from tests.acausal.solve.checks.test_jumps import BEND, STEP, Driven, Position


@pytest.mark.parametrize("kind", ["CoSimulation", "ModelExchange"])
def test_the_fmu_says_what_simulate_says(kind, tmp_path):
    model, log = Driven(drive=Position(phi_ref=STEP)), []
    with pytest.raises(ac.SimulationError) as caught:
        ac.simulate(model, stop_time=2.0)
    text = str(caught.value).splitlines()[0].partition(": ")[2]
    path = exported(model, tmp_path / "driven.fmu", 3, stop_time=2.0)
    with pytest.raises(FMICallException):
        simulated(path, kind, 2.0, logger=lambda *given: log.append(given[-1].decode()))
    assert text.removesuffix(".") in log[-1]
    meets = exported(Driven(drive=Position(phi_ref=BEND)), tmp_path / "bend.fmu", 3, stop_time=2.0)
    assert simulated(meets, kind, 2.0)["time"][-1] == 2
