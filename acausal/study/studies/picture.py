"""The picture of a study: error over time, one curve for each formulation."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

from acausal.errors import DeclarationError
from acausal.result.plots import canvas
from acausal.study.studies.reference import Reference
from acausal.study.studies.study_rows import STEP, TOLERANCE, StudyRow, pareto

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

MARKERS = "osD^vPXh<>pd"
# Ratios of the times of neighbouring points below which the second label moves to the other side, or is left out.
NEAR, TOO_NEAR = 1.35, 1.15


def draw(rows: Sequence[StudyRow], reference: Reference, title: str, output: str | None = None) -> Figure:
    """Draw error over solve time, both logarithmic.

    A curve joins the Pareto-optimal points of a formulation. Hollow points would gain from a tighter tolerance or shorter
    steps, filled ones would not.

    Parameters
    ----------
    rows : sequence of StudyRow
        The points.
    reference : Reference
        Its own error is a band at the bottom.
    title : str
        Title of the picture.
    output : str, optional
        Output whose error is drawn; the largest error of all outputs if not given.

    Returns
    -------
    Figure
        On an Agg canvas.
    """
    if output is not None and output not in reference.values:
        raise DeclarationError(f"the study has no output {output!r}; it compares: {', '.join(reference.values)}.")
    good = [row for row in rows if not row.remark and row.error_of(output) > 0]
    if not good:
        raise DeclarationError("there is nothing to draw: no point has an error greater than 0.")
    figure = canvas(10.0, 6.0, "constrained")
    from matplotlib.ticker import FuncFormatter, LogLocator, NullFormatter

    axes = figure.subplots()
    axes.set(xscale="log", yscale="log", xlabel="solve time [ms]")
    axes.set_ylabel(f"largest error of {output or 'all outputs'} as a fraction of the range")
    axes.set_title(title)
    names = list(dict.fromkeys(row.case.formulation for row in rows))
    for k, name in enumerate(names):
        _curve(axes, [row for row in good if row.case.formulation == name], name, k, output)
    floor = reference.floor if output is None else reference.floors[output]
    _front(axes, good, floor, output)
    _band(axes, floor)
    axes.xaxis.set_major_locator(LogLocator(subs=(1, 2, 5)))
    axes.xaxis.set_major_formatter(FuncFormatter(lambda value, _: f"{value:g}"))
    axes.xaxis.set_minor_formatter(NullFormatter())
    axes.grid(which="major", alpha=0.35)
    _legend(
        axes,
        [f"{name}: diverged or failed" for name in names if all(r.remark for r in rows if r.case.formulation == name)],
    )
    return figure


def _curve(axes: Axes, rows: Sequence[StudyRow], name: str, k: int, output: str | None) -> None:
    """Draw all points of a formulation, and join the Pareto-optimal ones."""
    if not rows:
        return
    colour, marker = f"C{k % 10}", MARKERS[k % len(MARKERS)]
    for row in rows:
        face = "white" if row.limit in (TOLERANCE, STEP) else colour
        style = {"color": colour, "marker": marker, "markerfacecolor": face, "markersize": 5, "linestyle": "none"}
        axes.plot([_ms(row)], [row.error_of(output)], **style)
    best = pareto(rows, output=output)
    line = {"color": colour, "marker": marker, "markerfacecolor": colour, "markersize": 5, "linewidth": 1.6}
    axes.plot([], [], label=name, **line)
    axes.plot([_ms(r) for r in best], [r.error_of(output) for r in best], color=colour, linewidth=1.6, zorder=1)


def _front(axes: Axes, rows: Sequence[StudyRow], floor: float, output: str | None) -> None:
    """Ring the Pareto-optimal points, and label them with sizes and tolerances."""
    best = pareto(rows, floor, output)
    x, y = [_ms(r) for r in best], [r.error_of(output) for r in best]
    ring = {"marker": "o", "markersize": 12, "markerfacecolor": "none", "color": "black", "linestyle": "none"}
    axes.plot(x, y, label="best of all: size, tolerance or step", markeredgewidth=1.0, **ring)
    labelled = 0.0
    for k, row in enumerate(best):
        if x[k] < TOO_NEAR * labelled:
            continue
        crowded, labelled = x[k] < NEAR * labelled, x[k]
        text = ", ".join(filter(None, [row.case.size, row.case.fineness.replace("e-0", "e-")]))
        place: dict[str, Any] = {"ha": "left", "va": "bottom"} if crowded else {"ha": "right", "va": "top"}
        offset = (5, 7) if crowded else (-5, -7)
        axes.annotate(text, (x[k], y[k]), offset, textcoords="offset points", fontsize="x-small", **place)


def _ms(row: StudyRow) -> float:
    return 1e3 * row.seconds


def _band(axes: Axes, floor: float) -> None:
    """Shade errors below the uncertainty of the reference."""
    low, high = axes.get_ylim()
    if floor > low:
        axes.axhspan(low, min(floor, high), color="0.9", zorder=0, label=f"the reference is known to {floor:.1g}")
        axes.set_ylim(low, high)


def _legend(axes: Axes, missing: Sequence[str]) -> None:
    style = {"color": "0.4", "marker": "o", "markersize": 5, "linestyle": "none"}
    axes.plot([], [], markerfacecolor="white", label="hollow: limited by the tolerance or the step", **style)
    axes.plot([], [], markerfacecolor="0.4", label="filled: limited by elements, model or reference", **style)
    for text in missing:
        axes.plot([], [], linestyle="none", label=text)
    axes.legend(loc="center left", bbox_to_anchor=(1.0, 0.5), fontsize="small", frameon=False)
