"""Directions of the parts of a loop that differ: the likely reason why it does not close, or lets nothing move."""

from __future__ import annotations

from collections.abc import Iterable

import numpy as np

from acausal.compiler import CompiledModel
from acausal.flatten.tree import join, walk
from acausal.language.fields import Structural

DIGITS = 12  # of directions that count as equal


def differing(compiled: CompiledModel, parts: Iterable[str]) -> str:
    """List structural directions of some parts, where those of one name are not all parallel; "" where they are.

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
            # What few parts have is the likely slip.
            rows = sorted(own.items(), key=lambda pair: len(pair[1]))
            texts += [
                f"{', '.join(f'`{p}`' for p in paths)} along ({', '.join(f'{e:.6g}' for e in unit)})"
                for unit, paths in rows
            ]
    return f"Directions in the loop, each in the axes of its part: {'; '.join(texts)}." if texts else ""
