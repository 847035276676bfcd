"""Collect the shapes of the parts of a model."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from typing import Any

from acausal.animation.geometry import PROFILES, QUANTITIES, STYLES, Shape
from acausal.errors import AcausalError, DeclarationError, line_in
from acausal.language.component import Component


@dataclass(frozen=True, eq=False)
class PartShape:
    """A shape and the part that yields it.

    Parameters
    ----------
    path : str
        Path of the part; "" is the model.
    kind : str
        Name of the part's class.
    shape : Shape
        Geometry.
    colour : str, optional
        Colour "#rrggbb", once the shape is evaluated.
    """

    path: str
    kind: str
    shape: Any
    colour: str | None = None


def collect(component: Component) -> list[PartShape]:
    """Return the shapes of a bound model, those of each part once.

    Raises
    ------
    DeclarationError
        If shapes() fails, or yields anything but shapes and parts.
    """
    return list(collected(component, set()))


def collected(component: Component, visited: set[int]) -> Iterator[PartShape]:
    """Yield the shapes of a bound model one by one, as `collect`; `visited` are the ids of parts that are done."""
    if id(component) in visited:
        return
    visited.add(id(component))
    path, kind = component._path, type(component).__name__
    found: Any = call_user_code(component.shapes, path, kind)
    if not hasattr(found, "__iter__"):
        raise DeclarationError(f"shapes() of {component!r} returns {found!r}. Yield each shape: `yield Sphere(...)`.")
    shapes = iter(found)
    while (item := call_user_code(lambda: next(shapes, None), path, kind)) is not None:
        if isinstance(item, Component):
            yield from collected(item, visited)
        elif isinstance(item, Shape):
            _check_words(component, item)
            yield PartShape(path, kind, item)
        else:
            raise DeclarationError(
                f"shapes() of {component!r} yields {item!r}. Yield shapes of acausal.geometry, such as Sphere(...), or parts."
            )


def call_user_code(function: Callable[[], Any], path: str, kind: str) -> Any:
    """Call a function of a part's shapes(); an error in it is reported with the part and the user's line."""
    try:
        return function()
    except AcausalError:
        raise
    except Exception as error:
        where = ", ".join(filter(None, (f"{path or 'the model'} ({kind})", line_in(error))))
        raise DeclarationError(f"{where}: shapes() fails: {type(error).__name__}: {error}") from error


def _check_words(component: Component, shape: Any) -> None:
    """Raise an error for an unknown style, quantity or profile."""
    for name, known in (("style", STYLES.get(type(shape), ())), ("quantity", QUANTITIES), ("profile", PROFILES)):
        word = getattr(shape, name, None)
        if word is not None and word not in known:
            allowed = ", ".join(map(repr, known))
            raise DeclarationError(
                f"`{name}` of the {type(shape).__name__} of {component!r} is {word!r}, not one of {allowed}."
            )
