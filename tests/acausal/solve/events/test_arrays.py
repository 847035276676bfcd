"""Discrete variables that are arrays, against as many scalars."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

import acausal as ac
from acausal import Model, Scalar, der, discrete, reinit, sin, time, variable, when
from tests.hard.driven import DrivenFourBar

METHODS = ("auto", "idas", "rosenbrock", "resolve")


class Delay(Model):
    """A sampled value that acts some samples later."""

    due: Scalar = discrete("time of the next sample", start=0.01)
    count: Scalar = discrete("samples so far")
    x: Scalar = variable("what is sampled", fixed=True)


class Shifted(Delay):
    """With an array."""

    buffer = discrete("samples, the last one first", shape=(3,))

    def equations(self):
        b = self.buffer
        yield when(
            time >= self.due,
            reinit(self.due, self.due + 0.01),
            reinit(b, (1 - self.x, b[0], b[1])),
            reinit(self.count, self.count + 1),
            reinit(self.x, 0.999 * self.x),
        )
        yield der(self.x) == b[2]


class Apart(Delay):
    """With scalars."""

    one: Scalar = discrete("the last sample")
    two: Scalar = discrete("the one before")
    three: Scalar = discrete("the one before that")

    def equations(self):
        yield when(
            time >= self.due,
            reinit(self.due, self.due + 0.01),
            reinit(self.one, 1 - self.x),
            reinit(self.two, self.one),
            reinit(self.three, self.two),
            reinit(self.count, self.count + 1),
            reinit(self.x, 0.999 * self.x),
        )
        yield der(self.x) == self.three


@pytest.mark.parametrize("energy", [False, True])
@pytest.mark.parametrize("method", METHODS)
def test_an_array_is_as_many_scalars(method: str, energy: bool) -> None:
    one, other = (
        ac.simulate(m, stop_time=1.0, intervals=40, tolerance=1e-8, method=method, energy=energy)
        for m in (Shifted(), Apart())
    )
    np.testing.assert_allclose(one["x"], other["x"], rtol=1e-12)
    np.testing.assert_allclose(one["buffer"], np.stack([other[n] for n in ("one", "two", "three")], axis=1), rtol=1e-12)
    assert one["count"][-1] == other["count"][-1] == 100


class Loop(DrivenFourBar):
    """A four-bar with a sampled torque, and a table beside it that never changes."""

    due: Scalar = discrete("time of the next sample", unit="s", start=0.1)
    held: Scalar = discrete("torque", unit="N.m")
    table = discrete("not used", shape=(4,), start=(5.0, -3.0, 2.0, 7.0))

    def equations(self):
        yield when(time >= self.due, reinit(self.due, self.due + 0.1), reinit(self.held, 3 * sin(self.hinge.phi)))
        yield self.torque.tau == self.held + self.table[1] + 3


@pytest.mark.parametrize("method", ["auto", "rosenbrock"])
def test_an_array_beside_a_sampled_torque_in_a_loop(method: str) -> None:
    one, other = (ac.simulate(Loop(), stop_time=1.0, tolerance=1e-8, method=m) for m in (method, "idas"))
    np.testing.assert_allclose(one["hinge.phi"], other["hinge.phi"], atol=1e-5)
    np.testing.assert_array_equal(one["table"], np.broadcast_to([5.0, -3.0, 2.0, 7.0], (401, 4)))


def test_exported_arrays(tmp_path: Path) -> None:
    fmpy = pytest.importorskip("fmpy")
    run = ac.simulate(Shifted(), stop_time=0.5, intervals=10, tolerance=1e-9)
    ac.export_fmu(Shifted(), tmp_path / "delay.fmu")
    found = fmpy.simulate_fmu(
        str(tmp_path / "delay.fmu"), stop_time=0.5, output_interval=0.05, relative_tolerance=1e-9, output=["x"]
    )
    np.testing.assert_allclose(found["x"], run["x"], atol=1e-6)
    ac.export_dae(Shifted(), tmp_path / "delay.dae")
    again = ac.simulate(ac.load_dae(tmp_path / "delay.dae"), stop_time=0.5, intervals=10, tolerance=1e-9)
    np.testing.assert_allclose(again["x"], run["x"], atol=1e-8)
