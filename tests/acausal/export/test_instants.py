"""Instants of exported models: before time 0, and several statements at once."""

from __future__ import annotations

from pathlib import Path

import pytest

pytest.importorskip("fmpy")

from fmpy.fmi1 import FMICallException

import acausal as ac
from acausal import Model, Scalar, der, discrete, reinit, time, variable, when
from tests.acausal.export.hybrid import exported, simulated
from tests.acausal.solve.events.test_exact_instants import KINDS, both

ALL = ("CoSimulation", "ModelExchange")


class Sampled(Model):
    """A sample every 0.1 s from the start on."""

    x: Scalar = variable("state", start=0, fixed=True)
    n: Scalar = discrete("samples")
    due: Scalar = discrete("next sample", start=time)

    def equations(self):
        yield der(self.x) == self.n - self.x
        yield when(time >= self.due, reinit(self.n, self.n + 1), reinit(self.due, self.due + 0.1), at_start=True)


@pytest.mark.parametrize("version", [2, 3])
@pytest.mark.parametrize("start", [-30.0, -8.0, 100.0])
def test_many_events_at_any_time(version: int, start: float, tmp_path: Path) -> None:
    """Beyond a hundred events that follow one another closely a model is taken to chatter; these are 0.1 s apart."""
    path = exported(Sampled(), tmp_path / "a.fmu", version, stop_time=60.0)
    found = simulated(path, "CoSimulation", start + 20, start_time=start, output=["n"], output_interval=1.0)
    assert found["n"][-1] in (200, 201)


@pytest.mark.parametrize("kind", ALL)
@pytest.mark.parametrize("first", KINDS)
@pytest.mark.parametrize("second", KINDS)
def test_two_statements_that_disagree_at_one_instant_end_a_run(
    first: str, second: str, kind: str, tmp_path: Path
) -> None:
    path = exported(ac.compile(both(first, second)()), tmp_path / "a.fmu", 3, stop_time=2.0)
    with pytest.raises(FMICallException):
        simulated(path, kind, 2.0, output=["n"])
