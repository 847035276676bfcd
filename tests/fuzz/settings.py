"""How long to search: the same few examples in each run of the tests, others and more when asked for.

`FUZZ=10000 python -m pytest -n0 tests/fuzz -k machine` searches at random, that many times.
"""

from __future__ import annotations

import os
from collections.abc import Callable
from typing import Any

from hypothesis import HealthCheck, Phase, settings

FUZZ = int(os.environ.get("FUZZ", "0"))


def effort(examples: int) -> Callable[[Any], Any]:
    """Return the settings of a test that takes some examples."""
    return settings(
        max_examples=FUZZ or examples,
        derandomize=not FUZZ,
        database=None,
        deadline=None,
        phases=[Phase.generate, Phase.shrink] if FUZZ else [Phase.generate],
        suppress_health_check=[HealthCheck.too_slow, HealthCheck.data_too_large, HealthCheck.filter_too_much],
    )
