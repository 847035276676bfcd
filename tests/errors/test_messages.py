"""Each broken model tells what is wrong, and its repaired form does not: exact messages are in messages/."""

from __future__ import annotations

import pytest

from tests.errors.golden import CASES, golden, told

NAMED = [(name, case) for name, cases in CASES.items() for case in cases]
each = pytest.mark.parametrize(("name", "case"), NAMED, ids=[case.__name__ for _, case in NAMED])


@pytest.mark.parametrize("name", CASES)
def test_every_message_has_its_case(name):
    assert list(golden(name)) == [case.__name__ for case in CASES[name]]


@each
def test_message(name, case):
    assert told(case) == golden(name)[case.__name__]


@each
def test_repaired(name, case):
    case(True)
