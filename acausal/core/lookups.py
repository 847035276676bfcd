"""Lookups of columns in CasADi's expressions: steps, whose derivatives are 0."""

from __future__ import annotations

from functools import cache
from typing import Any

import casadi as ca

from acausal.core.build.compiling import file_of, own_platform
from acausal.core.columns import COLUMNS
from acausal.instructions import FINDS, LOADS


@cache
def _function(name: str, symbol: str) -> ca.Function:
    """Return a function of the library for expressions; CasADi takes its derivatives from the given Jacobian."""
    _ = COLUMNS.address
    inside = ca.external(symbol, str(file_of(own_platform())))
    x, number, result = (ca.SX.sym(word) for word in ("x", "number", "result"))
    zeros = [ca.SX.zeros(1, 1), ca.SX.zeros(1, 1)]
    options: dict[str, Any] = {
        **{"never_inline": True, "enable_forward": False, "enable_reverse": False, "jac_penalty": 0},
        "custom_jacobian": ca.Function(f"jac_{name}", [x, number, result], zeros),
    }
    return ca.Function(name, [x, number], [inside(x, number)], options)


def find(x: ca.SX, number: ca.SX) -> ca.SX:
    """Return how many numbers of an ascending column are not above x."""
    return _function(FINDS, "ac_casadi_find")(x, number)


def load(place: ca.SX, number: ca.SX) -> ca.SX:
    """Return a number of a column by its place, counted from 0."""
    return _function(LOADS, "ac_casadi_load")(place, number)
