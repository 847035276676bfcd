"""Animations of results: options, checks, and files (HTML page, GIF, PNG)."""

from __future__ import annotations

import shutil
from collections.abc import Mapping
from pathlib import Path
from typing import Any, Protocol

import numpy as np

from acausal.animation import geometry
from acausal.animation.collect import PartShape
from acausal.animation.document import document_of, scenes
from acausal.animation.frames import select_frames
from acausal.animation.page import html
from acausal.animation.scene import Plot, Run, shapes_of
from acausal.errors import DeclarationError, ExportError
from acausal.language.component import Component
from acausal.language.expression import as_expr
from acausal.result.animation_options import ENDINGS, PAGES, AnimationOptions, ending
from acausal.result.files import check_writable, shown_name, whole
from acausal.result.lookup import Key, Tree, find
from acausal.result.plots import canvas


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


DEFAULT = AnimationOptions()


def write(results: Mapping[str, Animatable], path: str | Path, options: AnimationOptions) -> None:
    """Write an animation of results by name; raises the errors of `Result.animate`."""
    check_animation(path)
    options.check(path)
    found = scenes({name: run_of(result, options) for name, result in results.items()}, options.values)
    if ending(path) in PAGES:
        with whole(path) as file:
            file.write(html(document_of(found, options.values, options.title, options.deformation, options.view)))
        return
    from acausal.result.films import FILES

    data = FILES[ending(path)](found, options)
    with whole(path, "wb") as file:
        file.write(data)


def check_animation(path: str | Path) -> None:
    """Check that an animation can be written: known suffix, writable file.

    Raises
    ------
    ExportError
        If it cannot, with the reason.
    """
    if isinstance(path, str | Path) and str(path).strip() and ending(path) not in ENDINGS:
        raise ExportError(
            f"cannot write {shown_name(path)}: the name of an animation ends in .html (a page for any browser), .gif, .mp4 or "
            ".png."
        )
    check_writable(path)
    if ending(path) not in PAGES:
        canvas(1, 1, "tight")  # raises ExportError if matplotlib cannot be loaded
    if ending(path) == ".mp4" and shutil.which("ffmpeg") is None:
        raise ExportError(
            f"cannot write {shown_name(path)}: .mp4 needs the program ffmpeg, which is not installed. Install it, for instance "
            "with apt-get install ffmpeg or brew install ffmpeg, or write .gif or .html."
        )


def check_visible(tree: Tree, options: AnimationOptions) -> None:
    """Check that a model has visible parts, beams with the given values, and the points of trails.

    Raises
    ------
    DeclarationError
        If not; the message lists the available values.
    """
    if isinstance(tree, Component):
        shapes_of([tree], options.values)
        for key in options.trails:
            trail_of(tree, key)


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
    trails = [trail_of(tree, key) for key in options.trails]
    return Run(tree, result.time[places], at_places(result, places), plots, title, stopped, trails)


def trail_of(tree: Component, key: Key) -> PartShape:
    """Return the trail of a frame or a position.

    Raises
    ------
    DeclarationError
        If the model has no such point.
    """
    origin = f"{key}.r_0"
    try:
        quantity = find(tree, origin if isinstance(key, str | Path) else key)
    except DeclarationError:
        quantity = find(tree, key)
    if quantity.shape != (3,):
        raise DeclarationError(
            f"trails: {quantity.name} is not a point. Name a frame, such as rod.frame_b, or a position of three coordinates."
        )
    return PartShape(str(key), "trail", geometry.Trail(as_expr([quantity.column[k] for k in range(3)])))


def at_places(result: Animatable, places: np.ndarray) -> Any:
    """Return an evaluator at the given times only, to save work if the result supports it."""
    evaluate = result._evaluate
    if len(places) == result.time.size:
        return evaluate
    if hasattr(evaluate, "at"):
        return evaluate.at(places)
    return lambda column: np.asarray(evaluate(column))[places]
