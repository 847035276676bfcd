"""SpeedTable: speed-dependent values of friction and losses."""

from __future__ import annotations

from contextlib import suppress
from itertools import pairwise
from typing import Any

import numpy as np

from acausal import DeclarationError, Expr, piecewise, quantity


class SpeedTable:
    """Values over a speed >= 0, with linear interpolation between the rows and linear extrapolation beyond the ends.

    Parameters
    ----------
    part, name : Component, str
        Part and name of its structural parameter that contains the table.
    units : tuple of str
        Units of the speed and of each value.

    Raises
    ------
    DeclarationError
        The parameter is neither rows (speed, values) of finite numbers, with ascending speeds from 0 on, nor, for a single
        value, a number.
    """

    def __init__(self, part: Any, name: str, *units: str) -> None:
        self.units, table = units, getattr(part, name)
        rows: Any = np.zeros(0)
        with suppress(TypeError, ValueError):
            rows = np.array(table, dtype=float)
        if rows.ndim == 0:
            rows = np.array([[0.0, float(rows)]])
        shaped = rows.ndim == 2 and len(rows) and rows.shape[1] == len(units)
        if not shaped or not np.all(np.isfinite(rows)) or rows[0, 0] < 0 or np.any(np.diff(rows[:, 0]) <= 0):
            values = "value" if len(units) == 2 else f"{len(units) - 1} values"
            raise DeclarationError(
                f"`{name}` of {part._path or type(part).__name__} is {table!r}; give rows (speed, {values}) of finite numbers, "
                "with ascending speeds from 0 on."
            )
        self.rows: Any = rows

    def at(self, speed: Expr, column: int = 1) -> Expr:
        """Return the value of a column at a speed."""
        points = [self._point(row, column) for row in self.rows]
        if np.ptp(self.rows[:, column]) == 0:
            return points[0][1]
        segments = [(b, ya + (yb - ya) / (b - a) * (speed - a)) for (a, ya), (b, yb) in pairwise(points)]
        return piecewise(*((y, speed < end) for end, y in segments[:-1]), segments[-1][1])

    def at_rest(self, column: int = 1) -> Expr:
        """Return the value of a column at zero speed."""
        (a, ya), (b, yb) = (self._point(self.rows[k], column) for k in (0, min(1, len(self.rows) - 1)))
        return ya if len(self.rows) == 1 else ya - (yb - ya) / (b - a) * a

    def _point(self, row: Any, column: int) -> tuple[Expr, Expr]:
        return quantity(row[0], self.units[0]), quantity(row[column], self.units[column])
