"""Moving pictures of results: what of a result they show, and the files that they are written to."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from html import escape
from pathlib import Path
from typing import Any, Protocol

import numpy as np

from acausal.animation.document import document_of, scenes
from acausal.animation.frames import FRAMES, select_frames
from acausal.animation.page import html
from acausal.animation.scene import Plot, Run, shapes_of
from acausal.errors import AcausalError, DeclarationError, ExportError
from acausal.language.component import Component
from acausal.language.values import shown as code
from acausal.result.files import check_writable, shown_name, whole
from acausal.result.lookup import Key, Tree, find
from acausal.result.plots import canvas

PAGES = (".html", ".htm")
EXAGGERATED = 1000  # times a deformation, at most
ENDINGS = (*PAGES, ".gif", ".png")


class Moving(Protocol):
    """What is needed of a result."""

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
class Asked:
    """What a user asks for: the arguments of `Result.animate`."""

    frames: int = FRAMES
    plots: Sequence[Key] = ()
    values: Sequence[str] = ()
    title: str = ""
    deformation: float = 1.0

    def check(self) -> None:
        """Refuse what no picture can be made of."""
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


DEFAULT = Asked()


def write(results: Mapping[str, Moving], path: str | Path, asked: Asked) -> None:
    """Write a moving picture of results by their names; errors are those of `Result.animate`."""
    check_animation(path)
    asked.check()
    title = asked.title
    found = scenes({name: run_of(result, asked) for name, result in results.items()}, asked.values)
    if _ending(path) in PAGES:
        with whole(path) as file:
            file.write(html(document_of(found, asked.values, title, asked.deformation)))
        return
    from acausal.result.films import film, still

    data = (film if _ending(path) == ".gif" else still)(found, title, asked.values, asked.deformation)
    with whole(path, "wb") as file:
        file.write(data)


def check_animation(path: str | Path) -> None:
    """Check whether a moving picture can be written: known ending, writable place.

    Raises
    ------
    ExportError
        With the reason why not.
    """
    if isinstance(path, str | Path) and str(path).strip() and _ending(path) not in ENDINGS:
        raise ExportError(
            f"cannot write {shown_name(path)}: the name of a moving picture ends in .html, a page that any browser plays, "
            "or in .gif or .png."
        )
    check_writable(path)
    if _ending(path) not in PAGES:
        canvas(1, 1, "tight")  # refuses where matplotlib cannot be loaded


def check_visible(tree: Tree, values: Sequence[str] = ()) -> None:
    """Refuse a model in which there is nothing to be seen, or a value along beams that it has not.

    Raises
    ------
    DeclarationError
        Which names what there is.
    """
    if isinstance(tree, Component):
        shapes_of([tree], values)


def in_notebook(result: Moving) -> str | None:
    """Return the page of a result as a frame of a notebook, which runs its scripts and nothing else.

    Parameters
    ----------
    result : Result
        Where there is nothing to be seen, None is returned: the notebook shows its text instead.
    """
    try:
        page = html(document_of(scenes({result.title: run_of(result)})))
    except AcausalError:
        return None
    return (
        '<iframe sandbox="allow-scripts allow-downloads" style="width: 100%; height: 600px; border: 0" '
        f'srcdoc="{escape(page)}"></iframe>'
    )


def run_of(result: Moving, asked: Asked = DEFAULT) -> Run:
    """Return what is shown of a result: about so many frames of it at most, and its outputs or other scalars.

    Raises
    ------
    DeclarationError
        If the result has no time, or no model any more.
    """
    tree = result.tree
    if not isinstance(tree, Component):
        raise DeclarationError(
            f"{result!r} was loaded or made without a model, which says what the parts look like: animate it where it was "
            "simulated, or simulate again."
        )
    if not result.time.size:
        raise DeclarationError(f"{result!r} is empty: there is no time at which something could be seen.")
    places = select_frames(result.time, asked.frames)
    quantities = [find(tree, key) for key in asked.plots or result.outputs]
    plots = [Plot(name, unit, q[index].column) for q in quantities for index, name, unit in q.entries]
    title, stopped = result.title or type(tree).__name__, result.stats.get("stopped")
    return Run(tree, result.time[places], _at(result, places), plots, title, stopped)


def _at(result: Moving, places: np.ndarray) -> Any:
    """Return a function that evaluates expressions at some of the times only, where that is possible."""
    evaluate = result._evaluate
    if len(places) == result.time.size:
        return evaluate
    if hasattr(evaluate, "at"):
        return evaluate.at(places)
    return lambda column: np.asarray(evaluate(column))[places]


def _ending(path: str | Path) -> str:
    return Path(path).suffix.lower()
