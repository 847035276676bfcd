"""Runs that begin anew: a compiled model keeps where its last run began, for the next one with equal parameters."""

from __future__ import annotations

from typing import Any

import acausal as ac
from acausal.solve.initialization.initial_point import shared_point


def run_anew(compiled: ac.CompiledModel, **how: Any) -> ac.Result:
    """Simulate as if no run had been before; what was compiled for runs stays."""
    compiled.memo.pop(vars(shared_point)["__wrapped__"], None)
    return ac.simulate(compiled, **how)
