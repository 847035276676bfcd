"""Several results in one moving picture."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path

from acausal.animation.frames import FRAMES
from acausal.errors import DeclarationError
from acausal.language.arguments import fitting
from acausal.language.values import shown
from acausal.locks import alone
from acausal.result.animated import AnimationOptions, write
from acausal.result.lookup import Key
from acausal.result.result import Result


@fitting
@alone
def animate(
    results: Mapping[str, Result],
    path: str | Path,
    *,
    frames: int = FRAMES,
    plots: Sequence[Key] = (),
    values: Sequence[str] = (),
    title: str = "",
    deformation: float = 1.0,
) -> None:
    """Write the moving picture of several runs, side by side or one over the other, so that it is seen what differs.

    Parameters
    ----------
    results : mapping of str to Result
        By the names that are shown.
    path : str or Path
        Name of the file, its ending as of `Result.animate`.
    frames : int
        Longer results are thinned to about so many times.
    plots : sequence of str, Path or Expr
        What is drawn under the picture; the outputs if there is none.
    values : sequence of str
        What beams can be coloured by besides what costs nothing, as of `Result.animate`.
    title : str
        Of the picture; the names of the models if not given.
    deformation : float
        Scale of deformations, 1 to 1000; the page can change it.

    Raises
    ------
    ExportError
        If the file cannot be written, or its ending tells no kind of picture; before anything is computed.
    DeclarationError
        If the results are none, or one has no time, no model any more, nothing to be seen, or no such values.

    Examples
    --------
    >>> ac.animate({"rigid": a, "elastic": b}, "crank.html")  # doctest: +SKIP
    """
    if isinstance(results, Result):
        raise DeclarationError(
            'one result is animated by result.animate("run.html"); several by their names, {"rigid": a, "elastic": b}.'
        )
    if not isinstance(results, Mapping) or not results or not all(isinstance(r, Result) for r in results.values()):
        raise DeclarationError(
            f'results are given by the names that are shown, {{"rigid": a, "elastic": b}}, not by {shown(results)}.'
        )
    write(
        {str(name): result for name, result in results.items()},
        path,
        AnimationOptions(frames, plots, values, title, deformation),
    )
