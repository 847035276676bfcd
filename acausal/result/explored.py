"""The explorer of a result: one HTML page with the tree of the parts, plots of any variable, and the moving machine."""

from __future__ import annotations

import json
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from acausal.animation.collect import PartShape, collect, collected
from acausal.animation.columns import encode
from acausal.animation.document import document_of, scenes
from acausal.animation.frames import select_frames
from acausal.animation.page import html
from acausal.animation.scene import Run, Scene, shapes_of, visible
from acausal.animation.series import Series
from acausal.errors import DeclarationError, ExportError
from acausal.language.component import Component
from acausal.language.pending import reading
from acausal.result.animated import PAGES, at_places
from acausal.result.animation_options import check_frames, check_list
from acausal.result.event_marks import event_marks
from acausal.result.files import check_writable, shown_name, whole
from acausal.result.lookup import Key, Quantity, Tree, match
from acausal.result.part_tree import part_tree
from acausal.result.snapshot import AT_ONCE, Snapshot
from acausal.symbols import stacked

# Characters of a page. A page with large meshes has at least ROOM for the numbers that vary with time.
BUDGET, ROOM = 1_500_000, 250_000
FEWEST = 100  # times to which a result is thinned for the budget
DENSER = 1.4  # exponent of the number of times over that of the characters


@dataclass(frozen=True)
class _Names:
    """The names of all quantities of a result: of the model, and beside it."""

    result: Any

    @property
    def names(self) -> list[str]:
        """Paths of all quantities."""
        return list(self.result)

    def find(self, key: Key) -> Quantity:
        """Return the quantity of a key."""
        return self.result._find(key)


def write(result: Any, path: str | Path, variables: Sequence[str] | None, frames: int) -> None:
    """Write the explorer of a result; raises the errors of `Result.explore`."""
    check_explorer(path)
    check_frames(frames)
    if variables is not None:
        check_list("variables", variables, "crank.*")
    if not result.time.size:
        raise DeclarationError(f"{result!r} is empty: there is no time at which something could be seen.")
    known = _Names(result)
    with reading():  # parts share what they observe
        quantities, refused = (
            _readable(known) if variables is None else ([*map(known.find, match(known, variables))], {})
        )
    places = _with_events(select_frames(result.time, frames), result.time, result.stats.event_times, frames)
    page = _Page.of(result, quantities, refused, places).fitting()
    with whole(path) as file:
        file.write(page)


def _readable(known: _Names) -> tuple[list[Quantity], dict[str, str]]:
    """Return all quantities, and the messages for those that cannot be read."""
    found, refused = [], {}
    for name in known.names:
        try:
            found.append(known.find(name))
        except DeclarationError as error:
            refused[name] = str(error)
    return found, refused


def check_explorer(path: str | Path) -> None:
    """Check that an explorer can be written: an HTML file, writable.

    Raises
    ------
    ExportError
        If it cannot, with the reason.
    """
    if isinstance(path, str | Path) and str(path).strip() and Path(path).suffix.lower() not in PAGES:
        raise ExportError(
            f"cannot write {shown_name(path)}: the name of an explorer ends in .html, a page for any browser."
        )
    check_writable(path)


def check_shapes(tree: Tree) -> None:
    """Raise DeclarationError if shapes() of a part fails; a model without visible parts is explored without a picture."""
    if isinstance(tree, Component):
        collect(tree)


def _with_events(places: np.ndarray, time: np.ndarray, events: Sequence[float], frames: int) -> np.ndarray:
    """Add the times around events, unless they are more than the frames."""
    after = np.searchsorted(time, events)
    around = np.union1d(after, after - 1)
    around = around[(around >= 0) & (around < len(time))]
    return np.union1d(places, around) if len(around) <= frames else places


@dataclass(frozen=True)
class _Page:
    """A page, and how to make it smaller.

    Parameters
    ----------
    result : Result
        The result.
    places : array of int
        Indices of the times of `series`.
    series : Series
        The values at these times.
    model : dict
        Tree of the parts, events and first plots.
    shapes : list of PartShape
        Shapes of the picture; none if no part is visible.
    """

    result: Any
    places: np.ndarray
    series: Series
    model: dict[str, Any]
    shapes: list[PartShape]

    @classmethod
    def of(cls, result: Any, quantities: Sequence[Quantity], refused: Mapping[str, str], places: np.ndarray) -> _Page:
        """Evaluate quantities at some times; `refused` has the reasons why others cannot be read."""
        series, known = Series(len(places)), {}
        changing: dict[int, tuple[str, str, np.ndarray]] = {}
        for quantity, values in _values(result, quantities, places):
            numbers = [series.add(column) for column in values.T]
            known[quantity.name] = quantity, numbers
            for (_, name, unit), number, column in zip(quantity.entries, numbers, values.T, strict=True):
                if number >= 0:
                    changing.setdefault(number, (name, unit, column))
        stats = result.stats
        model = {
            "root": part_tree(result.tree, known, refused, _title(result)),
            "events": event_marks(result.time[places], stats.event_times, stats.break_times, changing.values()),
            "plots": [name for output in result.outputs for _, name, _ in result._find(output).entries],
        }
        seen = isinstance(result.tree, Component) and visible(collected(result.tree, set()))
        return cls(result, places, series, model, shapes_of([result.tree])[0] if seen else [])

    def fitting(self) -> str:
        """Return the page with as many of the times as the budget allows.

        Raises
        ------
        DeclarationError
            If it has too many variables for any.
        """
        time, events, count = self.result.time[self.places], self.result.stats.event_times, len(self.places)
        while True:
            own = _with_events(select_frames(time, count), time, events, count)
            document = self.document(own)
            page, numbers = html(document), _packed(document)
            limit = max(BUDGET - (len(page) - numbers), ROOM)
            if numbers <= limit:
                return page
            if count <= FEWEST:
                raise DeclarationError(
                    f"a page with all {self.series.varying} changing values needs {len(page) / 1e6:.1f} MB even at {count} "
                    f"times; {BUDGET / 1e6:g} MB are its limit. Choose variables, as in "
                    'result.explore("FILE.html", variables=["crank.*", "*.phi"]), or on the command line --variables PATTERN.'
                )
            # Numbers farther apart compress less: half as many take more than half of the characters.
            count = max(min(int(count * (limit / numbers) ** DENSER), count - 1), FEWEST)

    def document(self, own: np.ndarray) -> dict[str, Any]:
        """Return the document at some of the times.

        Parameters
        ----------
        own : array of int
            Indices among `places`.
        """
        places, result = self.places[own], self.result
        tree, title, time = result.tree, _title(result), result.time[places]
        run = Run(tree, time, at_places(result, places), (), title, result.stats.get("stopped"))
        found = scenes({title: run}, shapes=[self.shapes]) if self.shapes else {title: _without_picture(run)}
        model = {**self.model, "note": self._note(len(own))}
        text = json.dumps(model, allow_nan=False, separators=(",", ":"))
        explorer = {"time": encode(time), "series": self.series.document(own), "model": encode(text.encode())}
        return document_of(found, title=title) | {"explorer": explorer}

    def _note(self, shown: int) -> str:
        """Return how many times are shown if not all, and why the run ended early."""
        times, stopped = self.result.time, self.result.stats.get("stopped")
        few = f"{shown} of {len(times)} output times are shown." if shown < len(times) else ""
        end = f"The run stopped at {times[-1]:.6g} s: {stopped}" if stopped else ""
        return " ".join(filter(None, (few, end)))


def _title(result: Any) -> str:
    return result.title or result._model


def _packed(document: dict[str, Any]) -> int:
    """Return the number of characters that vary with time."""
    run, explorer = document["runs"][0], document["explorer"]
    return sum(map(len, (run["data"], run["time"], explorer["time"], explorer["series"]["codes"])))


def _without_picture(run: Run) -> Scene:
    return Scene(run, [], [], np.zeros(3), np.zeros(3), 1.0, np.array([0.0, 1.0, 0.0]))


def _values(result: Any, quantities: Sequence[Quantity], places: np.ndarray) -> Iterator[tuple[Quantity, np.ndarray]]:
    """Yield quantities with their entries, row by row as in `entries`, shape (times, entries), at some times."""
    snapshot = result.tree if isinstance(result.tree, Snapshot) else result._more
    evaluate = at_places(result, places)
    ends = np.cumsum([q.size for q in quantities]) // AT_ONCE
    for block in ([quantities[k] for k in np.flatnonzero(ends == part).tolist()] for part in np.unique(ends)):
        columns = [q.column for q in block if not isinstance(q.column, np.ndarray)]
        values, first = np.asarray(evaluate(stacked(columns))) if columns else np.empty((len(places), 0)), 0
        for q in block:
            if isinstance(q.column, np.ndarray):
                found = snapshot.evaluate(q.column)[places]
            else:
                found = values[:, first : (first := first + q.size)]
            yield q, found[:, np.arange(q.size).reshape(q.shape, order="F").ravel()]
