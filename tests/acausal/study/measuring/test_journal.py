"""What a journal takes from its file, and what is measured again."""

from __future__ import annotations

import json

import numpy as np
import pytest

from acausal.study.measuring.case import Case, Measurement
from acausal.study.measuring.journal import Journal

IDENTITY = {"version": "1", "given": {"k": 1}}
CASE = Case("as given", {"k": 1})


@pytest.fixture
def path(tmp_path):
    """A journal with one measurement."""
    path = tmp_path / "a.journal"
    Journal(path, IDENTITY).add(
        Measurement(CASE, np.array([0.0, 1.0]), {"y": np.array([2.0, float("nan")])}, solve_seconds=1, method="idas")
    )
    return path


def test_it_comes_back(path):
    found = Journal(path, IDENTITY).get(CASE)
    assert found is not None
    assert found.values["y"][0] == 2.0
    assert np.isnan(found.values["y"][1])
    assert (found.case, found.method, found.solve_seconds) == (CASE, "idas", 1)


@pytest.mark.parametrize(
    "change",
    [
        {"point": [1]},
        {"point": None},
        {"values": None},
        {"values": [1.0]},
        {"values": {"y": "text"}},
        {"values": {"y": [1.0, "text"]}},
        {"values": {"y": [1.0, None]}},
        {"values": {"y": [1.0]}},
        {"values": {"y": [[1.0], [2.0]]}},
        {"times": "0, 1"},
        {"times": [0.0]},
        {"steps": "many"},
        {"steps": None},
        {"steps": True},
        {"solve_seconds": "1 s"},
        {"method": 3},
        {"error": None},
        {"more": 1},
    ],
)
def test_lines_that_are_no_measurements_are_measured_again(path, change):
    first, line = path.read_text().splitlines()
    path.write_text("\n".join([first, json.dumps(json.loads(line) | change), line.replace(CASE.key, "other")]) + "\n")
    kept = Journal(path, IDENTITY)
    assert kept.get(CASE) is None
    assert len(kept) == 1
    assert len(path.read_text().splitlines()) == 2


@pytest.mark.parametrize("text", ["", "null", "3", "[1]", "{}", "text", '{"point": "x"}', "[" * 100_000, "\0\0"])
def test_other_lines_are_left_out(path, text):
    with path.open("a") as file:
        file.write(text)
    assert len(Journal(path, IDENTITY)) == 1


def test_a_cut_line(path):
    whole = path.read_text()
    path.write_text(whole[:-20])
    kept = Journal(path, IDENTITY)
    assert len(kept) == 0
    assert path.read_text() == whole.splitlines(keepends=True)[0]
