"""Results by name, as functions that compare them take them."""

from __future__ import annotations

from collections.abc import Mapping

from acausal.errors import DeclarationError
from acausal.language.value_checks import shown
from acausal.result.result import Result


def checked_results(results: Mapping[str, Result], alone: str) -> dict[str, Result]:
    """Return results by name.

    Parameters
    ----------
    results : mapping of str to Result
        The argument of a function that compares results.
    alone : str
        What to do with one result, for the message.

    Raises
    ------
    DeclarationError
        If it is not such a mapping.
    """
    if isinstance(results, Result):
        raise DeclarationError(f'{alone}, several with a dictionary, {{"rigid": a, "elastic": b}}.')
    if not isinstance(results, Mapping) or not results or not all(isinstance(r, Result) for r in results.values()):
        raise DeclarationError(
            f'results is a dictionary of results by name, {{"rigid": a, "elastic": b}}, not {shown(results)}.'
        )
    return {str(name): result for name, result in results.items()}
