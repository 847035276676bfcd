"""Cases have names that last, and what goes wrong in one of them is told."""

import subprocess
import sys
from dataclasses import replace

import numpy as np
import pytest

from acausal import Model, Scalar, der, output, sqrt, time, variable
from acausal.study import Case, Job, measure, pack
from tests.acausal.study.decay import Decay

CASE = Case("square", {"kind": "square", "n": 4, "axis": np.array([0.0, 1.0])}, "4", 1e-6)


def test_key_is_the_same_in_every_session():
    code = (
        "import numpy as np; from acausal.study import Case; "
        "print(Case('square', {'axis': (0.0, 1.0), 'n': 4, 'kind': 'square'}, '4', 1e-6).key)"
    )
    assert subprocess.check_output([sys.executable, "-c", code], text=True).strip() == CASE.key


@pytest.mark.parametrize(
    "change",
    [
        {"formulation": "a"},
        {"settings": {"n": 5}},
        {"size": "5"},
        {"tolerance": 1e-5},
        {"max_order": 2},
        {"method": "idas"},
        {"constraints": "states"},
    ],
)
def test_key_has_everything(change):
    assert replace(CASE, **change) != CASE
    assert replace(CASE, **change).key != CASE.key


def test_measurement():
    found = measure(Job(pack(Decay(rate=2.0)), Case(settings={"n": 2}, tolerance=1e-8), 1.0, 10, repeats=3))
    assert found.error == ""
    assert found.values["x"] == pytest.approx(1.25 * np.exp(-2 * np.linspace(0, 1, 11)), rel=1e-5)
    assert min(found.compile_seconds, found.solve_seconds, found.steps, found.factorisations, found.operations) > 0


def test_a_wrong_point_tells_why():
    found = measure(Job(pack(Decay()), Case(settings={"n": 0}), 1.0))
    assert found.error == "`n` of Decay is 0; it must be a number of at least 1."


class Ends(Model):
    """Not defined after 1 s."""

    x: Scalar = output("position", unit="m")

    def equations(self):
        yield der(self.x) == sqrt(1 - time)

    def initial_equations(self):
        yield self.x == 0


def test_a_failing_run_tells_when():
    found = measure(Job(pack(Ends()), Case(), 2.0))
    assert "the run stopped at t = 1 s" in found.error
    assert not found.values


class Swings(Model):
    """Swings for ever."""

    x: Scalar = output("position")
    s: Scalar = variable("the same", start=1.0, fixed=True)
    v: Scalar = variable("speed", start=0.0, fixed=True)

    def equations(self):
        yield der(self.s) == self.v
        yield der(self.v) == -self.s
        yield self.x == self.s


@pytest.mark.parametrize("intervals", [1, 1000])
def test_a_run_that_takes_too_long_is_stopped(intervals):
    found = measure(Job(pack(Swings()), Case(tolerance=1e-12), 1e7, intervals, limit=0.1))
    assert found.error == "it was stopped after 0.1 s"
