"""What the command line reads and prints, without a model."""

import io
import json
import math

import numpy as np
import pytest

import acausal as ac
from acausal import Model, Scalar, der, output, parameter, variable
from acausal.cli.option_values import read_settings
from acausal.cli.output import modes_table, plain, summary, write_json
from acausal.errors import DeclarationError


@pytest.mark.parametrize(
    ("text", "value"),
    [
        ("4", 4),
        ("-4.5", -4.5),
        ("7e10", 7e10),
        ("fem", "fem"),
        ("'fem'", "fem"),
        ("none", "none"),
        ("None", None),
        ("true", True),
        ("False", False),
        ("0,0,1", (0, 0, 1)),
        ("(0, -1, 0)", (0, -1, 0)),
        ("[[1, 0], [0, 1]]", [[1, 0], [0, 1]]),
        ("007", 7.0),
        ("inf", math.inf),
        ("1/3", "1/3"),
        ("a=b", "a=b"),
    ],
)
def test_values(text, value):
    read = read_settings([f"name = {text}"])["name"]
    assert read == value
    assert type(read) is type(value)


@pytest.mark.parametrize("text", ["", "omega", "=4", "omega=", " = "])
def test_no_pair(text):
    with pytest.raises(DeclarationError, match="--set takes NAME=VALUE"):
        read_settings([text])


def test_plain():
    value = {
        "complex": np.array([1 + 2j]),
        "nan": [math.nan, math.inf, np.float64(1.5)],
        "integer": np.int64(3),
        "flag": np.True_,
        "nothing": None,
        "pair": (1, "a"),
        3: complex(math.nan, 0),
    }
    assert plain(value) == {
        "complex": [[1.0, 2.0]],
        "nan": [None, None, 1.5],
        "integer": 3,
        "flag": True,
        "nothing": None,
        "pair": [1, "a"],
        "3": [None, 0.0],
    }


def test_json_on_standard_output():
    stream = io.StringIO()
    write_json({"a": [1.0, math.nan]}, "-", stream)
    assert json.loads(stream.getvalue()) == {"a": [1.0, None]}


def test_modes_table():
    table = modes_table(np.array([-0.5, -1 - 10j, -1 + 10j]))
    assert [line.split() for line in table.splitlines()[1:]] == [["-0.5"], ["-1", "±", "10i", "1.59155", "0.0995"]]


def test_small_outputs_are_named_but_not_rounding_errors():
    class Decay(Model):
        rate: Scalar = parameter("rate", unit="1/s", default=1)
        s = variable("lengths", shape=(3,), unit="m", start=(1, 1e-7, 1e-18), fixed=True)
        x, y, z = (output(f"length {k}", unit="m") for k in range(3))

        def equations(self):
            yield der(self.s) == -self.rate * self.s
            yield self.s == (self.x, self.y, self.z)

    text = summary(ac.simulate(Decay(), stop_time=1.0))
    assert "y is about" in text
    assert "x is about" not in text
    assert "z is about" not in text
