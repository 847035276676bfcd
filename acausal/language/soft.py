"""Initial equations that closed loops override."""

from __future__ import annotations

from typing import Any

from acausal.errors import DeclarationError
from acausal.language.call_arguments import checked_call
from acausal.language.expression import Equation


class Soft(Equation):
    """An initial equation that closed loops override, see `soft`."""


@checked_call
def soft(condition: Any) -> Soft:
    """Let closed loops override an initial equation; yield it in initial_equations().

    An elastic part starts undeformed, say, but for what it takes up of a loop that does not close with rigid parts.

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
