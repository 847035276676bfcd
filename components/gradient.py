"""Derivative of an expression with respect to a variable."""

from __future__ import annotations

import casadi as ca

from acausal import Expr


def gradient(value: Expr, of: Expr) -> Expr:
    """Derivative of a scalar or vector with respect to a scalar or vector, shape (*value.shape, *of.shape).

    Parameters
    ----------
    value : Expr
        Function of the entries of `of`.
    of : Expr
        Variable of a component.
    """
    slopes = ca.jacobian(value.sx, of.sx)
    if value.shape or of.shape:
        return Expr(slopes if value.shape else slopes.T, shape=(*value.shape, *of.shape))
    return Expr(slopes, (value / of).unit)
