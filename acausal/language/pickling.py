"""Pickling of expressions: serialised with the symbols that exist in every process."""

from __future__ import annotations

from typing import Any

import casadi as ca

from acausal.errors import DeclarationError
from acausal.language.expression import Expr, Unit
from acausal.language.functions import feedback, initial, time


def serialize(sx: ca.SX) -> str:
    """Serialise an expression of time and numbers.

    Parameters
    ----------
    sx : casadi.SX
        Expression without symbols of a built model.

    Raises
    ------
    DeclarationError
        If it contains other symbols.
    """
    known = {own.sx.element_hash() for own in (time, initial, feedback)}
    others = [s.name() for s in ca.symvar(sx) if s.element_hash() not in known]
    if others:
        raise DeclarationError(
            f"an expression of `{others[0]}` cannot be pickled: its symbols belong to one built model. Pickle names or "
            "values, result[...]."
        )
    return ca.Function("e", [time.sx, initial.sx, feedback.sx], [sx]).serialize()


def deserialize(serialized: str) -> ca.SX:
    """Return an expression from `serialize` in the symbols of this process."""
    found: ca.SX = ca.Function.deserialize(serialized)(time.sx, initial.sx, feedback.sx)  # type: ignore[assignment]
    return found


def reduce_expression(value: Expr) -> tuple[Any, ...]:
    """Return what `copyreg` needs to pickle an expression of time and numbers; others raise DeclarationError."""
    return rebuild_expression, (serialize(value.sx), value.unit, value.name, value.shape)


def rebuild_expression(serialized: str, unit: Unit, name: str, shape: tuple[int, ...]) -> Expr:
    """Return an unpickled expression.

    Parameters
    ----------
    serialized : str
        From `serialize`.
    unit, name, shape
        As for Expr.
    """
    own = {"time": time, "initial": initial, "feedback": feedback}
    return own[name] if name in own else Expr(deserialize(serialized), unit, name, shape)
