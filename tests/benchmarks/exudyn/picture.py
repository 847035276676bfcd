"""Picture of the comparison: error against solve time, a column a scene, a row an output."""

from __future__ import annotations

from itertools import cycle
from pathlib import Path
from typing import Any

from matplotlib.figure import Figure
from matplotlib.ticker import NullFormatter

from acausal.result.files import whole
from tests.benchmarks.exudyn.compare import EXUDYN
from tests.benchmarks.exudyn.tables import Compared


def draw(compared: list[Compared], path: str | Path) -> None:
    """Write the picture."""
    figure = Figure(figsize=(4.2 * len(compared), 9.5), layout="constrained")
    grid: Any = figure.subplots(2, len(compared), squeeze=False)
    for column, c in enumerate(compared):
        for row, output in enumerate(c.scene.outputs):
            axes = grid[row, column]
            for name in dict.fromkeys(p.curve for p in c.ours):
                own = [p for p in c.ours if p.curve == name]
                axes.loglog([1e3 * p.seconds for p in own], [p.errors[output] for p in own], ".-", label=name)
            families = dict.fromkeys(p.setting.rpartition(", ")[2] for p in c.theirs)
            for marker, family in zip(cycle("sd^vo<>px*"), families):
                their = [p for p in c.theirs if p.setting.endswith(f", {family}")]
                times, errors = [1e3 * p.seconds for p in their], [p.errors[output] for p in their]
                axes.loglog(times, errors, f"k{marker}--", label=f"{EXUDYN}, {family}", markersize=4)
            axes.axhline(c.apart[output], color="0.6", linestyle=":", label="references apart")
            axes.set(title=f"{c.scene.name}: {output}", xlabel="solve time [ms]", ylabel="largest error / range")
            axes.xaxis.set_minor_formatter(NullFormatter())
            axes.grid(alpha=0.4)
        handles, labels = grid[0, column].get_legend_handles_labels()
        grid[-1, column].legend(handles, labels, fontsize=7, loc="upper center", bbox_to_anchor=(0.5, -0.14))
    with whole(path, "wb") as file:
        figure.savefig(file, format="png", dpi=110)
