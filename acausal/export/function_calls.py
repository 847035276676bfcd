"""Refusal of functions in Python and of other libraries, which no file can hold."""

from __future__ import annotations

from acausal.compiler import CompiledModel
from acausal.errors import ExportError


def refuse_calls(compiled: CompiledModel) -> None:
    """Raise ExportError if a model calls functions at its events, or of other libraries."""
    if owners := compiled.guards.calls.owners():
        raise ExportError(
            f"{type(compiled.tree).__name__} calls functions in Python, which cannot be exported: {owners}. Write them as "
            "blocks, or make their signals inputs and outputs of the model."
        )
    if externals := compiled.reduced.flat.parameters.externals:
        names = ", ".join(dict.fromkeys(own.path for own in externals))
        raise ExportError(
            f"{type(compiled.tree).__name__} calls functions of other libraries, which cannot be exported: {names}. Make their "
            "signals inputs and outputs of the model."
        )
