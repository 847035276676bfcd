"""Results from arrays."""

from __future__ import annotations

import pickle

import numpy as np
import pytest

import acausal as ac

TIMES = np.linspace(0, 1, 5)
MATRIX = np.arange(30.0).reshape(5, 2, 3)
VALUES = {"a.T": (MATRIX, "1"), "a.r": (MATRIX[:, 0], "m"), "s": (TIMES**2, "m/s"), "b[1].x": (TIMES, "N")}


def test_read():
    found = ac.result_of(TIMES, VALUES, ["s", "a.r"], title="thing", steps=4)
    np.testing.assert_array_equal(found["a.T"], MATRIX)
    np.testing.assert_array_equal(found["a.T[1,2]"], MATRIX[:, 1, 2])
    np.testing.assert_array_equal(found["a.r[1]"], MATRIX[:, 0, 1])
    np.testing.assert_array_equal(found["b[1].x"], TIMES)
    assert [s.unit for s in found.series("a.r", "s")] == ["m", "m", "m", "m/s"]
    assert found.stats.steps == 4
    assert list(found.to_dataframe().columns) == ["time", "s", "a.r[0]", "a.r[1]", "a.r[2]"]
    np.testing.assert_array_equal(pickle.loads(pickle.dumps(found))["a.T"], MATRIX)
    with pytest.raises(ac.DeclarationError, match="a has T, r"):
        found["a.q"]


def test_outputs_are_scalars_if_not_given():
    assert ac.result_of(TIMES, VALUES).outputs == ("s", "b[1].x")


@pytest.mark.parametrize(
    ("times", "values", "outputs", "words"),
    [
        (TIMES[::-1], VALUES, (), "increasing"),
        (TIMES, {"a": (np.zeros(4), "m")}, (), "for each of 5 times"),
        (TIMES, {"a": (np.zeros((5, 1, 1, 1)), "m")}, (), "a scalar, vector or matrix"),
        (TIMES, {"a b": (TIMES, "m")}, (), "named by a path"),
        (TIMES, VALUES, ("c",), "output `c`"),
    ],
)
def test_refused(times, values, outputs, words):
    with pytest.raises(ac.DeclarationError, match=words):
        ac.result_of(times, values, outputs)


def test_unknown_unit():
    with pytest.raises(ac.DeclarationError, match="furlong"):
        ac.result_of(TIMES, {"a": (TIMES, "furlong")})
