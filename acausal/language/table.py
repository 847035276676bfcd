"""Table: points and how to interpolate between them."""

from __future__ import annotations

import os
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Any, ClassVar

import numpy as np

from acausal.core.columns import COLUMNS
from acausal.errors import DeclarationError
from acausal.language import interpolation
from acausal.language import table_columns as parts
from acausal.language.column_files import read_csv
from acausal.language.value_checks import shown

EXTRAPOLATIONS = ("hold", "linear", "periodic", "refuse")
SURFACES = ("constant", "linear", "akima")


@dataclass(frozen=True, eq=False)
class Table:
    """Values at points of one abscissa or two, and how to interpolate between them.

    Parameters
    ----------
    x : array, shape (n,), or two arrays, shapes (n,), (m,)
        Abscissae, ascending. Two that are equal are a jump, from which the second value holds.
    values : array, shape (n,), (n, k) or (n, m)
        Numbers, or rows of k numbers; of two abscissae the value at each pair.
    kind : str
        "constant" (each value up to the next point), "linear", "akima", "modified_akima", "fritsch_butland" and "steffen"
        (monotone between the points), or "cubic" (spline of continuous curvature). Of two abscissae "constant", "linear" or
        "akima".
    extrapolation : str
        Beyond the points: "hold" the last value, "linear" with the slope at the end (of "constant" through the last two
        points), "periodic", or "refuse".
    ends : str
        Of "cubic": "natural" (no curvature), "clamped" (no slope) or "periodic".

    Raises
    ------
    DeclarationError
        The points are not ascending, not finite, or do not match the values; an option is unknown.

    Examples
    --------
    >>> Table([0, 1, 2], [0, 1, 4], kind="akima")(1.5)
    2.125
    """

    x: Any
    values: Any
    kind: str = "linear"
    extrapolation: str = "hold"
    ends: str = "natural"
    path: ClassVar[str] = ""  # of the field of a built model

    def __post_init__(self) -> None:
        pair = isinstance(self.x, tuple) and len(self.x) == 2 and all(np.ndim(part) == 1 for part in self.x)
        x = tuple(map(_numbers, self.x)) if pair else _numbers(self.x)
        values = _numbers(self.values)
        object.__setattr__(self, "x", x)
        object.__setattr__(self, "values", values)
        self._check_options()
        for part in x if isinstance(x, tuple) else (x,):
            _check_ascending(part, least=2 if isinstance(x, tuple) else 1)
        wanted = tuple(map(len, x)) if isinstance(x, tuple) else (len(x), *values.shape[1:2])
        if values.shape != wanted:
            raise DeclarationError(
                f"a table has a value for each point: its points have shape {wanted}, its values {values.shape}."
            )

    def _check_options(self) -> None:
        kinds = SURFACES if isinstance(self.x, tuple) else interpolation.KINDS
        for name, value, known in (
            ("kind", self.kind, kinds),
            ("extrapolation", self.extrapolation, EXTRAPOLATIONS),
            ("ends", self.ends, interpolation.ENDS),
        ):
            if value not in known:
                raise DeclarationError(f"{name} of a table is {shown(value)}; it is one of {', '.join(known)}.")
        if isinstance(self.x, tuple) and self.kind == "constant" and self.extrapolation == "linear":
            raise DeclarationError("a constant table of two abscissae is not extrapolated linearly.")
        if self.kind == "cubic" and self.ends == "periodic" and not np.allclose(self.values[0], self.values[-1]):
            raise DeclarationError("a periodic table has one value at both ends; its values differ.")

    def __eq__(self, other: object) -> bool:
        return (
            isinstance(other, Table)
            and self.settings == other.settings
            and all(map(np.array_equal, self.parts, other.parts))
        )

    __hash__ = None  # type: ignore[assignment]

    def __reduce__(self) -> tuple[Any, ...]:
        return Table, (self.x, self.values, self.kind, self.extrapolation, self.ends)

    def __repr__(self) -> str:
        points = " x ".join(str(len(part)) for part in self.axes)
        return f"<Table of {points} points, {self.kind}, {self.extrapolation}>"

    @property
    def axes(self) -> tuple[np.ndarray, ...]:
        """The abscissae, one or two."""
        return self.x if isinstance(self.x, tuple) else (self.x,)

    @property
    def parts(self) -> tuple[np.ndarray, ...]:
        """All numbers."""
        return *self.axes, self.values

    @property
    def settings(self) -> tuple[Any, ...]:
        """What equations depend on: kind, extrapolation, ends, number of abscissae, number of values, and whether it jumps."""
        return self.kind, self.extrapolation, self.ends, len(self.axes), self.width, self.has_jumps

    @property
    def width(self) -> int:
        """Number of values at a point, 0 for a number."""
        return self.values.shape[1] if len(self.axes) == 1 and self.values.ndim == 2 else 0

    @property
    def jumps(self) -> np.ndarray:
        """Abscissae of jumps, between those of the ends."""
        if len(self.axes) == 2:
            return np.zeros(0)
        return self.x[1:] if self.kind == "constant" else self.x[1:][np.diff(self.x) == 0]

    @property
    def has_jumps(self) -> bool:
        """Whether it jumps, within a period or to the next one."""
        wraps = self.extrapolation == "periodic" and not np.array_equal(self.values[0], self.values[-1])
        return self.jumps.size > 0 or (wraps and len(self.axes) == 1)

    @cached_property
    def number(self) -> int:
        """Number of the first column in this process, as long as this table lasts."""
        return COLUMNS.add(self, self.columns)

    @classmethod
    def load(cls, path: str | os.PathLike[str]) -> Table:
        """Read a table from a CSV file: the first column holds the points, the others the values; see `from_csv`."""
        return cls.from_csv(path)

    @classmethod
    def from_csv(
        cls,
        path: str | os.PathLike[str],
        values: str | Sequence[str] | None = None,
        x: str | None = None,
        **options: Any,
    ) -> Table:
        """Read a table from a CSV file with a row of names, or with numbers alone.

        Parameters
        ----------
        path : str or Path
            The file; its delimiter is a comma, a semicolon or a tab.
        values : str or sequence of str, optional
            Columns of the values; by default all others.
        x : str, optional
            Column of the points; by default `time` if there is one, else the first.
        **options
            As of the class: kind, extrapolation, ends.

        Raises
        ------
        DeclarationError
            The file has no such column, or an entry is not a number.
        """
        return cls.from_columns(read_csv(path), values, x, **options)

    @classmethod
    def from_mat(cls, path: str | os.PathLike[str], name: str, **options: Any) -> Table:
        """Read a table from a MAT file (version 7 or older): a matrix whose first column holds the points."""
        from scipy.io import loadmat

        found = loadmat(path, variable_names=[name])
        if name not in found:
            raise DeclarationError(f"{os.fspath(path)} holds no matrix `{name}`.")
        rows = np.asarray(found[name], dtype=float)
        return cls(rows[:, 0], rows[:, 1] if rows.shape[1] == 2 else rows[:, 1:], **options)

    @classmethod
    def from_pandas(cls, data: Any, **options: Any) -> Table:
        """Make a table of a Series or a DataFrame, whose index holds the points."""
        index = data.index
        if hasattr(index, "total_seconds"):
            index = index.total_seconds()
        return cls(np.asarray(index, dtype=float), np.asarray(data, dtype=float), **options)

    @classmethod
    def from_columns(
        cls,
        columns: Mapping[str, np.ndarray],
        values: str | Sequence[str] | None = None,
        x: str | None = None,
        **options: Any,
    ) -> Table:
        """Make a table of columns by name; for the arguments see `from_csv`."""
        x = x or ("time" if "time" in columns else next(iter(columns)))
        wanted = [name for name in columns if name != x] if values is None else values
        for name in [x, *([wanted] if isinstance(wanted, str) else wanted)]:
            if name not in columns:
                raise DeclarationError(f"there is no column `{name}`; the columns are {', '.join(columns)}.")
        if isinstance(wanted, str) or len(wanted) == 1:
            return cls(columns[x], columns[wanted if isinstance(wanted, str) else wanted[0]], **options)
        return cls(columns[x], np.stack([columns[name] for name in wanted], axis=1), **options)

    def at(self, path: str) -> Table:
        """Return an equal table that is the value of a field."""
        found = replace(self)
        object.__setattr__(found, "path", path)
        return found

    @cached_property
    def columns(self) -> tuple[np.ndarray, ...]:
        """Columns as the core looks them up, each with its length first.

        Of each abscissa: where to search, origins of the polynomials, then start, period and number of rows. Then the
        coefficients; and of pieces between jumps where they end, and their first and last rows.
        """
        found = [column for axis in self.axes for column in parts.search(axis, self.kind, self.extrapolation)]
        if len(self.axes) == 2:
            c = parts.surface(*self.axes, self.values, self.kind, self.extrapolation)
        else:
            c = parts.curve(self.x, self.values.reshape(len(self.x), -1), self.kind, self.extrapolation, self.ends)
        found += list(c.T)
        found += parts.pieces(self.x, self.jumps, self.extrapolation == "periodic") if self.has_jumps else []
        return tuple(np.concatenate([[len(column)], column]).astype(float) for column in found)

    def __call__(self, *x: Any) -> Any:
        """Return the values at numbers, one argument for each abscissa; for arrays, an array of them."""
        at = np.broadcast_arrays(*(np.asarray(part, dtype=float) for part in x))
        rows, local = zip(*(self._row(k, part) for k, part in enumerate(at)), strict=True)
        powers = [part[..., None] ** np.arange(4) for part in local]
        if len(rows) == 2:
            c = self._coefficients[rows[0] * (len(self.axes[1]) + 1) + rows[1]].reshape(*at[0].shape, 4, 4)
            found = np.einsum("...kl,...k,...l->...", c, *powers)
        else:
            c = self._coefficients[rows[0]].reshape(*at[0].shape, -1, 4)
            found = np.einsum("...mk,...k->...m", c, powers[0])
            found = found if self.width else found[..., 0]
        return found if found.ndim else float(found)

    @property
    def _coefficients(self) -> np.ndarray:
        first = 3 * len(self.axes)
        last = first + (16 if len(self.axes) == 2 else 4 * max(1, self.width))
        return np.stack([column[1:] for column in self.columns[first:last]], axis=-1)

    def _row(self, axis: int, x: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        search, origin, (start, period, _) = (column[1:] for column in self.columns[3 * axis : 3 * axis + 3])
        if self.extrapolation == "periodic":
            x = x - period * np.floor((x - start) / period)
        row = np.searchsorted(search, x, side="right")
        return row, x - origin[row]


def _numbers(values: Any) -> np.ndarray:
    try:
        found = np.array(values, dtype=float)
    except (TypeError, ValueError):
        raise DeclarationError(f"a table has arrays of numbers, not {shown(values)}.") from None
    if not np.all(np.isfinite(found)):
        raise DeclarationError("a table has finite numbers; remove the rows with others.")
    found.setflags(write=False)
    return found


def _check_ascending(x: np.ndarray, least: int) -> None:
    if x.ndim != 1 or len(x) < least:
        raise DeclarationError(f"the points of a table are an array of at least {least} of them.")
    twice = least == 1
    steps = np.diff(x)
    wrong = np.flatnonzero(steps < 0 if twice else steps <= 0)
    thrice = np.flatnonzero((steps[1:] == 0) & (steps[:-1] == 0)) if twice else []
    if len(wrong):
        k = int(wrong[0])
        raise DeclarationError(f"the points of a table ascend; after {x[k]:g} comes {x[k + 1]:g}, in row {k + 1}.")
    if len(thrice):
        raise DeclarationError(f"three points of a table are {x[int(thrice[0])]:g}; two that are equal are a jump.")
