"""table(): interpolated values in equations."""

from __future__ import annotations

from functools import partial
from typing import Any

import casadi as ca
import numpy as np

from acausal.core.lookups import find, load
from acausal.errors import DeclarationError
from acausal.language.call_arguments import checked_call
from acausal.language.condition import Condition
from acausal.language.expression import Expr, as_expr, is_deferred
from acausal.language.fields import Deferred
from acausal.language.functions import time
from acausal.language.pending import PENDING, Pending
from acausal.language.table import Table
from acausal.language.table_columns import NEVER
from acausal.language.value_checks import shown
from acausal.language.when_statements import Reinit, When
from acausal.symbols import stacked
from acausal.units import DIMENSIONLESS


@checked_call
def table(x: Any, data: Any, *, events: bool = False) -> Any:
    """Return the interpolated values of a table.

    Where the argument is linear in time, steps end at the points of a "linear" table, and jumps are time events. Elsewhere
    error control alone meets the points.

    Parameters
    ----------
    x : Expr, or a pair of them
        Scalar argument, one for each abscissa of the table.
    data : Table
        The points: a field `structural("...", cls=Table)`, whose numbers can be changed after compiling, or a table itself.
    events : bool
        True for an event at each point that an argument passes which is not linear in time.

    Returns
    -------
    Expr
        One value, or a vector of them if the table has several columns; of any unit.

    Raises
    ------
    DeclarationError
        If the table jumps, and the argument is not linear in time.

    Examples
    --------
    >>> yield self.s == table(self.phi, self.profile)  # doctest: +SKIP
    """
    arguments = x if isinstance(x, tuple | list) else (x,)
    if is_deferred(*arguments, data) or PENDING.get(None) is None:
        return Deferred(partial(_table, len(arguments), bool(events)), (*arguments, data))
    return _table(len(arguments), bool(events), *arguments, data)


def _table(n: int, events: bool, *given: Any) -> Expr:
    data, arguments = given[n], [as_expr(x) for x in given[:n]]
    if not isinstance(data, Table):
        raise DeclarationError(f"table() needs a Table, as in table(self.s, Table([0, 1], [0, 2])), not {shown(data)}.")
    if len(data.axes) != n or any(x.shape for x in arguments):
        raise DeclarationError(
            f"this table takes {len(data.axes)} scalar argument{'s' * (len(data.axes) > 1)}; "
            f"table() has {n}{' of another shape' if len(data.axes) == n else ''}."
        )
    lookup = _Lookup(PENDING.get(), data, events)
    rows, local = zip(*(lookup.row(k, x.sx) for k, x in enumerate(arguments)), strict=True)
    if n == 2:
        cell = rows[0] * load(ca.SX(2), lookup.number + 5) + rows[1]
        inner = [lookup.polynomial(cell, k, local[1]) for k in range(4)]
        return Expr(_horner(inner, local[0]))
    values = [lookup.polynomial(rows[0], k, local[0]) for k in range(max(1, data.width))]
    return Expr(stacked(values), shape=(data.width,) if data.width else ())


class _Lookup:
    """Lookup in the columns of a table, see `Table.columns`.

    Parameters
    ----------
    pending : Pending
        Requests of the equations.
    data : Table
        The table.
    events : bool
        Whether its points are events.
    """

    def __init__(self, pending: Pending, data: Table, events: bool) -> None:
        self.pending, self.data, self.number, self.events = pending, data, pending.table(data), events

    def row(self, axis: int, x: ca.SX) -> tuple[ca.SX, ca.SX]:
        """Return the row of the coefficients, and the argument of the polynomials."""
        first, rate = self.number + 3 * axis, _rate(self.pending, x)
        if self.data.has_jumps:
            return self._row_of_piece(x, rate)
        if self.data.extrapolation == "periodic":
            start, period = (load(ca.SX(k), first + 2) for k in (0, 1))
            x = x - period * ca.floor((x - start) / period)
        row = self._found(first, x, rate)
        return row, x - load(row, first + 1)

    def polynomial(self, row: ca.SX, k: int, u: ca.SX) -> ca.SX:
        """Return the cubic number k, whose coefficients stand in four columns."""
        first = self.number + 3 * len(self.data.axes) + 4 * k
        return _horner([load(row, first + power) for power in range(4)], u)

    def _found(self, first: ca.SX, x: ca.SX, rate: ca.SX | None) -> ca.SX:
        if self.events and rate is None:
            return self._watched(first, x)
        row = find(x, first)
        if rate is not None and self.data.kind != "constant":
            after = load(ca.if_else(rate > 0, row, row - 1), first)
            self.pending.kinks.append((self.number, time.sx + (after - x) / rate))
        return row

    def _watched(self, first: ca.SX, x: ca.SX) -> ca.SX:
        """Return the row as a discrete variable, which changes where the argument passes a point."""
        row = Expr(ca.SX.sym(f"{self.number.name()} row"), DIMENSIONLESS)
        above, below = load(row.sx, first), load(row.sx - 1, first)
        above, below = ca.if_else(above <= NEVER, above, NEVER), ca.if_else(below >= -NEVER, below, -NEVER)
        rises = When(
            Condition(Expr(above - x), "<="), (Reinit(row, Expr(ca.fmax(row.sx + 1, find(x, first)))),), at_start=False
        )
        falls = When(
            Condition(Expr(x - below), "<"), (Reinit(row, Expr(ca.fmin(row.sx - 1, find(x, first)))),), at_start=False
        )
        self.pending.remember([row], [find(x, first)], rises, falls)
        return row.sx

    def _row_of_piece(self, x: ca.SX, rate: ca.SX | None) -> tuple[ca.SX, ca.SX]:
        """Return the same of a table with jumps: a discrete variable counts its pieces, another one its periods."""
        data, number = self.data, self.number
        if rate is None or (rate.is_constant() and float(rate) < 0):
            raise DeclarationError(
                f"{data!r} jumps, which is for arguments that grow linearly in time. Give its points different abscissae "
                "and values that meet, or another kind."
            )
        x, periodic = ca.if_else(rate > 0, x, np.nan), data.extrapolation == "periodic"
        ends = number + 3 + 4 * max(1, data.width)
        piece, turn = (Expr(ca.SX.sym(f"{number.name()} {word}"), DIMENSIONLESS) for word in ("piece", "turn"))
        start, period = (load(ca.SX(k), number + 2) for k in (0, 1))
        local = x - turn.sx * period if periodic else x
        first = ca.floor((x - start) / period) if periodic else ca.SX(0)
        is_last = ca.logic_not(load(piece.sx + 1, ends) <= NEVER)  # no number behind the last piece
        after = Expr(ca.if_else(is_last, 0, piece.sx + 1)), Expr(turn.sx + is_last)
        jumps = tuple(Reinit(*pair) for pair in zip((piece, turn), after, strict=True))
        due = Condition(Expr(load(piece.sx, ends) - local), "<=")
        starts = [find(x - first * period, ends), first]
        self.pending.remember([piece, turn], starts, When(due, jumps, at_start=False))
        row = self._found(number, local, rate)
        row = ca.fmin(ca.fmax(row, load(piece.sx, ends + 1)), load(piece.sx, ends + 2))
        return row, local - load(row, number + 1)


def _rate(pending: Pending, x: ca.SX) -> ca.SX | None:
    """Return the derivative by time of an argument that is linear in it, None for others."""
    symbols = {s.element_hash() for s in ca.symvar(x)}
    if time.sx.element_hash() not in symbols or symbols & pending.varying or any(ca.which_depends(x, time.sx, 2)):
        return None
    return ca.jtimes(x, time.sx, ca.SX(1))


def _horner(c: list[ca.SX], u: ca.SX) -> ca.SX:
    return c[0] + u * (c[1] + u * (c[2] + u * c[3]))
