"""The tree of the parts of a result: variables, parameters and their descriptions, for the explorer."""

from __future__ import annotations

import inspect
from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from acausal.flatten.component_tree import walk
from acausal.language import fields as f
from acausal.language.component import Component
from acausal.language.value_checks import shown_or_kind
from acausal.result.lookup import Quantity, Tree

# Members of a part in the tree.
VARIABLES, PARAMETERS, PARTS = "variables", "parameters", "parts"
LISTED = 9  # entries of the longest structural array that is listed


def part_tree(
    tree: Tree, quantities: Mapping[str, tuple[Quantity, Sequence[int]]], refused: Mapping[str, str], title: str
) -> dict[str, Any]:
    """Return the parts that have quantities, nested, as `explorer.model` in page/DOCUMENT.md.

    Parameters
    ----------
    tree : Component or Catalogue
        The bound model, whose classes describe the parts; or a catalogue, which has names alone.
    quantities : mapping of str to (Quantity, sequence of int)
        Quantities by path, with the numbers of their `entries`.
    refused : mapping of str to str
        Paths that cannot be read, with the reason.
    title : str
        Name of the model.
    """
    known = {c._path: c for c in walk(tree)} if isinstance(tree, Component) else {}
    root = _part(title, known.get(""))
    parts = {"": root}
    for path, (quantity, numbers) in quantities.items():
        owner, _, name = path.rpartition(".")
        own = known[owner].fields.get(name) if owner in known else None
        kind = PARAMETERS if isinstance(own, f.Parameter) else VARIABLES
        _enter(parts, owner, known).setdefault(kind, []).append(_quantity(name, quantity, numbers, own))
    for path, why in refused.items():
        owner, _, name = path.rpartition(".")
        _enter(parts, owner, known).setdefault(VARIABLES, []).append({"name": name, "about": why, "value": "no value"})
    for path, part in parts.items():
        if path in known and (values := _structural(known[path])):
            part.setdefault(PARAMETERS, []).extend(values)
    return root


def _enter(parts: dict[str, dict[str, Any]], path: str, known: Mapping[str, Component]) -> dict[str, Any]:
    """Return the part of a path, made with the parts that it is in if it is new."""
    if path not in parts:
        owner, _, name = path.rpartition(".")
        parts[path] = _part(name, known.get(path))
        _enter(parts, owner, known).setdefault(PARTS, []).append(parts[path])
    return parts[path]


def _part(name: str, component: Component | None) -> dict[str, Any]:
    if component is None:
        return {"name": name}
    about = (inspect.getdoc(type(component)) or "").partition("\n")[0]
    return {"name": name, "type": type(component).__name__, "about": about}


def _quantity(name: str, quantity: Quantity, numbers: Sequence[int], declared: f.Field | None) -> dict[str, Any]:
    units = [unit for _, _, unit in quantity.entries]
    found = {"name": name, "columns": list(numbers)}
    found |= {"unit": units[0] if len(set(units)) == 1 else units} if any(units) else {}
    found |= {"shape": list(quantity.shape)} if quantity.shape else {}
    return found | ({"about": declared.description} if declared is not None else {})


def _structural(component: Component) -> list[dict[str, str]]:
    """Return the structural parameters and effects of a part, whose values are texts."""
    return [
        {"name": name, "about": declared.description, "value": _text(getattr(component, name))}
        for name, declared in component.fields.items()
        if isinstance(declared, f.Structural)
    ]


def _text(value: Any) -> str:
    if isinstance(value, np.ndarray) and value.ndim == 1 and value.size <= LISTED:
        return f"[{', '.join(f'{x:g}' for x in value)}]"
    return value if isinstance(value, str) else shown_or_kind(value)
