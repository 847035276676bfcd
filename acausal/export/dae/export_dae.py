"""export_dae(): write a model as an open DAE, for `load_dae` and other programs."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from importlib.metadata import version
from pathlib import Path
from typing import Any

import numpy as np

from acausal.compiler import CompiledModel
from acausal.compiler.requirements import Stated, statements
from acausal.errors import ExportError
from acausal.export.dae import component_tree, dae_archive
from acausal.export.dae.base_modelica import base_modelica
from acausal.export.dae.dae_listing import listing
from acausal.export.dae.expressions import NAMES, Writer
from acausal.export.dae.json_values import encoded
from acausal.export.full_model import exported
from acausal.export.function_calls import refuse_calls
from acausal.export.local_columns import local_columns
from acausal.language.call_arguments import checked_arguments
from acausal.language.component import Component
from acausal.language.docstring import first_line
from acausal.language.functions import feedback, initial, time
from acausal.language.validity_statements import Expectation, Separation
from acausal.locks import exclusive
from acausal.result import check_writable
from acausal.simulation.model_settings import declared_settings

# Symbols that all models share.
SHARED = {"time": time, "initial": initial, "feedback": feedback}


@checked_arguments
@exclusive
def export_dae(
    model: Component | CompiledModel,
    path: str | Path,
    *,
    parameters: Mapping[str, Any] | None = None,
    full: bool = False,
) -> None:
    """Write a model as an open DAE, an archive for `load_dae` and other programs.

    The archive contains variables, parameters and equations with names, units and origins in JSON, all expressions as lists
    of operations, and the model in Base Modelica; docs/background/open-dae.md describes the format.

    Parameters
    ----------
    model : Component or CompiledModel
        The model.
    path : str or Path
        Name of the file, which is written atomically.
    parameters : mapping of str to value, optional
        Values by path for the file.
    full : bool
        Whether unknowns that stay 0 remain.

    Raises
    ------
    ExportError
        If the file cannot be written, or the model contains something that the format cannot represent.
    """
    check_writable(path)
    compiled, p = exported(model, parameters, full)
    refuse_calls(compiled)
    tables = getattr(p, "tables", {})
    own = replace(compiled.reduced.flat.parameters, tables=tables)
    reduced = replace(compiled.reduced, flat=replace(compiled.reduced.flat, parameters=own))
    numbers, columns = local_columns(tables)
    p = np.array([numbers.get(k, value) for k, value in enumerate(p.tolist())])
    writer = Writer()
    kept, unchecked = _stated(compiled)
    values = component_tree.evaluated(compiled.tree)
    inside = {
        "model": encoded(reduced, writer.add),
        "values": encoded(p, writer.add),
        "tree": component_tree.encode_tree(compiled.tree, values, kept, writer.add),
        "settings": {name: encoded(value, writer.add) for name, value in declared_settings(compiled).items()},
    }
    described = listing(compiled, p, values, writer.add)
    operations, symbols = writer.operations()
    hashes = [s.element_hash() for s in symbols]
    places = {name: expr.sx.element_hash() for name, expr in SHARED.items()}
    first = {
        "acausal": version("acausal"),
        "model": type(compiled.tree).__name__,
        "description": first_line(type(compiled.tree)),
        **described,
        "columns": [column[1:].tolist() for column in columns],
        "unchecked": unchecked,
        "operations": list(NAMES),
        "symbols": operations.symbols,
        "shared": {name: hashes.index(h) if h in hashes else None for name, h in places.items()},
        "expressions": operations.shapes,
    }
    members = {
        "model.json": dae_archive.as_json(inside),
        "model.mo": _modelica(compiled, p).encode(),
        "constants": operations.constants.tobytes(),
        "operations": operations.operations.tobytes(),
        "places": operations.places.tobytes(),
    }
    dae_archive.write(path, first, members)


def _modelica(compiled: CompiledModel, p: np.ndarray) -> str:
    """Return the model in Base Modelica, or a comment if Base Modelica cannot express it."""
    try:
        return base_modelica(compiled, p)
    except ExportError as error:
        return f"// There is no Base Modelica of this model: {error}\n"


def _stated(compiled: CompiledModel) -> tuple[list[Stated], list[str]]:
    """Return the statements of components, and the subjects of requirements checked by functions, which are left out."""
    kept: list[Stated] = []
    unchecked: list[str] = []
    for statement, origin in compiled.requirements.stated:
        if statement.warning:
            continue
        if callable(statement.problem):
            unchecked.append(getattr(statement.subject, "name", "") or origin.path)
            kept.append((replace(statement, problem=""), origin))
        else:
            kept.append((statement, origin))
    kept += statements(compiled.tree, "validity", (Expectation, Separation))
    return kept, unchecked
