"""What many tests share: models that are compiled once in a process, and choices of combinations."""

from __future__ import annotations

from collections.abc import Callable
from functools import cache
from itertools import combinations, product
from typing import Any

import pytest

import acausal as ac


@cache
def compiled(make: Callable[..., Any], **values: Any) -> ac.CompiledModel:
    """Return a model, compiled; values that can be hashed are those of its class."""
    return ac.compile(make(**values))


def pairwise(*choices: list | tuple) -> list:
    """All combinations; those beyond a few in which every pair of choices occurs are marked slow."""
    every = list(product(*(range(len(values)) for values in choices)))
    pairs = {one: set(combinations(enumerate(one), 2)) for one in every}
    left, few = set().union(*pairs.values()), []
    while left:
        few.append(max(every, key=lambda one: len(pairs[one] & left)))
        left -= pairs[few[-1]]
    return [
        pytest.param(*(v[k] for v, k in zip(choices, one, strict=True)), marks=() if one in few else pytest.mark.slow)
        for one in every
    ]
