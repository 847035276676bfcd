"""load_dae(): read an open DAE as a compiled model, without the model's classes."""

from __future__ import annotations

import time as clock
from pathlib import Path
from typing import Any

import casadi as ca
import numpy as np

from acausal.compiler import CompiledModel
from acausal.export.dae import component_tree, dae_archive
from acausal.export.dae.export_dae import SHARED
from acausal.export.dae.expressions import FLOAT, INT, NAMES, Operations, Reader
from acausal.export.dae.json_values import decoded
from acausal.language.call_arguments import checked_arguments
from acausal.language.component import Component
from acausal.locks import exclusive
from acausal.reduce import ReducedModel
from acausal.result import document


@checked_arguments
@exclusive
def load_dae(path: str | Path) -> CompiledModel:
    """Read a model written by `export_dae`; its classes are not needed.

    Parameters
    ----------
    path : str or Path
        The file.

    Returns
    -------
    CompiledModel
        The model simulates like the original; sizes and effects, which need the classes, are fixed.

    Raises
    ------
    DeclarationError
        If the file cannot be read, is not an open DAE, has another version, or is truncated or damaged.
    """
    begun = clock.perf_counter()
    first, members = dae_archive.read(path)
    try:
        reduced, settings = _read(first, members)
        compiled = CompiledModel(reduced, {}, None, declared=settings)
        compiled.parameter_values(None)
    except (ArithmeticError, AttributeError, LookupError, RuntimeError, TypeError, ValueError):
        # The checksums are correct, so the writer produced the inconsistency.
        dae_archive.refuse(path, "its content is inconsistent, so it was not written by export_dae")
    compiled.seconds["load"] = clock.perf_counter() - begun
    return compiled


def _read(first: dict[str, Any], members: dict[str, bytes]) -> tuple[ReducedModel, dict[str, Any]]:
    if tuple(first["operations"]) != NAMES:
        raise ValueError("the operations differ from those of this version")
    inside = document(members["model.json"].decode())
    expressions = _expressions(first, members)

    def decode(data: Any) -> Any:
        return decoded(data, expressions, more)

    more: dict[str, dict[str, Any]] = {"FlatEquations": {"eliminated_by": lambda row: (), "repeats": lambda: ()}}
    root = component_tree.decode_tree(inside["tree"], decode)
    if not isinstance(root, Component):
        raise ValueError("there is no model")
    more["FlatModel"] = {"tree": root}
    reduced = decode(inside["model"])
    own = reduced.flat.parameters
    own.values[:] = decode(inside["values"])
    own.values[list(own.tables)] = [table.number for table in own.tables.values()]
    return reduced, {name: decode(data) for name, data in inside["settings"].items()}


def _expressions(first: dict[str, Any], members: dict[str, bytes]) -> Reader:
    shared = {place: SHARED[name].sx for name, place in first["shared"].items() if place is not None}
    given = Operations(
        np.frombuffer(members["constants"], FLOAT),
        list(first["symbols"]),
        np.frombuffer(members["operations"], INT).reshape(-1, 3),
        np.frombuffer(members["places"], INT),
        first["expressions"],
    )
    return Reader(given, lambda place, name: shared[place] if place in shared else ca.SX.sym(name))
