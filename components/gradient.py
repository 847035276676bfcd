"""Derivatives of functions that users give as expressions."""

from __future__ import annotations

import casadi as ca

from acausal import Expr


def gradient(value: Expr, of: Expr) -> Expr:
    """Derivative of a scalar or vector by a vector, shape (*value.shape, len(of)).

    Parameters
    ----------
    value : Expr
        Made of the entries of `of`.
    of : Expr
        Variable of a component, a vector.
    """
    slopes = ca.jacobian(value.sx, of.sx)
    return Expr(slopes if value.shape else slopes.T, shape=(*value.shape, *of.shape))
