"""Observed quantities with cases: no switch is watched where they are read, and derivatives are refused."""

from __future__ import annotations

import numpy as np
import pytest

import acausal as ac
from acausal import Model, Scalar, der, observed, piecewise, quantity, sign, time, variable
from acausal.errors import DeclarationError


class Swing(Model):
    """x = sin(t)."""

    x: Scalar = variable("position", unit="1", start=0, fixed=True)
    v: Scalar = variable("speed", unit="1/s", start=1, fixed=True)

    @observed
    def upper(self):
        """Position above 0, or the time after 4 s."""
        return piecewise((5.0, time > 4), (self.x, self.x > 0), 0)

    @observed
    def side(self):
        """Sign of the position, and size of the time before 1 s."""
        return sign(self.x) + abs(time - 1) / quantity(1, "s")

    @observed
    def rate(self):
        """A derivative, which is not to be had here."""
        return der(self.v)

    def equations(self):
        yield der(self.x) == self.v
        yield der(self.v) == -self.x / quantity(1, "s2")


def test_conditions_are_evaluated_as_they_are():
    result = ac.simulate(Swing(), stop_time=6.0)
    t, x = result.time, result["x"]
    np.testing.assert_array_equal(result["upper"], np.where(t > 4, 5.0, np.maximum(x, 0)))
    np.testing.assert_array_equal(result["side"], np.sign(x) + np.abs(t - 1))
    np.testing.assert_array_equal(result[result.tree.upper], result["upper"])
    assert len(result.stats["event_times"]) == 0


def test_a_derivative_is_refused():
    result = ac.simulate(Swing(), stop_time=0.1)
    with pytest.raises(DeclarationError, match=r"der\(\) can be used inside equations\(\) only"):
        result["rate"]
