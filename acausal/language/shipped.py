"""Expressions on their way to another process: text that contains only the symbols that all processes have."""

from __future__ import annotations

from typing import Any

import casadi as ca

from acausal.errors import DeclarationError
from acausal.language.expression import Expr, Unit
from acausal.language.functions import feedback, initial, time


def text(sx: ca.SX) -> str:
    """Write an expression of time and numbers.

    Parameters
    ----------
    sx : casadi.SX
        Without symbols of a built model.

    Raises
    ------
    DeclarationError
        If it holds other symbols.
    """
    known = {own.sx.element_hash() for own in (time, initial, feedback)}
    others = [s.name() for s in ca.symvar(sx) if s.element_hash() not in known]
    if others:
        raise DeclarationError(
            f"an expression of `{others[0]}` cannot be pickled: its symbols belong to one built model. Pickle names, or "
            "values: result[...]."
        )
    return ca.Function("e", [time.sx, initial.sx, feedback.sx], [sx]).serialize()


def symbols(written: str) -> ca.SX:
    """Read what `text` wrote, in the symbols of this process."""
    found: ca.SX = ca.Function.deserialize(written)(time.sx, initial.sx, feedback.sx)  # type: ignore[assignment]
    return found


def reduced(value: Expr) -> tuple[Any, ...]:
    """Return what a pickle of an expression holds; only one of time and numbers is meaningful elsewhere."""
    return expression, (text(value.sx), value.unit, value.name, value.shape)


def expression(written: str, unit: Unit, name: str, shape: tuple[int, ...]) -> Expr:
    """Return an expression of this process.

    Parameters
    ----------
    written : str
        From `text`.
    unit, name, shape
        As of Expr.
    """
    own = {"time": time, "initial": initial, "feedback": feedback}
    return own[name] if name in own else Expr(symbols(written), unit, name, shape)
