"""Refusal of functions in Python, which no file can hold."""

from __future__ import annotations

from acausal.compiler import CompiledModel
from acausal.errors import ExportError


def refuse_calls(compiled: CompiledModel) -> None:
    """Raise ExportError if a model calls functions at its events."""
    if owners := compiled.guards.calls.owners:
        raise ExportError(
            f"{type(compiled.tree).__name__} calls functions in Python, which cannot be exported: {owners}. Write them as "
            "blocks, or make their signals inputs and outputs of the model."
        )
