"""plot(): several results on common axes."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import TYPE_CHECKING

from acausal.errors import DeclarationError
from acausal.language.call_arguments import checked_arguments
from acausal.locks import exclusive
from acausal.result.lookup import Key
from acausal.result.named_results import checked_results
from acausal.result.plots import Curve, curves, draw, finish
from acausal.result.result import Result

if TYPE_CHECKING:
    from matplotlib.figure import Figure


@checked_arguments
@exclusive
def plot(
    results: Mapping[str, Result],
    *keys: Key,
    x: Key | None = None,
    title: str = "",
    path: str | Path | None = None,
    show: bool | None = None,
) -> Figure:
    """Draw quantities of several results on common axes, one for each unit, to compare them.

    Parameters
    ----------
    results : mapping of str to Result
        Results by the names in the legend; they may come from different models, at different times.
    *keys : str, Path or Expr
        Quantities to plot; the outputs that all results have if none are given.
    x : str, Path or Expr, optional
        A scalar over which they are drawn, instead of time.
    title : str
        Title of the picture.
    path : str or Path, optional
        Write the picture there; the suffix determines the format.
    show : bool, optional
        True opens the picture in the system's viewer.

    Returns
    -------
    Figure
        A figure of matplotlib, to be changed and saved.

    Raises
    ------
    DeclarationError
        If a result does not have one of the quantities; the message names the result.

    Examples
    --------
    >>> ac.plot({"rigid": a, "elastic": b}, "tip_x", path="tip.png")  # doctest: +SKIP
    """
    named = checked_results(results, 'plot one result with result.plot("tip_x")')
    first, *others = named.values()
    shared = keys or [name for name in first.outputs if all(name in other.outputs for other in others)]
    drawn: list[Curve] = []
    for name, result in named.items() if shared else ():
        try:
            drawn += curves(result, shared, x, name)
        except DeclarationError as error:
            raise DeclarationError(f"{name}: {error}") from None
    return finish(draw(drawn, title), path, show)
