"""Random machines give right results; damaged ones do, or end in an error that says where."""

from __future__ import annotations

import pytest
from hypothesis import given

from tests.fuzz.arguments import constructed, options
from tests.fuzz.damage import damaged
from tests.fuzz.machines import machines
from tests.fuzz.outcome import outcome
from tests.fuzz.settings import effort


@pytest.fixture(autouse=True)
def _elsewhere(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)


@effort(8)
@given(machines())
def test_machine_gives_a_right_result(source):
    assert outcome(source) == "right", source


@effort(15)
@given(damaged())
def test_damaged_machine_says_where(source):
    outcome(source)


@effort(15)
@given(constructed())
def test_component_of_any_values_says_what_is_wrong(source):
    outcome(source)


@effort(15)
@given(options())
def test_simulation_with_any_options_says_what_is_wrong(source):
    outcome(source)
