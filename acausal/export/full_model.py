"""The compiled model of an export, with or without the unknowns that stay 0."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np

from acausal.compiler import CompiledModel, ready
from acausal.errors import ExportError
from acausal.language.component import Component


def exported(
    model: Component | CompiledModel, parameters: Mapping[str, Any] | None, full: bool
) -> tuple[CompiledModel, np.ndarray]:
    """Return the compiled model and the values of its free parameters.

    Parameters
    ----------
    model : Component or CompiledModel
        The model.
    parameters : mapping of str to value or None
        Values by path.
    full : bool
        Whether unknowns that stay 0 remain.

    Raises
    ------
    ExportError
        If these were eliminated, and the model cannot be compiled again.
    """
    compiled, p = ready(model, parameters, full=full)
    if full and compiled.reduced.flat.stays_zero:
        raise ExportError("full=True compiles the model again: pass the model, not one loaded from a file.")
    return compiled, p
