"""Result: the trajectories of a simulation, read by the names of the model."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping
from copy import deepcopy
from pathlib import Path
from typing import TYPE_CHECKING, Any, cast

import numpy as np

from acausal.errors import DeclarationError, caution
from acausal.language.call_arguments import checked_arguments
from acausal.language.component import Component
from acausal.locks import exclusive
from acausal.result.evaluation import read
from acausal.result.invalid_values import invalid_values
from acausal.result.lookup import Key, Quantity, check_columns, find, has_time, names
from acausal.result.pictures import Pictures
from acausal.result.plots import Series, curves, draw, finish
from acausal.result.snapshot import Snapshot, take_snapshot
from acausal.result.statistics import Statistics
from acausal.result.tables import write_csv

if TYPE_CHECKING:
    import pandas as pd
    from matplotlib.figure import Figure


class Result(Pictures):
    """Every variable and parameter of a run over time.

    A pickled result does not need the model's classes: it is read by name alone.

    Parameters
    ----------
    time : array, shape (times,)
        In s, read-only as all arrays of a result.
    evaluate : callable
        Function from a column of n expressions in the model's symbols to an array of shape (times, n).
    tree : Component or Snapshot
        The bound model, whose attributes hold the symbols; or a snapshot.
    outputs : tuple of str
        Names of the model's outputs, the columns of its table.
    stats : mapping
        Sizes, counts and seconds of the run.
    title : str
        Title of plots.
    more : Snapshot, optional
        Further quantities that are not of the model.

    Examples
    --------
    >>> result["beam.frame_b.r_0"], result[model.beam.frame_b.r_0]  # doctest: +SKIP
    >>> result["beam.volume[2].q"], result["frame_b.R.T[0,1]"]  # doctest: +SKIP
    """

    def __init__(
        self,
        time: np.ndarray,
        evaluate: Callable[[Any], np.ndarray],
        tree: Any,
        outputs: tuple[str, ...],
        stats: Mapping[str, Any],
        title: str = "",
        more: Snapshot | None = None,
    ) -> None:
        self.time = np.array(time, dtype=float)
        self.time.setflags(write=False)  # all arrays of a result are cached, so none may be changed
        self.tree = tree
        self.outputs = tuple(outputs)
        self._stats = stats if isinstance(stats, Statistics) else Statistics(**stats)
        self.title = title
        self._evaluate = evaluate
        self._more = more
        self._arrays = {"time": self.time} if not has_time(tree) else {}
        self._warned: set[str] = set()

    @property
    def stats(self) -> Statistics:
        """Sizes, counts and seconds of the run."""
        count = getattr(self._evaluate, "evaluations", None)
        return self._stats if count is None else self._stats.changed(consistent_evaluations=count)

    def with_stats(self, **values: Any) -> Result:
        """Return the same result with other statistics."""
        stats = self.stats.changed(**values)
        return Result(self.time, self._evaluate, self.tree, self.outputs, stats, self.title, self._more)

    def __repr__(self) -> str:
        span = f", {self.time[0]:g} to {self.time[-1]:g} s" if self.time.size else ""
        return f"Result({self.title or self._model}: {self.time.size} times{span})"

    @property
    def _model(self) -> str:
        return self.tree.model if isinstance(self.tree, Snapshot) else type(self.tree).__name__

    @exclusive
    def __reduce__(self) -> tuple[Any, ...]:
        """Pickle the values of all quantities, without the model."""
        live = isinstance(self.tree, Component)
        snapshot = take_snapshot(self.tree, self._evaluate, self.time.size) if live else self.tree
        snapshot = snapshot.joined(self._more) if self._more else snapshot
        return _loaded, (self.time, snapshot, self.outputs, self.stats, self.title)

    def __copy__(self) -> Result:
        return Result(self.time, self._evaluate, self.tree, self.outputs, self.stats, self.title, self._more)

    def __deepcopy__(self, memo: dict[int, Any]) -> Result:
        # The model and its values are immutable and shared.
        own = deepcopy(self._stats, memo)
        return Result(self.time.copy(), self._evaluate, self.tree, self.outputs, own, self.title, self._more)

    @exclusive
    def __getitem__(self, key: Key) -> np.ndarray:
        """Return a quantity over time.

        Parameters
        ----------
        key : str, Path or Expr
            Path ("beam.q[3]"), attribute of the model (model.beam.q) or expression of `tree`'s symbols.

        Returns
        -------
        array, shape (times, *shape)
            In SI units, read-only because it is cached.

        Raises
        ------
        DeclarationError
            If the model has no such variable; the message names the nearest ones.
        """
        return self._arrays_of([key])[0][1]

    def __contains__(self, key: object) -> bool:
        try:
            self._find(cast("Key", key))
        except DeclarationError:
            return False
        return True

    def __iter__(self) -> Iterator[str]:
        return iter([*names(self.tree), *(self._more.names if self._more else ())])

    def _ipython_key_completions_(self) -> list[str]:
        return list(self)

    @checked_arguments
    @exclusive
    def series(self, *keys: Key) -> list[Series]:
        """Return scalars with name and unit; arrays entry by entry, `name[0]`, `name[1]`, ...

        Parameters
        ----------
        *keys : str, Path or Expr
            Quantities to read; the outputs if none are given.
        """
        return [
            Series(name, unit, array[(slice(None), *index)])
            for quantity, array in self._arrays_of(keys or self.outputs)
            for index, name, unit in quantity.entries
        ]

    def not_finite(self, *keys: Key) -> dict[str, float]:
        """Return the scalars that are not finite somewhere, each with the first such time in s.

        Parameters
        ----------
        *keys : str, Path or Expr
            Quantities to check; the outputs if none are given.
        """
        return {
            s.name: float(self.time[k]) for s in self.series(*keys) for k in np.flatnonzero(~np.isfinite(s.values))[:1]
        }

    @checked_arguments
    def to_csv(self, path: str | Path, *keys: Key) -> None:
        """Write a table, `time` first, then the outputs or `keys`, with all digits.

        Raises
        ------
        ExportError
            If the file cannot be written; an existing file of that name stays unchanged.
        """
        write_csv(path, self._columns(keys))

    @checked_arguments
    def to_dataframe(self, *keys: Key) -> pd.DataFrame:
        """Return a table, `time` first, then the outputs or `keys`."""
        import pandas as pd

        return pd.DataFrame(self._columns(keys))

    @checked_arguments
    @exclusive
    def plot(
        self, *keys: Key, x: Key | None = None, path: str | Path | None = None, show: bool | None = None
    ) -> Figure:
        """Draw the outputs or `keys` over time or `x`, one axes for each unit.

        Parameters
        ----------
        *keys : str, Path or Expr
            Quantities to plot; the outputs if none are given.
        x : str, Path or Expr, optional
            A scalar over which they are drawn, such as an angle for a phase plot.
        path : str or Path, optional
            Write the picture there; the suffix determines the format.
        show : bool, optional
            True opens the picture in the system's viewer.

        Returns
        -------
        Figure
            A figure of matplotlib, to be changed and saved.
        """
        return finish(draw(curves(self, keys, x), self.title), path, show)

    def _beside(self, key: object) -> bool:
        """Return whether a key names a quantity that is not of the model."""
        return self._more is not None and isinstance(key, str | Path) and self._more.holds(str(key))

    def _find(self, key: Key) -> Quantity:
        """Return the quantity of a key, of the model or beside it."""
        return find(self._more if self._more and self._beside(key) else self.tree, key)

    def _columns(self, keys: Iterable[Key]) -> dict[str, np.ndarray]:
        check_columns(self.tree, [key for key in keys or self.outputs if not self._beside(key)])
        return {"time": self.time} | {s.name: s.values for s in self.series(*keys)}

    def _arrays_of(self, keys: Iterable[Key]) -> list[tuple[Quantity, np.ndarray]]:
        """Return quantities with their arrays, and warn of values that are not finite, once per quantity."""
        quantities = [self._find(key) for key in keys]
        found = list(zip(quantities, self._read(quantities), strict=True))
        for quantity, array in found:
            if quantity.name not in self._warned and not np.isfinite(array).all():
                self._warned.add(quantity.name)
                why = getattr(self._evaluate, "why", None) if quantity.declared else None
                caution(invalid_values(quantity, array, self.time, why))
        return found

    def _read(self, quantities: list[Quantity]) -> list[np.ndarray]:
        """Return the arrays of quantities; new ones are computed in one call."""
        new = [q for q in quantities if not (q.declared and q.name in self._arrays)]
        arrays = read(new, self._evaluate, self.tree if isinstance(self.tree, Snapshot) else self._more, self.time.size)
        self._arrays |= {q.name: array for q, array in arrays.items() if q.declared}
        return [arrays[q] if q in arrays else self._arrays[q.name] for q in quantities]


def _loaded(time: np.ndarray, snapshot: Snapshot, outputs: tuple[str, ...], stats: Statistics, title: str) -> Result:
    return Result(time, snapshot.evaluate, snapshot, outputs, stats, title)
