"""Directions in a loop that are not parallel: the likely reason why it does not close, or is locked."""

from __future__ import annotations

from collections.abc import Iterable

import numpy as np

from acausal.compiler import CompiledModel
from acausal.flatten.component_tree import join, walk
from acausal.language.fields import Structural

DIGITS = 12  # decimals of a unit vector to which parallel directions agree: those of input, not round-off


def nonparallel_directions(compiled: CompiledModel, parts: Iterable[str]) -> str:
    """Return the text that lists structural directions of a loop; "" if all of one name are parallel.

    Parameters
    ----------
    compiled : CompiledModel
        The model.
    parts : iterable of str
        Paths of the parts in a loop.
    """
    inside, found = set(parts), dict[str, dict[tuple[float, ...], list[str]]]()
    for component in walk(compiled.tree):
        for name, field in component.fields.items() if component._path in inside else ():
            if isinstance(field, Structural) and field.shape == (3,) and field.choices is None:
                value = np.asarray(getattr(component, name), dtype=float)
                if length := float(np.linalg.norm(value)):
                    unit = value / length
                    unit = np.round(unit * np.sign(unit[np.argmax(np.abs(unit))]), DIGITS) + 0.0
                    found.setdefault(name, {}).setdefault(tuple(unit.tolist()), []).append(join(component._path, name))
    texts = []
    for own in found.values():
        if len(own) > 1:
            # The direction of the fewest parts is the likely mistake.
            rows = sorted(own.items(), key=lambda pair: len(pair[1]))
            texts += [
                f"{', '.join(f'`{p}`' for p in paths)} along ({', '.join(f'{e:.6g}' for e in unit)})"
                for unit, paths in rows
            ]
    return f"Directions in the loop, each in the axes of its part: {'; '.join(texts)}." if texts else ""
