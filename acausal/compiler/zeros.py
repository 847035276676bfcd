"""Parameters whose value 0 removes terms that a model needs: where it is incomplete, they are tried with other values."""

from __future__ import annotations

import time as clock
from collections.abc import Iterable, Mapping
from typing import Any

import numpy as np

from acausal.errors import AcausalError, StructurallySingularError, UnbalancedModelError
from acausal.flatten import FlatModel, flatten
from acausal.flatten.tree import join, walk
from acausal.language import fields as f
from acausal.language.component import Component
from acausal.reduce import plan_of

MOST, SECONDS = 12, 5.0  # parameters that are tried, and how long


def mend_of_zeros(model: Component, parameters: Mapping[str, Any] | None, flat: FlatModel, error: AcausalError) -> str:
    """Return a line that names the parameters whose zeros leave a model incomplete, "" if they are not the cause.

    Parameters
    ----------
    model : Component
        The model as constructed.
    parameters : mapping of str to value or None
        Values by path that replace those of the model.
    flat : FlatModel
        What was made of both.
    error : AcausalError
        Why its structure was refused, raised while a StructuralSingularity was handled.
    """
    zeros = _zeros(flat, getattr(error.__context__, "under", ()))
    ends = clock.perf_counter() + SECONDS

    def completes(*tried: str) -> bool | None:
        """Whether the model has as many equations as it needs, None where it rejects the values."""
        try:
            tried_flat = flatten(model, {**(parameters or {}), **{path: zeros[path][0] for path in tried}})
        except AcausalError:
            return None
        try:
            plan_of(tried_flat)
        except (UnbalancedModelError, StructurallySingularError):
            return False
        except AcausalError:
            return None
        return True

    found = {path: completes(path) for path in zeros if clock.perf_counter() < ends}
    alone = [path for path, complete in found.items() if complete]
    needed = [path for path, complete in found.items() if complete is False]
    if not alone and (len(needed) < 2 or not completes(*needed)):
        return ""
    for path in () if alone else tuple(needed):
        if clock.perf_counter() < ends and completes(*(rest := [p for p in needed if p != path])):
            needed = rest
    lines = [f"  {zeros[path][1]}" for path in alone or needed]
    which = " one of" if len(alone) > 1 else ""
    return f"A parameter is 0, so the terms that it multiplies were removed. The model is complete with{which}:\n" + (
        "\n".join(lines)
    )


def _zeros(flat: FlatModel, parts: Iterable[Any]) -> dict[str, tuple[Any, str]]:
    """Paths of parameters near under-determined parts that are 0 as a whole, each with another value and the remedy."""
    parts, names, origins = list(parts), flat.unknowns.names, flat.equations.origins
    touched = {names[v] for part in parts for v in part.variables if v < len(names)}
    touched |= {origins[e].path for part in parts for e in part.equations if e < len(origins)}
    set_ = {name.partition("[")[0] for name in flat.parameters.structural_zeros}
    some = {name.rpartition("[")[0] for name in flat.parameters.names}
    found = {}
    for component in walk(flat.tree):
        path = component._path
        if path and not any(t == path or t.startswith((f"{path}.", f"der({path}.")) for t in touched):
            continue
        for name, declared in component.fields.items():
            whole = join(path, name)
            if isinstance(declared, f.Parameter) and whole in set_ and whole not in some and len(found) < MOST:
                where = f"{path}: " if path else ""
                mend = f"{where}{type(component).__name__}({name}=...), {declared.description}"
                found[whole] = (_other(getattr(component, name).shape), mend)
    return found


def _other(shape: tuple[int, ...]) -> np.ndarray:
    """Another value than 0: a unit matrix, a unit vector or 1."""
    value = np.zeros(shape)
    value[tuple(np.arange(min(shape)) for _ in shape) if len(shape) == 2 else (0,) * len(shape)] = 1.0
    return value
