"""What a model looks like: the shapes of its parts, with their paths."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from typing import Any

from acausal.animation.geometry import QUANTITIES, STYLES, Shape
from acausal.errors import AcausalError, DeclarationError, line_in
from acausal.language.component import Component


@dataclass(frozen=True, eq=False)
class Seen:
    """A shape and the part that looks like it.

    Parameters
    ----------
    path : str
        Of the part; "" is the model.
    kind : str
        Name of the part's class.
    shape : Shape
        Its geometry.
    """

    path: str
    kind: str
    shape: Any


def collect(component: Component) -> list[Seen]:
    """Return the shapes of a bound model; each part is asked once, however many yield it.

    Raises
    ------
    DeclarationError
        If shapes() yields anything else than shapes and parts, or fails.
    """
    return list(_collected(component, set()))


def _collected(component: Component, asked: set[int]) -> Iterator[Seen]:
    if id(component) in asked:
        return
    asked.add(id(component))
    path, kind = component._path, type(component).__name__
    found: Any = called(component.shapes, path, kind)
    if not hasattr(found, "__iter__"):
        raise DeclarationError(f"shapes() of {component!r} returns {found!r}; yield each shape: `yield Sphere(...)`.")
    shapes = iter(found)
    while (item := called(lambda: next(shapes, None), path, kind)) is not None:
        if isinstance(item, Component):
            yield from _collected(item, asked)
        elif isinstance(item, Shape):
            _check_words(component, item)
            yield Seen(path, kind, item)
        else:
            raise DeclarationError(
                f"shapes() of {component!r} yields {item!r}; it yields kinds of acausal.geometry, such as Sphere(...), and parts."
            )


def called(function: Callable[[], Any], path: str, kind: str) -> Any:
    """Call a function of the user's that says what a part looks like; an error of it names the part and the line."""
    try:
        return function()
    except AcausalError:
        raise
    except Exception as error:
        where = ", ".join(filter(None, (f"{path or 'the model'} ({kind})", line_in(error))))
        raise DeclarationError(f"{where}: shapes() fails: {type(error).__name__}: {error}") from error


def _check_words(component: Component, shape: Any) -> None:
    """Refuse a style or quantity that there is not."""
    for name, known in (("style", STYLES), ("quantity", QUANTITIES)):
        word = getattr(shape, name, known[0])
        if word not in known:
            there = ", ".join(map(repr, known))
            raise DeclarationError(
                f"`{name}` of the {type(shape).__name__} of {component!r} is {word!r}, not one of {there}."
            )
