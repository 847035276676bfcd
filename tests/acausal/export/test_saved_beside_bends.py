"""A state that is saved beside a bend of an implicit law: the run goes on from it bit by bit."""

from __future__ import annotations

from itertools import pairwise
from pathlib import Path

import numpy as np
import pytest

pytest.importorskip("fmpy")

from tests.acausal.export.hybrid import exported, opened
from tests.acausal.solve.integrate.test_kinks import Kinked, exact

GIVEN = {"linear": 0.3, "pull": 0.8}
TIMES = np.linspace(0, 9, 301)


@pytest.mark.parametrize("law", ["stop", "friction", "root"])
def test_a_saved_state_goes_on_bit_by_bit(law: str, tmp_path: Path) -> None:
    bent = type(law, (Kinked,), {"law": law, "__module__": Kinked.__module__})
    path = exported(bent(), tmp_path / "bent.fmu", 2, parameters=GIVEN)
    with opened(path, "CoSimulation") as (fmu, description):
        by_name = {v.name: v.valueReference for v in description.modelVariables}
        reference = [by_name["x"], by_name["z"]]
        fmu.enterInitializationMode()
        fmu.exitInitializationMode()

        def go(first: int, last: int, save: bool = False) -> tuple[list[list[float]], dict[int, object]]:
            values, states = [], {}
            for k, (begin, end) in enumerate(pairwise(TIMES[first : last + 1].tolist()), first):
                if save and k % 7 == 0:
                    states[k] = fmu.getFMUState()
                fmu.doStep(currentCommunicationPoint=begin, communicationStepSize=end - begin)
                values.append(fmu.getReal(reference))
            return values, states

        known, states = go(0, 300, save=True)
        for k, state in states.items():
            fmu.setFMUState(state)
            assert go(k, min(k + 20, 300))[0] == known[k : k + 20]
            fmu.freeFMUState(state)
    np.testing.assert_allclose([x for x, _ in known], exact(law, **GIVEN, times=TIMES)[1:], atol=5e-4)
