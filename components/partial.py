"""Partial derivatives of expressions."""

from __future__ import annotations

import casadi as ca

from acausal import Expr


def partial(y: Expr, x: Expr) -> Expr:
    """Partial derivative of a scalar expression with respect to a variable."""
    return Expr(ca.jacobian(y.sx, x.sx), (y / x).unit)
