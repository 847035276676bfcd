"""Diagnosis of singular models: find the zero parameters whose terms would make the model complete, by trial."""

from __future__ import annotations

import re
import time as clock
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from typing import Any

import casadi as ca
import numpy as np

from acausal.errors import AcausalError, StructurallySingularError, UnbalancedModelError
from acausal.flatten import FlatModel, flatten
from acausal.flatten.component_tree import join, walk
from acausal.flatten.origin import Origin
from acausal.language import fields as f
from acausal.language.component import Component
from acausal.language.expression import Expr
from acausal.reduce import plan_of
from acausal.symbols import scalars, stacked, vec

MOST, SECONDS = 40, 5.0  # limits of the search: parameters that are tried, and seconds
SHORT = 3  # unknowns that the message names


@dataclass(frozen=True)
class _Zero:
    """A parameter that is 0, as a whole or on its diagonal: its component, a value to try, and the remedy."""

    component: Component
    whole: bool
    trial: np.ndarray
    remedy: str


def remedy_for_zeros(
    model: Component, parameters: Mapping[str, Any] | None, flat: FlatModel, error: AcausalError
) -> str:
    """Return a message on the parameters whose zeros leave a model incomplete, "" if they are not the cause.

    Parameters
    ----------
    model : Component
        The model as constructed.
    parameters : mapping of str to value or None
        Values by path that replace those of the model.
    flat : FlatModel
        The flattened model, with all unknowns.
    error : AcausalError
        The structural error, raised while a StructuralSingularity was handled.
    """
    zeros = _zeros(flat, getattr(error.__context__, "under", ()))
    ends, completed = clock.perf_counter() + SECONDS, dict[tuple[str, ...], FlatModel]()

    def lacking(*tried: str) -> float:
        """Return how many equations the model lacks with trial values of these, infinity if it rejects them."""
        try:
            trials = {path: zeros[path].trial for path in tried}
            tried_flat = flatten(model, {**(parameters or {}), **trials}, full=True)
            plan_of(tried_flat)
        except (UnbalancedModelError, StructurallySingularError) as error:
            return _lacking(error) or np.inf
        except AcausalError:
            return np.inf
        completed[tried] = tried_flat
        return 0

    found = {path: lacking(path) for path in zeros if clock.perf_counter() < ends}
    alone = [path for path, count in found.items() if count == 0]
    # Two factors of one product must be nonzero together.
    needed = [path for path, count in found.items() if count < _lacking(error)] or [
        p for p in found if found[p] < np.inf
    ]
    if not alone and (len(needed) < 2 or lacking(*needed)):
        return ""
    for path in () if alone else tuple(needed):
        if clock.perf_counter() < ends and not lacking(*(rest := [p for p in needed if p != path])):
            needed = rest
    ways = [(path,) for path in alone] or [tuple(needed)]
    gained = [_gained_terms(flat, completed[way], [zeros[path] for path in way]) for way in ways]
    return _message([zeros[path] for path in alone or needed], bool(alone), gained)


def _lacking(error: AcausalError) -> int:
    """Return how many equations the under-determined part of a singular model lacks."""
    return sum(len(part.variables) - len(part.equations) for part in getattr(error.__context__, "under", ()))


def _message(zeros: list[_Zero], alone: bool, gained: list[dict[str, str]]) -> str:
    """Return the message: the unknowns that all remedies determine, and the remedies; one is enough if `alone`."""
    common = [words for name, words in gained[0].items() if all(name in other for other in gained)]
    what = ", ".join(list(dict.fromkeys(common or gained[0].values()))[:SHORT])
    head = f"Nothing determines {what}: a" if what else "A"
    which = "this" if len(zeros) == 1 else "one of these" if alone else "these"
    where = "is 0" if any(zero.whole for zero in zeros) else "has a 0 on its diagonal"
    lines = "\n".join(f"  {zero.remedy}" for zero in zeros)
    return (
        f"{head} parameter {where}, so the terms that it multiplies were removed. Give {which}:\n{lines}\n"
        "or connect a part that has mass or inertia, or add an equation that determines it."
    )


def _gained_terms(flat: FlatModel, completed: FlatModel, zeros: list[_Zero]) -> dict[str, str]:
    """Return the unknowns that gained terms, by name, with their descriptions in the components of the zeros."""
    before, after = _inside(flat), _inside(completed)
    new = {name for origin, names in after.items() for name in names - before.get(origin, set())}
    wanted = {name.removeprefix("der(").removesuffix(")") for name in new}
    paths, eliminated = {zero.component._path for zero in zeros}, completed.unknowns.eliminated
    words = {}
    for component in walk(completed.tree):
        for name, declared in component.fields.items() if component._path in paths else ():
            if isinstance(declared, f.Variable):
                column = ca.substitute([vec(getattr(component, name).sx)], [eliminated[0]], [eliminated[1]])[0]
                text = f"`{join(component._path, name)}` ({declared.description})"
                words |= {s.element_hash(): text for s in scalars(column)}
    own = zip(scalars(completed.unknowns.symbols), completed.unknowns.names, strict=True)
    return {name: words.get(s.element_hash(), f"`{name}`") for s, name in own if name in wanted}


def _inside(flat: FlatModel) -> dict[str, set[str]]:
    """Return the names of the unknowns in the equations of each origin."""
    names = {s.element_hash(): n for s, n in zip(scalars(flat.unknowns.symbols), flat.unknowns.names, strict=True)}
    found: dict[str, set[str]] = {}
    for residual, origin in zip(scalars(flat.equations.residuals), flat.equations.origins, strict=True):
        held = (names.get(s.element_hash(), "") for s in ca.symvar(residual))
        found.setdefault(str(origin), set()).update(held)
    return found


def _zeros(flat: FlatModel, parts: Iterable[Any]) -> dict[str, _Zero]:
    """Find zero parameters, and matrices with a 0 on the diagonal, near the under-determined parts."""
    parts, names, origins = list(parts), flat.unknowns.names, flat.equations.origins
    touched = {names[v] for part in parts for v in part.variables if v < len(names)}
    touched |= {origins[e].path for part in parts for e in part.equations if e < len(origins)}
    moved = _aliased(flat, {v for part in parts for v in part.variables})
    set_, some = (
        {re.sub(r"\[[\d,]+\]$", "", name) for name in own}  # an entry counts for its parameter
        for own in (flat.parameters.structural_zeros, flat.parameters.names)
    )
    # If no equation is missing, a parameter that is 0 as a whole is not the cause.
    lacks = not parts or any(len(part.equations) < len(part.variables) for part in parts)
    found = {}
    for component in walk(flat.tree):
        path = component._path
        near = any(t == path or t.startswith((f"{path}.", f"der({path}.")) for t in touched)
        if path and not near and path not in moved:
            continue
        for name, declared in component.fields.items():
            whole = join(path, name)
            if not isinstance(declared, f.Parameter) or len(found) == MOST:
                continue
            zero = whole in set_ and whole not in some
            if (zero and lacks) or (_is_singular(getattr(component, name)) and not _bound_to_owner(whole, found)):
                where = f"{Origin.of(component)}: " if path else ""
                remedy = f"{where}{type(component).__name__}({name}=...), {declared.description}"
                found[whole] = _Zero(component, zero, _trial_value(getattr(component, name).shape), remedy)
    return found


def _aliased(flat: FlatModel, unknowns: set[int]) -> set[str]:
    """Return the paths of components with a variable that is an alias of the unknowns or of their derivatives."""
    own, up = scalars(flat.unknowns.symbols), flat.unknowns.derivative
    reached = [v for v in unknowns if v < len(own)]
    reached += (up[v] for v in reached if up[v] >= 0)
    inside = {own[v].element_hash() for v in reached}
    columns = [(c._path, vec(e.sx)) for c in walk(flat.tree) for n, e in vars(c).items() if _is_variable(c, n)]
    paths = [path for path, column in columns for _ in range(column.numel())]
    remaining = ca.substitute([stacked([column for _, column in columns])], *([e] for e in flat.unknowns.eliminated))[0]
    held = zip(paths, scalars(remaining), strict=True)
    return {path for path, e in held if any(s.element_hash() in inside for s in ca.symvar(e))}


def _is_variable(component: Component, name: str) -> bool:
    return isinstance(component.fields.get(name), f.Variable)


def _is_singular(value: Any) -> bool:
    """Return whether a value is a matrix with a 0 on its diagonal, such as the inertia of a thin rod."""
    if not isinstance(value, Expr) or len(value.shape) != 2 or value.sx.size1() != value.sx.size2():
        return False
    return any(value.sx[k, k].is_zero() for k in range(value.sx.size1()))


def _bound_to_owner(path: str, found: Mapping[str, _Zero]) -> bool:
    """Return whether a found parameter of the same name in an owner determines this parameter of a part."""
    name = path.rpartition(".")[2]
    return any(
        path.startswith(f"{zero.component._path}.") and whole.rpartition(".")[2] == name
        for whole, zero in found.items()
    )


def _trial_value(shape: tuple[int, ...]) -> np.ndarray:
    """Return a nonzero trial value: a unit matrix, a unit vector or 1."""
    value = np.zeros(shape)
    value[tuple(np.arange(min(shape)) for _ in shape) if len(shape) == 2 else (0,) * len(shape)] = 1.0
    return value
