"""Output of the commands: files, JSON documents and summaries."""

from __future__ import annotations

import json
import math
from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field
from itertools import combinations, product
from typing import IO, Any

import numpy as np

from acausal.errors import ExportError
from acausal.result import Result, check_picture, check_writable, same_file, shown_name
from acausal.result.files import whole
from acausal.result.lookup import Tree
from acausal.result.plots import Series
from acausal.result.statistics import Statistics
from acausal.result.tables import Table, wrapped
from acausal.simulation.accuracy_control import chosen_text
from acausal.units import parse

FINAL_VALUES = 20
LINES = 12  # of a summary
MODES = 20  # rows of a table of modes
LEAST = 2  # final values, however long the rest is
FEW = 2  # small outputs that are named
# Fraction of the nominal value of the states of a unit; smaller outputs have a relative error of ten tolerances or more.
SMALL = 0.1
ROUNDING = 1e-12  # real part of an eigenvalue relative to its magnitude, below which it is round-off of zero


def check_outputs(reads: Iterable[str | None], **writes: str | None) -> None:
    """Check the output files before any work is done.

    Parameters
    ----------
    reads : iterable of str or None
        Files that the command reads.
    **writes : str or None
        Files that the command writes, by the name of the option.
    """
    files = [(f"--{option}", path) for option, path in writes.items() if path is not None]
    for option, path in files:
        if option == "--plot":
            check_picture(path)
        elif option == "--animate":
            from acausal.result.animated import check_animation

            check_animation(path)
        elif option == "--explore":
            from acausal.result.explored import check_explorer

            check_explorer(path)
        elif (option, path) != ("--json", "-"):
            check_writable(path)
    for (one, first), (other, second) in combinations(files, 2):
        if same_file(first, second) or {first, second} == {"-", "/dev/stdout"}:
            raise ExportError(f"{one} and {other} both write {shown_name(first)}; give each a file of its own.")
    for (option, path), read in product(files, reads):
        if read is not None and same_file(path, read):
            raise ExportError(f"{option} would replace {shown_name(path)}, which the command reads; give another name.")


@dataclass(frozen=True)
class Files:
    """The output files of a simulation.

    Parameters
    ----------
    scene : str
        Name of the scene, for the JSON document.
    csv, plot, json, explore : str or None
        Names of files; `json` may be "-".
    standard_output : text stream
        The stream for `json` "-".
    animate : str or None
        Name of the file of the animation.
    options : mapping
        Options of the animation, as the arguments of `Result.animate`.
    """

    scene: str
    csv: str | None
    plot: str | None
    json: str | None
    standard_output: IO[str]
    animate: str | None = None
    options: Mapping[str, Any] = field(default_factory=dict)
    explore: str | None = None

    def check(self, tree: Tree) -> None:
        """Check that the model has visible parts, and what the options of the animation name."""
        if self.animate is not None:
            from acausal.result.animated import AnimationOptions, check_visible

            options = AnimationOptions(**self.options)
            options.check(self.animate)
            check_visible(tree, options)
        if self.explore is not None:
            from acausal.result.explored import check_shapes

            check_shapes(tree)

    def write(self, result: Result, chosen: list[str], **more: Any) -> None:
        """Write outputs and chosen variables; `more` goes into the JSON document."""
        wrong = result.not_finite(*result.outputs, *chosen)
        if self.csv:
            result.to_csv(self.csv, *result.outputs, *chosen)
        if self.plot:
            result.plot(*chosen, path=self.plot)
        if self.json:
            write_json(
                {"scene": self.scene, **result.stats, "not_finite": wrong, **more}, self.json, self.standard_output
            )
        if self.animate:
            result.animate(self.animate, plots=chosen, **self.options)
        if self.explore:
            result.explore(self.explore, variables=[*result.outputs, *chosen] if chosen else None)


def write_json(document: Mapping[str, Any], path: str, standard_output: IO[str]) -> None:
    """Write a document to a file, or to standard output if the path is "-"."""
    text = _json(document, "utf-8" if path != "-" else getattr(standard_output, "encoding", None) or "utf-8")
    if path == "-":
        standard_output.write(text)
        standard_output.flush()
        return
    with whole(path) as file:
        file.write(text)


def _json(document: Mapping[str, Any], encoding: str) -> str:
    written, how = plain(document), {"indent": 2, "allow_nan": False}
    text = json.dumps(written, ensure_ascii=False, **how) + "\n"
    try:
        text.encode(encoding)
    except UnicodeEncodeError:  # a character that the stream cannot encode, or a file name that is not valid UTF-8
        return json.dumps(written, **how) + "\n"
    return text


def plain(value: Any) -> Any:
    """Convert a value for JSON: complex numbers become pairs [re, im], NaN and infinities null."""
    if isinstance(value, Mapping):
        return {str(k): plain(v) for k, v in value.items()}
    if isinstance(value, np.ndarray | np.generic):
        return plain(value.tolist())
    if isinstance(value, list | tuple | set | frozenset):
        return [plain(v) for v in value]
    if isinstance(value, complex):
        return [plain(value.real), plain(value.imag)]
    if isinstance(value, float):
        return value if math.isfinite(value) else None
    return value if value is None or isinstance(value, bool | int | str) else str(value)


def summary(result: Result) -> str:
    """Return a summary of a run: counts, seconds, events, and final values."""
    stats, time = result.stats, result.time
    lines = [
        f"{result.title}: {time[0]:g} s to {time[-1]:g} s, {time.size} points",
        f"  compiled in {stats.compile_seconds:.3g} s, solved in {stats.solve_seconds:.3g} s",
        f"  {stats.states} states, {stats.algebraic} algebraic unknowns; {stats.steps} steps, "
        f"{stats.factorisations} factorisations; {_method(stats)}",
        *_events(stats),
        *(
            [f"  inputs held: {', '.join(f'{n} = {v:g}' for n, v in stats.held_inputs.items())}"]
            if stats.held_inputs
            else []
        ),
        *([f"  {chosen_text(stats)}; {len(stats['trials'])} runs"] if "accuracy" in stats else []),
    ]
    series = result.series()
    if not series:
        return wrapped([*lines, "  the model has no outputs; --variables PATTERN adds columns"], indent=4)
    head, last = wrapped(lines, indent=4).splitlines(), wrapped(_small(stats, series), indent=4).splitlines()
    most = max(LINES - len(head) - len(last) - 1, LEAST)
    shown = series if len(series) <= most else series[: most - 1]
    width = max(len(s.name) for s in shown)
    finals = [f"    {s.name:{width}} = {s.values[-1]:.6g} {s.unit if s.unit != '1' else ''}".rstrip() for s in shown]
    more = [f"    ... ({len(series)} in all; --csv FILE writes them over time)"] if len(series) > most else []
    return "\n".join([*head, f"  at {time[-1]:g} s:", *finals, *more, *last])


def _small(stats: Statistics, series: list[Series]) -> list[str]:
    """Return a line on the outputs so small that the absolute part of the tolerance dominates.

    An output below the round-off of another output of the same unit counts as 0, such as the velocity in a direction
    without motion.
    """
    small = []
    for s in series[:FINAL_VALUES]:
        size = stats.sizes.get(str(parse(s.unit or "1")), 0.0)
        usual = float(np.median(np.abs(s.values)))
        largest = max(float(np.max(np.abs(other.values))) for other in series if other.unit == s.unit)
        if np.finfo(float).eps * largest < usual < SMALL * size:
            small.append(f"{s.name} is about {usual:.2g} {s.unit}")
    if not small:
        return []
    more = f" and {len(small) - FEW} more" if len(small) > FEW else ""
    return [f"  more digits need a smaller tolerance or nominal values: {', '.join(small[:FEW])}{more}"]


def _method(stats: Statistics) -> str:
    text = f"method {stats.method}"
    if "idas" in stats.method_steps:
        text += f", order at most {stats.max_order}"
    if stats.choices:
        kind = "states chosen by pivots" if stats.constraints == "states" else "projection"
        text += f"; loops closed by {kind}"
    return text


def _events(stats: Statistics) -> list[str]:
    """Return lines on break times, events and the energy balance."""
    lines = []
    if stats.break_times:
        lines.append(f"  breaks at {', '.join(f'{t:g}' for t in stats.break_times[:FINAL_VALUES])} s")
    if stats.events:
        lines.append(f"  {stats.events} events, the first at {stats.event_times[0]:g} s")
    if stats.energy_supplied or stats.energy_stored_change:
        lines.append(
            f"  energy in J: supplied {stats.energy_supplied:.5g}, stored change {stats.energy_stored_change:.5g}, "
            f"dissipated {stats.energy_dissipated:.3g}, numerical loss {stats.energy_method:.3g}"
        )
    return lines


def modes_table(eigenvalues: np.ndarray) -> str:
    """Return a table of the first modes, a row for each real eigenvalue and each conjugate pair; equal ones are counted.

    Parameters
    ----------
    eigenvalues : array of complex
        Eigenvalues in 1/s.
    """
    size = np.abs(eigenvalues).max(initial=0.0)
    rows: dict[tuple[str, str, str], int] = {}
    for value in eigenvalues:
        row = None
        if abs(value.imag) <= 1e-9 * size:
            row = f"{value.real:.6g}", "", ""
        elif value.imag > 0:
            real = value.real if abs(value.real) > ROUNDING * abs(value) else 0.0
            frequency, ratio = value.imag / (2 * np.pi), 0 - real / abs(value)
            row = f"{real:.6g} ± {value.imag:.6g}i", f"{frequency:.6g}", f"{ratio:.4g}"
        if row:
            rows[row] = rows.get(row, 0) + 1
    shown = [[f"{n} times {row[0]}" if n > 1 else row[0], *row[1:]] for row, n in rows.items()]
    text = Table(["eigenvalue [1/s]", "frequency [Hz]", "damping ratio"], shown[:MODES]).text()
    return text + (f"\n... ({len(shown)} in all; --json FILE writes all)" if len(shown) > MODES else "")
