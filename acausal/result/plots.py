"""Plots of results, drawn with matplotlib's objects alone: they need no display and change no global state."""

from __future__ import annotations

import os
import re
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Literal

import numpy as np

from acausal.errors import DeclarationError, ExportError
from acausal.result.files import check_writable, shown_name, whole

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

DPI = 150
LABEL = 36  # characters of the longest label of an axis; longer ones are left to the legend
FLAT = 0.03  # fraction of the largest range in an axes, below which a curve looks flat and gets an axes of its own
LEGEND_ROWS = 12  # lines in a column of the legend
LEGEND_LINES = 36  # lines in the legend


@dataclass(frozen=True)
class Series:
    """One scalar over time: name, unit as declared and values of shape (times,)."""

    name: str
    unit: str
    values: np.ndarray


def draw(time: np.ndarray, series: Sequence[Series], title: str = "") -> Figure:
    """Plot scalars over time, one axes per unit; curves that would look flat beside the others get their own.

    Parameters
    ----------
    time : array, shape (times,)
        In s.
    series : sequence of Series
        The curves.
    title : str
        Title of the figure.

    Returns
    -------
    Figure
        On an Agg canvas.
    """
    if not series:
        raise DeclarationError("there is nothing to plot: the model has no outputs; name some variables.")
    groups = [group for unit in dict.fromkeys(s.unit for s in series) for group in _alike(series, unit)]
    figure = canvas(8.0, 1.2 + 2.4 * len(groups), "tight")
    column = figure.subplots(len(groups), 1, sharex=True, squeeze=False)[:, 0]
    for axes, group in zip(column, groups, strict=True):
        _fill(axes, time, group, group[0].unit)
    column[-1].set_xlabel("time [s]")
    if title:
        column[0].set_title(title)
    figure.align_ylabels()
    return figure


def _alike(series: Sequence[Series], unit: str) -> list[list[Series]]:
    """Split the series of a unit into those of large and of small range."""
    own = [s for s in series if s.unit == unit]
    spans = [float(np.ptp(s.values[np.isfinite(s.values)])) if np.any(np.isfinite(s.values)) else 0.0 for s in own]
    most = max(spans)
    small = [0 < span < FLAT * most for span in spans]
    groups = [[s for s, flat in zip(own, small, strict=True) if flat is which] for which in (False, True)]
    return [group for group in groups if group]


def save(figure: Figure, path: str | Path) -> None:
    """Write a figure in the format of the file's suffix."""
    check_picture(path)
    with whole(path, "wb") as file:
        figure.savefig(file, format=_ending(path), dpi=DPI)


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
    from matplotlib.backends.backend_agg import FigureCanvasAgg
    from matplotlib.figure import Figure

    figure = Figure(figsize=(width, height), dpi=DPI, layout=layout)
    FigureCanvasAgg(figure)
    return figure


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


def _fill(axes: Axes, time: np.ndarray, series: Sequence[Series], unit: str) -> None:
    from cycler import cycler
    from matplotlib import rcParamsDefault

    # Line styles distinguish curves beyond the ten colours.
    axes.set_prop_cycle(cycler(linestyle=["-", "--", ":", "-."]) * rcParamsDefault["axes.prop_cycle"])
    for s in series:
        axes.plot(time, s.values, label=s.name, linewidth=1.4, marker="." if len(time) == 1 else None)
    names = ", ".join(dict.fromkeys(re.sub(r"\[[\d,]*\]$", "", s.name) for s in series))
    shown = f"[{unit}]" if unit else ""
    axes.set_ylabel(f"{names} {shown}".strip() if len(names) <= LABEL else shown)
    axes.grid(alpha=0.4)
    axes.margins(x=0.01)
    axes.ticklabel_format(axis="y", useOffset=False)
    shown_lines = axes.lines[:LEGEND_LINES]
    axes.legend(
        handles=shown_lines,
        loc="center left",
        bbox_to_anchor=(1.0, 0.5),
        fontsize="small",
        frameon=False,
        ncols=-(-len(shown_lines) // LEGEND_ROWS),
    )
