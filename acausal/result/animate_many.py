"""animate(): several results in one animation."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path

from acausal.animation.frames import FRAMES
from acausal.language.call_arguments import checked_arguments
from acausal.locks import exclusive
from acausal.result.animated import AnimationOptions, write
from acausal.result.lookup import Key
from acausal.result.named_results import checked_results
from acausal.result.result import Result


@checked_arguments
@exclusive
def animate(
    results: Mapping[str, Result],
    path: str | Path,
    *,
    frames: int = FRAMES,
    plots: Sequence[Key] = (),
    values: Sequence[str] = (),
    title: str = "",
    deformation: float = 1.0,
    trails: Sequence[Key] = (),
    size: tuple[int, int] | None = None,
    view: str | None = None,
    fps: int | None = None,
) -> None:
    """Animate several runs, side by side or overlaid, to compare them.

    Parameters
    ----------
    results : mapping of str to Result
        Results by the names to show.
    path : str or Path
        Name of the file, with a suffix as in `Result.animate`.
    frames : int
        Approximate number of frames to which longer results are thinned.
    plots : sequence of str, Path or Expr
        Quantities plotted below the picture; the outputs if empty.
    values : sequence of str
        Extra quantities by which beams can be coloured, as in `Result.animate`.
    title : str
        Title of the picture; the names of the models if not given.
    deformation : float
        Scale of deformations, 1 to 1000; the page can change it.
    trails : sequence of str, Path or Expr
        Points whose paths are drawn, as in `Result.animate`.
    size : pair of int, optional
        Width and height of a film or still, in pixels.
    view : str, optional
        "front", "top", "right" or "iso".
    fps : int, optional
        Frames per second of a film.

    Raises
    ------
    ExportError
        If the file cannot be written, or its suffix is unknown; before anything is computed.
    DeclarationError
        If there is no result, one of them has no times, no model, nothing visible, or no such values or points, or an option is
        invalid.

    Examples
    --------
    >>> ac.animate({"rigid": a, "elastic": b}, "crank.html")  # doctest: +SKIP
    """
    write(
        checked_results(results, 'animate one result with result.animate("run.html")'),
        path,
        AnimationOptions(frames, plots, values, title, deformation, trails, size, view, fps),
    )
