"""Moving pictures of results: what of a result they show, and the files that they are written to."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

from acausal.animation.document import document
from acausal.animation.frames import FRAMES, thinned
from acausal.animation.scene import Plot, Run
from acausal.errors import DeclarationError
from acausal.language.component import Component
from acausal.result.lookup import find

if TYPE_CHECKING:
    from acausal.result.result import Result


def run_of(result: Result, frames: int = FRAMES, stopped: str | None = None) -> Run:
    """Return what is shown of a result: at most about so many frames of it, and its outputs.

    Raises
    ------
    DeclarationError
        If the result has no time, or no model any more.
    """
    tree = result.tree
    if not isinstance(tree, Component):
        raise DeclarationError(
            f"{result!r} was loaded without its model, which says what the parts look like: animate it where it was simulated, "
            "or simulate again."
        )
    if not result.time.size:
        raise DeclarationError(f"{result!r} has no time at which there is something to be seen.")
    places = thinned(result.time, frames)
    quantities = [find(tree, name) for name in result.outputs]
    plots = [Plot(name, unit, q[index].column) for q in quantities for index, name, unit in q.entries]
    return Run(tree, result.time[places], _at(result, places), plots, result.title or type(tree).__name__, stopped)


def _at(result: Result, places: np.ndarray) -> Any:
    """Return a function that evaluates expressions at some of the times only, where that is possible."""
    evaluate = result._evaluate
    if len(places) == result.time.size:
        return evaluate
    if hasattr(evaluate, "at"):
        return evaluate.at(places)
    return lambda column: np.asarray(evaluate(column))[places]
