"""Animations of results: options, checks, and files (HTML page, GIF, PNG)."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Protocol

import numpy as np

from acausal.animation.document import document_of, scenes
from acausal.animation.frames import FRAMES, select_frames
from acausal.animation.page import html
from acausal.animation.scene import Plot, Run, shapes_of
from acausal.errors import DeclarationError, ExportError
from acausal.language.component import Component
from acausal.language.value_checks import shown as code
from acausal.result.files import check_writable, shown_name, whole
from acausal.result.lookup import Key, Tree, find
from acausal.result.plots import canvas

PAGES = (".html", ".htm")
EXAGGERATED = 1000  # largest scale of deformations
ENDINGS = (*PAGES, ".gif", ".png")


class Animatable(Protocol):
    """The attributes of a result that animations use."""

    time: np.ndarray
    tree: Any
    outputs: tuple[str, ...]
    title: str
    _evaluate: Any

    @property
    def stats(self) -> Mapping[str, Any]:
        """Statistics of the run."""
        ...


@dataclass(frozen=True)
class AnimationOptions:
    """Options of an animation: the arguments of `Result.animate`."""

    frames: int = FRAMES
    plots: Sequence[Key] = ()
    values: Sequence[str] = ()
    title: str = ""
    deformation: float = 1.0

    def check(self) -> None:
        """Raise DeclarationError for invalid options."""
        if isinstance(self.frames, bool) or not isinstance(self.frames, int | np.integer) or self.frames < 2:
            raise DeclarationError(f"frames is a whole number, 2 or more, not {code(self.frames)}.")
        for name, example in (("plots", "crank.phi"), ("values", "bending moment")):
            given = getattr(self, name)
            if isinstance(given, str) or not isinstance(given, Sequence):
                raise DeclarationError(f'{name} is a list, such as ["{example}"], not {code(given)}.')
        number = not isinstance(self.deformation, bool) and isinstance(self.deformation, int | float | np.number)
        if not number or not 1 <= self.deformation <= EXAGGERATED:
            raise DeclarationError(f"deformation is a number from 1 to {EXAGGERATED}, not {code(self.deformation)}.")
        if not isinstance(self.title, str):
            raise DeclarationError(f"title is a text, not {code(self.title)}.")


DEFAULT = AnimationOptions()


def write(results: Mapping[str, Animatable], path: str | Path, options: AnimationOptions) -> None:
    """Write an animation of results by name; raises the errors of `Result.animate`."""
    check_animation(path)
    options.check()
    title = options.title
    found = scenes({name: run_of(result, options) for name, result in results.items()}, options.values)
    if _ending(path) in PAGES:
        with whole(path) as file:
            file.write(html(document_of(found, options.values, title, options.deformation)))
        return
    from acausal.result.films import film, still

    data = (film if _ending(path) == ".gif" else still)(found, title, options.values, options.deformation)
    with whole(path, "wb") as file:
        file.write(data)


def check_animation(path: str | Path) -> None:
    """Check that an animation can be written: known suffix, writable file.

    Raises
    ------
    ExportError
        If it cannot, with the reason.
    """
    if isinstance(path, str | Path) and str(path).strip() and _ending(path) not in ENDINGS:
        raise ExportError(
            f"cannot write {shown_name(path)}: the name of an animation ends in .html (a page for any browser), .gif or .png."
        )
    check_writable(path)
    if _ending(path) not in PAGES:
        canvas(1, 1, "tight")  # raises ExportError if matplotlib cannot be loaded


def check_visible(tree: Tree, values: Sequence[str] = ()) -> None:
    """Check that a model has visible parts, and beams with the given values.

    Raises
    ------
    DeclarationError
        If not; the message lists the available values.
    """
    if isinstance(tree, Component):
        shapes_of([tree], values)


def run_of(result: Animatable, options: AnimationOptions = DEFAULT) -> Run:
    """Return the data of a result for an animation: thinned times, an evaluator, and plots.

    Raises
    ------
    DeclarationError
        If the result has no times or no model.
    """
    tree = result.tree
    if not isinstance(tree, Component):
        raise DeclarationError(
            f"{result!r} has no model, which defines the shapes of the parts: it was loaded, or made from arrays. Animate it "
            "where it was simulated, or simulate again."
        )
    if not result.time.size:
        raise DeclarationError(f"{result!r} is empty: there is no time at which something could be seen.")
    places = select_frames(result.time, options.frames)
    quantities = [find(tree, key) for key in options.plots or result.outputs]
    plots = [Plot(name, unit, q[index].column) for q in quantities for index, name, unit in q.entries]
    title, stopped = result.title or type(tree).__name__, result.stats.get("stopped")
    return Run(tree, result.time[places], _at(result, places), plots, title, stopped)


def _at(result: Animatable, places: np.ndarray) -> Any:
    """Return an evaluator at the given times only, to save work if the result supports it."""
    evaluate = result._evaluate
    if len(places) == result.time.size:
        return evaluate
    if hasattr(evaluate, "at"):
        return evaluate.at(places)
    return lambda column: np.asarray(evaluate(column))[places]


def _ending(path: str | Path) -> str:
    return Path(path).suffix.lower()
