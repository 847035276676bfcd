"""Plots of results, drawn with matplotlib's objects alone: they need no display and change no global state."""

from __future__ import annotations

import os
import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any, Literal, Protocol

import numpy as np

from acausal.errors import DeclarationError, ExportError
from acausal.result.files import check_writable, shown_name, whole

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

DPI = 150
LABEL = 36  # characters of the longest label of an axis; longer ones are left to the legend
FLAT = 0.03  # fraction of the largest range in an axes, below which a curve looks flat and gets an axes of its own
STYLES = ("-", "--", ":", "-.")
LEGEND_ROWS = 12  # lines in a column of the legend
LEGEND_LINES = 36  # lines in the legend


@dataclass(frozen=True)
class Series:
    """One scalar over time: name, unit as declared and values of shape (times,)."""

    name: str
    unit: str
    values: np.ndarray


@dataclass(frozen=True)
class Curve:
    """A scalar of a result over another one, such as time; `result` names the result if several are compared."""

    x: Series
    y: Series
    result: str = ""


class Readable(Protocol):
    """The attributes of a result that plots use."""

    time: np.ndarray

    def series(self, *keys: Any) -> list[Series]:
        """Return quantities as scalars."""
        ...


def curves(result: Readable, keys: Sequence[Any], x: Any = None, name: str = "") -> list[Curve]:
    """Return the outputs or `keys` of a result over time or the scalar `x`.

    Raises
    ------
    DeclarationError
        If `x` is not a scalar.
    """
    over = [Series("time", "s", result.time)] if x is None else result.series(x)
    if len(over) != 1:
        raise DeclarationError(f'x is one scalar, not an array of {len(over)}; give an entry, x="{over[0].name}".')
    return [Curve(over[0], y, name) for y in result.series(*keys)]


def draw(drawn: Sequence[Curve], title: str = "") -> Figure:
    """Plot curves, one axes per unit; quantities that would look flat beside the others get their own.

    Parameters
    ----------
    drawn : sequence of Curve
        The curves, all over the same quantity.
    title : str
        Title of the figure.

    Returns
    -------
    Figure
        On an Agg canvas.
    """
    if not drawn:
        raise DeclarationError("there is nothing to plot: the model has no outputs; name some variables.")
    groups = [group for unit in dict.fromkeys(c.y.unit for c in drawn) for group in _alike(drawn, unit)]
    figure = canvas(8.0, 1.2 + 2.4 * len(groups), "tight")
    column = figure.subplots(len(groups), 1, sharex=True, squeeze=False)[:, 0]
    labels = _labels(drawn)
    for axes, group in zip(column, groups, strict=True):
        _fill(axes, group, labels)
    column[-1].set_xlabel(_with_unit(drawn[0].x.name, drawn[0].x.unit))
    if title:
        column[0].set_title(title)
    figure.align_ylabels()
    return figure


def _alike(drawn: Sequence[Curve], unit: str) -> list[list[Curve]]:
    """Split the curves of a unit into those of quantities of large and of small range."""
    spans: dict[str, float] = {}
    own = [c for c in drawn if c.y.unit == unit]
    for c in own:
        finite = c.y.values[np.isfinite(c.y.values)]
        spans[c.y.name] = max(spans.get(c.y.name, 0.0), float(np.ptp(finite)) if finite.size else 0.0)
    small = {name: 0 < span < FLAT * max(spans.values()) for name, span in spans.items()}
    groups = [[c for c in own if small[c.y.name] is which] for which in (False, True)]
    return [group for group in groups if group]


def save(figure: Figure, path: str | Path) -> None:
    """Write a figure in the format of the file's suffix."""
    check_picture(path)
    with whole(path, "wb") as file:
        figure.savefig(file, format=_ending(path), dpi=DPI)


def finish(figure: Figure, path: str | Path | None, show: bool | None) -> Figure:
    """Write a figure if a path is given, open it if wanted, and return it."""
    if path is not None:
        save(figure, path)
    if show:
        open_figure(figure, path)
    return figure


def open_figure(figure: Figure, path: str | Path | None) -> None:
    """Open a figure in the system's viewer, saving it first if it has no path yet."""
    import tempfile
    import webbrowser

    picture = Path(path) if path is not None else Path(tempfile.mkdtemp()) / "result.png"
    if path is None:
        save(figure, picture)
    webbrowser.open(picture.resolve().as_uri())


def check_picture(path: str | Path) -> None:
    """Check that a picture can be written: known suffix, writable file.

    Raises
    ------
    ExportError
        If it cannot, with the reason.
    """
    if isinstance(path, str | Path) and str(path).strip() and _ending(path) not in _formats():
        raise ExportError(f"cannot write {shown_name(path)}: a picture's name ends in .png, .svg or .pdf.")
    check_writable(path)


def canvas(width: float, height: float, layout: Literal["tight", "constrained"]) -> Figure:
    """Return an empty figure on an Agg canvas.

    Parameters
    ----------
    width, height : float
        In inches.
    layout : str
        Layout engine of matplotlib.
    """
    _formats()
    from acausal.result.figure import Picture

    return Picture(figsize=(width, height), dpi=DPI, layout=layout)


def _formats() -> dict[str, str]:
    """Return matplotlib's file types; raise ExportError if its import fails, as with an invalid MPLBACKEND."""
    try:
        from matplotlib.backend_bases import FigureCanvasBase
    except (ImportError, OSError, ValueError) as error:
        name = os.environ.get("MPLBACKEND")
        remedy = f"; MPLBACKEND is {name!r}: unset it, pictures need no screen" if name and name in str(error) else ""
        raise ExportError(f"matplotlib cannot be loaded, so there are no pictures{remedy or f': {error}'}.") from None
    return FigureCanvasBase.get_supported_filetypes()


def _ending(path: str | Path) -> str:
    return Path(path).suffix.lower().removeprefix(".")


def _fill(axes: Axes, drawn: Sequence[Curve], labels: Mapping[str, str]) -> None:
    from cycler import cycler
    from matplotlib import rcParamsDefault

    # Line styles distinguish results, and curves beyond the ten colours.
    axes.set_prop_cycle(cycler(linestyle=STYLES) * rcParamsDefault["axes.prop_cycle"])
    results, names = list(dict.fromkeys(c.result for c in drawn)), list(dict.fromkeys(c.y.name for c in drawn))
    for c in drawn:
        label = ": ".join(filter(None, (c.result, labels[c.y.name] if len(names) > 1 or not c.result else "")))
        (line,) = axes.plot(c.x.values, c.y.values, label=label, linewidth=1.4)
        line.set_marker("." if len(c.x.values) == 1 else "")
        if len(results) > 1:
            line.set_linestyle(STYLES[results.index(c.result) % len(STYLES)])
    quantities = labels[names[0]] if len(names) == 1 else ", ".join(dict.fromkeys(_array(name) for name in names))
    axes.set_ylabel(_with_unit(quantities if len(quantities) <= LABEL else "", drawn[0].y.unit))
    axes.grid(alpha=0.4)
    axes.margins(x=0.01)
    axes.ticklabel_format(axis="y", useOffset=False)
    if len(drawn) == 1 and len(quantities) <= LABEL:
        return  # the axis has its name
    shown_lines = axes.lines[:LEGEND_LINES]
    axes.legend(
        handles=shown_lines,
        loc="center left",
        bbox_to_anchor=(1.0, 0.5),
        fontsize="small",
        frameon=False,
        ncols=-(-len(shown_lines) // LEGEND_ROWS),
    )


def _labels(drawn: Sequence[Curve]) -> dict[str, str]:
    """Return the label of each quantity by name: `r_0 x` instead of `r_0[0]` for three components of one unit."""
    units: dict[str, list[tuple[str, str]]] = {}
    for name, unit in dict.fromkeys((c.y.name, c.y.unit) for c in drawn):
        units.setdefault(_array(name), []).append((name, unit))
    labels = {c.y.name: c.y.name for c in drawn}
    for array, entries in units.items():
        if sorted(entries) == [(f"{array}[{k}]", entries[0][1]) for k in range(3)]:
            labels |= {
                name: f"{array} {component}" for (name, _), component in zip(sorted(entries), "xyz", strict=True)
            }
    return labels


def _array(name: str) -> str:
    """Return the name of an array from that of its entry."""
    return re.sub(r"\[[\d,]*\]$", "", name)


def _with_unit(name: str, unit: str) -> str:
    return f"{name} [{unit}]".strip() if unit not in ("", "1") else name
