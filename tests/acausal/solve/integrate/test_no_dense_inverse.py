"""What rounding does to algebraic unknowns is found without inverting their Jacobian."""

from __future__ import annotations

from collections.abc import Callable
from functools import partial
from itertools import product
from typing import Any

import numpy as np
import pytest
import scipy.linalg

import acausal as ac
from acausal import Model
from models import FlexiblePendulum, SliderCrank, SpinUp


@pytest.mark.parametrize(
    "model",
    [SpinUp(volumes=8), FlexiblePendulum(), SliderCrank(crank="rigid")],
    ids=lambda model: type(model).__name__,
)
def test_small_tolerances_invert_no_matrix(model: Model, monkeypatch: pytest.MonkeyPatch) -> None:
    compiled, sizes = ac.compile(model), list[int]()

    def counted(invert: Callable[..., Any], matrix: Any, *more: Any, **named: Any) -> Any:
        sizes.append(len(matrix))
        return invert(matrix, *more, **named)

    for module, name in product((np.linalg, scipy.linalg), ("inv", "pinv")):
        monkeypatch.setattr(module, name, partial(counted, getattr(module, name)))
    ac.simulate(compiled, stop_time=1e-3, intervals=2, tolerance=1e-9)
    assert compiled.nz > 20
    assert max(sizes, default=0) < compiled.nz
