"""Minimum, maximum, limits, floor and modulo with their events."""

from __future__ import annotations

import numpy as np
import pytest

import acausal as ac
from acausal import (
    Model,
    Scalar,
    UnitsError,
    clip,
    cos,
    der,
    floor,
    maximum,
    minimum,
    mod,
    output,
    parameter,
    variable,
)
from acausal import time as now


class Steps(Model):
    p: Scalar = parameter("number", default=2.0)
    x: Scalar = variable("moves up and down", fixed=True)
    whole: Scalar = output("floor")
    part: Scalar = output("modulo")
    within: Scalar = output("limited")
    above: Scalar = output("smooth maximum")
    below: Scalar = output("minimum")
    still: Scalar = output("of parameters")
    stop_time = 10

    def equations(self):
        yield der(self.x) == 3 * cos(now)
        yield self.whole == floor(self.x)
        yield self.part == mod(now, 0.7)
        yield self.within == clip(self.x, -1, 2)
        yield self.above == maximum(self.x, 0.5, smooth=0.01)
        yield self.below == minimum(self.x, 0.2 * now)
        yield self.still == maximum(self.p, 1)


def test_values_and_events():
    result = ac.simulate(Steps(), tolerance=1e-9)
    x, t = result["x"], result.time
    np.testing.assert_array_equal(result["whole"], np.floor(x))
    np.testing.assert_allclose(result["part"], np.mod(t, 0.7), atol=1e-12)
    np.testing.assert_array_equal(result["within"], np.clip(x, -1, 2))
    np.testing.assert_allclose(result["above"], np.maximum(x, 0.5), atol=5e-3)
    np.testing.assert_allclose(result["below"], np.minimum(x, 0.2 * t), atol=1e-12)
    assert ac.simulate(Steps(), parameters={"p": 0.5})["still"][-1] == 1
    # 14 wraps of the modulo, and two crossings of 3 sin(t) at each whole number in each of its swings
    assert result.stats.events >= 14 + 2 * 2 * 3


def test_units():
    class Wrong(Model):
        p: Scalar = parameter("length", unit="m", default=2)
        y: Scalar = output("value")

        def equations(self):
            yield self.y == floor(self.p)

    with pytest.raises(UnitsError, match=r"floor needs a number, but .* is in \[m"):
        ac.compile(Wrong())
