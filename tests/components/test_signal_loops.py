"""Algebraic loops of blocks: solved and listed, with limits and switches too; a gain of 1 is named."""

from __future__ import annotations

import numpy as np
import pytest

import acausal as ac
from acausal import Model, connect
from components import blocks


class Loop(Model):
    """A sum, a block, and a gain back to the sum."""

    stop_time = 1.0
    source = blocks.Sine(f=1, amplitude=3)
    add = blocks.Add()
    back = blocks.Gain(k=-3)

    def forward(self):
        return connect(self.add.y, self.back.u)

    def connections(self):
        yield connect(self.source.y, self.add.u1)
        yield connect(self.back.y, self.add.u2)
        yield from np.atleast_1d(self.forward())


class Through(Loop):
    """With a block on the way."""

    block = blocks.Limiter(u_max=0.5)

    def forward(self):
        return [connect(self.add.y, self.block.u), connect(self.block.y, self.back.u)]


def test_linear_loops():
    result = ac.simulate(Loop())
    np.testing.assert_allclose(result["add.y"], result["source.y"] / 4, atol=1e-12)


LAWS = {
    "Limiter": (blocks.Limiter(u_max=0.5), lambda s: np.where(np.abs(s) < 2, s / 4, s - 1.5 * np.sign(s))),
    "DeadZone": (blocks.DeadZone(u_max=0.5), lambda s: np.where(np.abs(s) < 0.5, s, (s + 1.5 * np.sign(s)) / 4)),
}


@pytest.mark.parametrize("name", LAWS)
def test_loops_with_cases(name):
    block, law = LAWS[name]
    result = ac.simulate(type("Cases", (Through,), {"block": block})())
    np.testing.assert_allclose(result["add.y"], law(result["source.y"]), atol=1e-9)


def test_a_loop_without_a_solution_is_named():
    class Contradiction(Model):
        invert, also = blocks.Not(), blocks.And(u2=1)

        def connections(self):
            yield connect(self.invert.y, self.also.u1)
            yield connect(self.also.y, self.invert.u)

    with pytest.raises(ac.InitializationError, match=r"invert \(Not(.|\n)*also \(And"):
        ac.simulate(Contradiction(), stop_time=1)


def test_loops_are_listed():
    text = ac.compile(Loop()).summary()
    (line,) = [line for line in text.splitlines() if "signal loop" in line]
    assert {"add", "back"} & {name.split(".")[0] for name in line.replace(":", "").split()[2:]}
    assert "signal loop" not in ac.compile(type("Open", (Loop,), {"back": blocks.FirstOrder()})()).summary()


def test_a_gain_of_one_is_named():
    with pytest.raises(ac.InitializationError, match=r"`add.y` undetermined(.|\n)*back \(Gain(.|\n)*with the gain 1"):
        ac.simulate(type("Unit", (Loop,), {"back": blocks.Gain(k=1)})())
