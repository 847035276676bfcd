"""Result: what a simulation found, read by the names of the model."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any

import casadi as ca
import numpy as np

from acausal.language.component import Component
from acausal.result.files import write_csv
from acausal.result.lookup import Key, Quantity, find, names
from acausal.result.plots import Series, draw, save

if TYPE_CHECKING:
    import pandas as pd
    from matplotlib.figure import Figure


class Result:
    """Every variable and parameter of a run over time.

    Parameters
    ----------
    time : array, shape (times,)
        In s.
    evaluate : callable
        From a column of n expressions in the model's symbols to an array of shape (times, n).
    tree : Component
        The bound model, whose attributes hold the symbols.
    outputs : tuple of str
        Names of the model's outputs, the columns of its table.
    stats : mapping
        Sizes, counts and seconds of the run.
    title : str
        Title of plots.

    Examples
    --------
    >>> result["beam.frame_b.r_0"]  # doctest: +SKIP
    >>> result[model.beam.frame_b.r_0]  # doctest: +SKIP
    >>> result["beam.volume[2].q"], result["frame_b.R.T[0,1]"]  # doctest: +SKIP
    """

    def __init__(
        self,
        time: np.ndarray,
        evaluate: Callable[[ca.SX], np.ndarray],
        tree: Component,
        outputs: tuple[str, ...],
        stats: Mapping[str, Any],
        title: str = "",
    ) -> None:
        self.time = np.asarray(time, dtype=float)
        self.tree = tree
        self.outputs = tuple(outputs)
        self.stats = dict(stats)
        self.title = title
        self._evaluate = evaluate
        self._arrays = {"time": self.time} if "time" not in tree.fields else {}

    def __repr__(self) -> str:
        span = f", {self.time[0]:g} to {self.time[-1]:g} s" if self.time.size else ""
        return f"Result({self.title or type(self.tree).__name__}: {self.time.size} times{span})"

    def __getitem__(self, key: Key) -> np.ndarray:
        """Return a quantity over time.

        Parameters
        ----------
        key : str, Path or Expr
            Path ("beam.q[3]"), attribute of the model (model.beam.q) or expression of `tree`'s symbols.

        Returns
        -------
        array, shape (times, *shape)
            In SI units, read-only because it is kept.

        Raises
        ------
        DeclarationError
            If the model has no such variable; the message tells the nearest names.
        """
        return self._read([find(self.tree, key)])[0]

    def _ipython_key_completions_(self) -> list[str]:
        return names(self.tree)

    def series(self, *keys: Key) -> list[Series]:
        """Return scalars with name and unit; arrays entry by entry, `name[0]`, `name[1]`, ...

        Parameters
        ----------
        *keys : str, Path or Expr
            What to read; the outputs if there is none.
        """
        quantities = [find(self.tree, key) for key in keys or self.outputs]
        return [
            Series(name, unit, array[(slice(None), *index)])
            for quantity, array in zip(quantities, self._read(quantities), strict=True)
            for index, name, unit in quantity.entries
        ]

    def to_csv(self, path: str | Path, *keys: Key) -> None:
        """Write a table, `time` first, then the outputs or `keys`, with all digits.

        Raises
        ------
        ExportError
            If the file cannot be written; an old one of that name stays as it was.
        """
        write_csv(path, self._columns(keys))

    def to_dataframe(self, *keys: Key) -> pd.DataFrame:
        """Return a table, `time` first, then the outputs or `keys`."""
        import pandas as pd

        return pd.DataFrame(self._columns(keys))

    def plot(self, *keys: Key, path: str | Path | None = None, show: bool | None = None) -> Figure:
        """Draw the outputs or `keys` over time, one axes for each unit.

        Parameters
        ----------
        *keys : str, Path or Expr
            What to draw; the outputs if there is none.
        path : str or Path, optional
            Write the picture there; the ending tells the format.
        show : bool, optional
            True opens the picture in the system's viewer.

        Returns
        -------
        Figure
            Of matplotlib, to be changed and saved.
        """
        figure = draw(self.time, self.series(*keys), self.title)
        if path is not None:
            save(figure, path)
        if show:
            _open(figure, path)
        return figure

    def _columns(self, keys: Iterable[Key]) -> dict[str, np.ndarray]:
        return {"time": self.time} | {s.name: s.values for s in self.series(*keys)}

    def _read(self, quantities: list[Quantity]) -> list[np.ndarray]:
        """Return the arrays of quantities, computing those that are new in one call."""
        new = [q for q in quantities if not (q.declared and q.name in self._arrays)]
        arrays: dict[Quantity, np.ndarray] = {}
        column = ca.vertcat(*[q.column for q in new])
        values = np.asarray(self._evaluate(column)) if column.numel() else np.empty((self.time.size, 0))
        ends = np.cumsum([q.column.numel() for q in new], dtype=int)
        for q, block in zip(new, np.split(values, ends[:-1], axis=1), strict=False):
            arrays[q] = block.reshape(self.time.size, *q.shape, order="F")
            arrays[q].flags.writeable = False
            if q.declared:
                self._arrays[q.name] = arrays[q]
        return [arrays[q] if q in arrays else self._arrays[q.name] for q in quantities]


def _open(figure: Figure, path: str | Path | None) -> None:
    import tempfile
    import webbrowser

    picture = Path(path) if path is not None else Path(tempfile.mkdtemp()) / "result.png"
    if path is None:
        save(figure, picture)
    webbrowser.open(picture.resolve().as_uri())
