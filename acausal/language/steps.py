"""Minimum, maximum, limits, floor and modulo of expressions, with their events."""

from __future__ import annotations

from typing import Any

import casadi as ca

from acausal.errors import DeclarationError, UnitsError
from acausal.language import unit_rules
from acausal.language.call_arguments import checked_call
from acausal.language.condition import Condition
from acausal.language.expression import Expr, as_expr, is_deferred
from acausal.language.fields import Deferred
from acausal.language.functions import piecewise, sqrt, time
from acausal.language.pending import PENDING
from acausal.language.when_statements import Reinit, When
from acausal.units import DIMENSIONLESS

_TIME = time.sx.element_hash()


@checked_call
def maximum(a: Any, b: Any, *, smooth: Any = 0) -> Any:
    """Return the larger of two values.

    Parameters
    ----------
    a, b : float or Expr
        Scalars of one unit.
    smooth : float or Expr
        0: the integration stops where the other one becomes the larger. Else a value of the unit, by half of which the
        result is too large where both are equal: (a + b + sqrt((a - b)^2 + smooth^2)) / 2, without events.
    """
    if is_deferred(a, b, smooth):
        return Deferred(_maximum, (a, b, smooth))
    return _maximum(a, b, smooth)


def _maximum(a: Any, b: Any, smooth: Any) -> Any:
    a, b = as_expr(a), as_expr(b)
    if isinstance(smooth, int | float) and smooth == 0:
        pending, symbols = PENDING.get(None), {s.element_hash() for s in ca.symvar(ca.vertcat(a.sx, b.sx))}
        if pending is None or symbols & pending.varying or _TIME in symbols:
            return piecewise((a, a > b), b)
        unit = unit_rules.common(a, b, "the arguments of maximum")
        return Expr(ca.fmax(a.sx, b.sx), unit)
    return (a + b + sqrt((a - b) ** 2 + smooth**2)) / 2


@checked_call
def minimum(a: Any, b: Any, *, smooth: Any = 0) -> Any:
    """Return the smaller of two values; for the arguments see `maximum`."""
    return -maximum(-a, -b, smooth=smooth)


@checked_call
def clip(x: Any, lower: Any, upper: Any, *, smooth: Any = 0) -> Any:
    """Return a value within limits.

    Parameters
    ----------
    x, lower, upper : float or Expr
        Scalars of one unit.
    smooth : float or Expr
        As of `maximum`.
    """
    if isinstance(smooth, int | float) and smooth == 0:
        return piecewise((upper, x > upper), (lower, x < lower), x)
    return minimum(maximum(x, lower, smooth=smooth), upper, smooth=smooth)


@checked_call
def floor(x: Any) -> Any:
    """Return the largest whole number that is not above a scalar; the integration stops where it changes."""
    if is_deferred(x) or PENDING.get(None) is None:
        return Deferred(floor, (x,))
    x, pending = as_expr(x), PENDING.get()
    if x.shape:
        raise DeclarationError(f"floor needs a scalar, not a value of shape {x.shape}.")
    if isinstance(x.unit, type(DIMENSIONLESS)) and x.unit != DIMENSIONLESS:
        raise UnitsError(f"floor needs a number, but {x!r} is in [{x.unit}].")
    if x.sx.is_constant() or not pending.watches:
        return Expr(ca.floor(x.sx), DIMENSIONLESS)
    whole = Expr(ca.SX.sym("floor"), DIMENSIONLESS, "floor")
    up = When(Condition(Expr(whole.sx + 1 - x.sx), "<="), (Reinit(whole, whole + 1),), at_start=False)
    down = When(Condition(Expr(x.sx - whole.sx), "<"), (Reinit(whole, whole - 1),), at_start=False)
    pending.remember([whole], [ca.floor(x.sx)], up, down)
    return whole


@checked_call
def mod(x: Any, y: Any) -> Any:
    """Return x - y floor(x / y), between 0 and y; the integration stops where it jumps.

    Parameters
    ----------
    x, y : float or Expr
        Scalars of one unit.
    """
    if is_deferred(x, y):
        return Deferred(mod, (x, y))
    x, y = as_expr(x), as_expr(y)
    unit_rules.common(x, y, "the arguments of mod")
    return x - y * floor(x / y)
