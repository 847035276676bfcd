"""Traversal of the tree of bound components, and their paths."""

from __future__ import annotations

from collections.abc import Iterator

from acausal.language import fields as f
from acausal.language.component import Component


def join(path: str, name: str) -> str:
    """Return the path of a member."""
    return f"{path}.{name}" if path else name


def members(component: Component) -> Iterator[Component]:
    """Yield the parts and ports of a bound component."""
    for name, declared in component.fields.items():
        if isinstance(declared, f.Part):
            value = getattr(component, name)
            yield from (item for item in (value if isinstance(value, list) else [value]) if item is not None)


def walk(component: Component) -> Iterator[Component]:
    """Yield a bound component and, recursively, its parts and ports."""
    yield component
    for member in members(component):
        yield from walk(member)
