"""Values that are no numbers are told once for each quantity, with the first time and the line of the reader."""

from __future__ import annotations

import warnings

import numpy as np
import pytest

import acausal as ac
from acausal import Model, Scalar, fixed, log, output, parameter, sqrt, time, variable


class Roots(Model):
    """A root that ends, an array of which one entry is infinite at an instant, and what is well."""

    p: Scalar = parameter("when", default=0.694)
    y: Scalar = output("root")
    well: Scalar = output("well")
    pair = variable("two", shape=(2,))
    x: Scalar = variable("state")

    def equations(self):
        yield self.y == sqrt(self.p - time)
        yield self.well == time
        yield self.pair == (log(time), 1 / (time - 0.5))
        yield ac.der(self.x) == -self.x


def run(**options):
    return ac.simulate(Roots(x=fixed(1.0)), stop_time=1.0, intervals=400, **options)


def told(read):
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        read()
    assert all(issubclass(w.category, ac.AcausalWarning) and w.filename == __file__ for w in caught)
    return [str(w.message) for w in caught]


READERS = {
    "index": lambda r, path: r["y"],
    "series": lambda r, path: r.series("y"),
    "table": lambda r, path: r.to_csv(path / "a.csv"),
    "frame": lambda r, path: r.to_dataframe(),
    "picture": lambda r, path: r.plot("y", path=path / "a.png"),
    "not finite": lambda r, path: r.not_finite(),
}


@pytest.mark.parametrize("read", READERS.values(), ids=list(READERS))
def test_every_way_of_reading(read, tmp_path):
    result = run()
    first = told(lambda: read(result, tmp_path))
    assert len(first) == 1
    assert first[0].startswith("`y` is not a number (NaN) at 123 of 401 times, first at t = 0.695 s")
    for again in READERS.values():
        assert told(lambda again=again: again(result, tmp_path)) == []


@pytest.mark.parametrize("parameters", [{"p": 0.25}, {"p": 0.5}])
def test_other_parameters(parameters):
    result = run(parameters=parameters)
    after = result.time > parameters["p"]
    text = told(lambda: result["y"])[0]
    assert f"t = {result.time[after][0]:g} s" in text
    assert f"at {after.sum()} of 401 times" in text
    assert result.not_finite("y", "well") == {"y": result.time[after][0]}


def test_entries_of_an_array_and_infinity():
    result = run()
    text = told(lambda: result["pair"])
    assert len(text) == 1
    assert text[0].startswith("`pair[0]` is infinite at 2 of 401 times, first at t = 0 s")
    assert told(lambda: result["pair[1]"])[0].startswith("`pair[1]` is infinite at 1 of")
    assert result.not_finite("pair") == {"pair[0]": 0.0, "pair[1]": 0.5}


def test_nothing_to_tell():
    result = run()
    assert told(lambda: (result["well"], result["x"], result["time"], repr(result))) == []
    assert result.not_finite("well") == {}


def test_a_table_with_an_output_named_time(tmp_path):
    class Timed(Roots):
        """Has a clock of its own."""

        time: Scalar = output("clock")

        def equations(self):
            yield from super().equations()
            yield self.time == 5.0

    result = ac.simulate(Timed(x=fixed(1.0)), stop_time=0.5)
    np.testing.assert_array_equal(result["time"], 5.0)
    for write in (lambda: result.to_csv(tmp_path / "a.csv"), result.to_dataframe):
        with pytest.raises(ac.DeclarationError, match="a table cannot hold the variable `time`"):
            write()
    assert list(result.to_dataframe("well")) == ["time", "well"]
    np.testing.assert_array_equal(result.to_dataframe("well")["time"], result.time)
