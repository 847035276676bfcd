"""Tests of scenes with each method of integration, each in a run of pytest of its own."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

import pytest

HERE = Path(__file__).parent
# What is said of the default is not said of the others.
DEFAULTS = "test_defaults_break_where_the_torque_does_and_cost_little"
METHODS = {
    "idas": DEFAULTS,
    # The core alone does not pass the flat position of n-four-bar: it refuses it.
    "rosenbrock": f"{DEFAULTS} or n-four-bar",
}
pytestmark = pytest.mark.slow


def passes(*arguments: str) -> None:
    command = [sys.executable, "-m", "pytest", "-q", "-q", "-p", "no:cacheprovider", *arguments]
    done = subprocess.run(command, cwd=HERE.parent, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stdout[-10000:]


@pytest.mark.parametrize("method", METHODS)
def test_scenes_with_each_method(method):
    passes("tests/models", "--method", method, "-k", f"not ({METHODS[method]})")
