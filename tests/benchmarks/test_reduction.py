"""Large bodies are reduced within a minute of a processor and 4 GB."""

import pytest

from tests.benchmarks.reduction import BODIES, apart


@pytest.mark.slow
@pytest.mark.parametrize("name", BODIES)
def test_time_and_memory(name: str) -> None:
    row = apart(name, "mean-axis")
    assert row["assembly"] + row["reduction"] < 60
    assert row["memory"] < 4
