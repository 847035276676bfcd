"""external(): values of functions of other libraries in equations."""

from __future__ import annotations

import ctypes
from collections.abc import Sequence
from functools import cached_property
from typing import Any

import casadi as ca
import numpy as np

from acausal.core.columns import COLUMNS
from acausal.core.externals import values_of
from acausal.errors import DeclarationError
from acausal.language.call_arguments import checked_call
from acausal.language.expression import Expr, as_expr
from acausal.language.pending import PENDING
from acausal.symbols import stacked


class External:
    """Function of another library: values of some arguments, with their first derivatives.

    Parameters
    ----------
    path : str
        Name, for messages.
    names : sequence of str
        What each value is, for messages.
    data : ctypes.Structure
        What the core calls; it begins as `ac_external` of `core.h`.
    """

    kind = "external"
    completes = False  # whether it is told of accepted steps
    error: Exception | None = None  # why it gave no value

    def __init__(self, path: str, names: Sequence[str], data: ctypes.Structure) -> None:
        self.path, self.names, self._data = path, tuple(names), data

    @property
    def settings(self) -> tuple[Any, ...]:
        """What equations depend on."""
        return self.kind, self.names

    @property
    def address(self) -> int:
        """Where the core finds it."""
        return ctypes.addressof(self._data)

    def next_kink(self, arguments: ca.SX, places: Sequence[int]) -> ca.SX | None:
        """Return the next time in s, after that among the arguments, at which these values have a kink; None for none."""
        return None

    @cached_property
    def number(self) -> int:
        """Number of the function in this process, as long as it lasts."""
        return COLUMNS.add(self, [np.frombuffer(self._data, dtype=np.uint8)])


ANY = float(np.finfo(float).max)


@checked_call
def external(function: External, arguments: Sequence[Any], places: Sequence[int]) -> Expr:
    """Return values of a function of another library.

    Parameters
    ----------
    function : External
        The function, one object for each part.
    arguments : sequence of Expr
        Scalars, vectors; None for a scalar on which these values do not depend.
    places : sequence of int
        Which values.

    Returns
    -------
    Expr
        The values, shape (n,), of any unit. They have first derivatives, no second ones.
    """
    if not isinstance(function, External):
        raise DeclarationError(f"external() needs a function of another library, not {function!r}.")
    given = stacked([ca.SX(ANY) if a is None else as_expr(a).sx for a in arguments])
    pending = PENDING.get()
    number = pending.table(function)
    if (kink := function.next_kink(given, places)) is not None:
        pending.kinks.append((number, kink))
    return Expr(values_of(number, given, places, len(function.names)), shape=(len(places),))
