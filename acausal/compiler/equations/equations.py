"""Equations of a part of a model."""

from __future__ import annotations

from acausal.compiler.equations.listing import EquationList
from acausal.compiler.equations.reduced import reduced_equations
from acausal.compiler.equations.written import written_equations
from acausal.compiler.model_source import Source
from acausal.errors import DeclarationError
from acausal.flatten.collected_statements import CollectedStatements, collect_statements
from acausal.flatten.component_tree import walk
from acausal.language.component import Component
from acausal.nearest import suggestions
from acausal.reduce import ReducedModel


def equations_of(reduced: ReducedModel, source: Source | None, part: str, as_reduced: bool) -> EquationList:
    """Return the equations of a part and of the parts in it, in sympy.

    Parameters
    ----------
    reduced : ReducedModel
        The equations of the model.
    source : Source, optional
        What it was compiled from.
    part : str
        Path of a part, "" for the whole model, with its connections.
    as_reduced : bool
        Whether der(x) = f and 0 = g of the integrated system are returned, not the statements of the classes.

    Raises
    ------
    DeclarationError
        The model has no such part, or was loaded from a file, which has the reduced equations only.
    """
    if as_reduced:
        _check(reduced.flat.tree, part)
        return reduced_equations(reduced, part)
    return written_equations(collected(source, reduced.flat.tree, part), part)


def collected(source: Source | None, tree: Component, part: str) -> CollectedStatements:
    """Return the statements of a model that has a part; see `equations_of`."""
    _check(tree, part)
    if source is None:
        raise DeclarationError(
            "a model that was loaded from a file has its reduced equations only: equations(reduced=True)."
        )
    return collect_statements(source.model, source.parameters)


def _check(tree: Component, part: str) -> None:
    paths = [component._path for component in walk(tree)]
    if part not in paths:
        raise DeclarationError(f"there is no part `{part}` in the model{suggestions(part, paths[1:], '')}")
