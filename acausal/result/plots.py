"""Pictures of results; matplotlib's objects only, so that neither a display nor global state is touched."""

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
LABEL = 36
FLAT = 0.03  # of the largest range in an axes
LEGEND_ROWS = 12
LEGEND_LINES = 36


@dataclass(frozen=True)
class Series:
    """One scalar over time: name, unit as declared and values of shape (times,)."""

    name: str
    unit: str
    values: np.ndarray


def draw(time: np.ndarray, series: Sequence[Series], title: str = "") -> Figure:
    """Draw scalars over time, one axes for each unit; what would look flat beside the others has its own.

    Parameters
    ----------
    time : array, shape (times,)
        In s.
    series : sequence of Series
        What to draw.
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
    """Split the series of a unit where the range of one is too small to be seen beside the others."""
    own = [s for s in series if s.unit == unit]
    spans = [float(np.ptp(s.values[np.isfinite(s.values)])) if np.any(np.isfinite(s.values)) else 0.0 for s in own]
    most = max(spans)
    small = [0 < span < FLAT * most for span in spans]
    groups = [[s for s, flat in zip(own, small, strict=True) if flat is which] for which in (False, True)]
    return [group for group in groups if group]


def save(figure: Figure, path: str | Path) -> None:
    """Write a figure in the format that the name's ending tells."""
    check_picture(path)
    with whole(path, "wb") as file:
        figure.savefig(file, format=_ending(path), dpi=DPI)


def opened(figure: Figure, path: str | Path | None) -> None:
    """Open a figure in the system's viewer, which was saved already if it has a path."""
    import tempfile
    import webbrowser

    picture = Path(path) if path is not None else Path(tempfile.mkdtemp()) / "result.png"
    if path is None:
        save(figure, picture)
    webbrowser.open(picture.resolve().as_uri())


def check_picture(path: str | Path) -> None:
    """Check whether a picture can be written: known ending, writable place.

    Raises
    ------
    ExportError
        With the reason why not.
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
        How matplotlib places the axes.
    """
    _formats()
    from matplotlib.backends.backend_agg import FigureCanvasAgg
    from matplotlib.figure import Figure

    figure = Figure(figsize=(width, height), dpi=DPI, layout=layout)
    FigureCanvasAgg(figure)
    return figure


def _formats() -> dict[str, str]:
    """Return the endings of pictures; matplotlib refuses to be imported where its environment is wrong."""
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

    # Lines stay apart beyond the ten colours.
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
