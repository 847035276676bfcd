"""Soft initial equations, which closed loops override."""

from __future__ import annotations

from typing import Any

from acausal.errors import DeclarationError
from acausal.language.call_arguments import checked_call
from acausal.language.expression import Equation


class Soft(Equation):
    """An initial equation that closed loops override, see `soft`."""


@checked_call
def soft(condition: Any) -> Soft:
    """State an initial equation that closed loops override; yield it in initial_equations().

    For example, an elastic part starts undeformed, except for the deformation that closes a loop.

    Parameters
    ----------
    condition : Equation
        Such as `self.q == 0`.

    Examples
    --------
    >>> yield soft(self.q == as_expr(np.zeros(3)))  # doctest: +SKIP
    """
    if not isinstance(condition, Equation):
        raise DeclarationError(f"soft() takes an equation, soft(a == b), not {condition!r}.")
    return Soft(condition.lhs, condition.rhs)
