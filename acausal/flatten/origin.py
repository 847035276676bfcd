"""Origins of statements, and errors with their place."""

from __future__ import annotations

import inspect
import itertools
import traceback
from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass, replace
from typing import Any

from acausal.errors import AcausalError, DeclarationError, line_in
from acausal.flatten.raw_errors import python_error_message
from acausal.language.component import Component, Connector
from acausal.language.expression import Expr
from acausal.language.statement_kinds import returned_message

MOST = 100_000  # statements of one generator: more mean an endless loop


@dataclass(frozen=True)
class Origin:
    """Origin of an equation: path and class of the component, file and line, and a text."""

    path: str
    kind: str
    where: str
    text: str = ""

    @classmethod
    def of(cls, component: Component, text: str = "") -> Origin:
        """Return the origin of a component: the line of its construction."""
        return cls(component._path, type(component).__name__, component._origin, text)

    def at(self, where: str) -> Origin:
        """Return the origin with another line."""
        return Origin(self.path, self.kind, where, self.text)

    @property
    def owner(self) -> str:
        """Path, class and line, for use within a sentence."""
        inside = ", ".join(filter(None, [self.kind, self.where]))
        return f"{self.path} ({inside})" if self.path else self.kind + f" ({self.where})" * bool(self.where)

    def __str__(self) -> str:
        name = f"{self.path} ({self.kind})" if self.path else self.kind
        return f"{', '.join(filter(None, [name, self.where]))}{': ' + self.text if self.text else ''}"


def value_origin(component: Component, name: str, by_path: bool = False, text: str = "") -> Origin:
    """Return the origin of the value of a field: the call of the constructor, or the class.

    Parameters
    ----------
    component : Component
        Bound component.
    name : str
        Name of the field.
    by_path : bool
        True for a value by path, `parameters={"beam.E": ...}`, which is on no line of the model.
    text : str
        Text of the origin; default: the name of the field.
    """
    where = component._origin
    if by_path:
        where = where if component._path else ""
    elif name not in component._values:
        bases = (base for base in type(component).__mro__ if name in vars(base).get("_own_values", ()))
        base = next(bases, None) if name in component._class_values else None
        where = base._line if base else component.fields[name].where
    return Origin(component._path, type(component).__name__, where, text or name)


def method_origin(component: Component, name: str) -> Origin:
    """Return the origin of a method of a component."""
    code = getattr(inspect.unwrap(getattr(type(component), name)), "__code__", None)
    where = f"{code.co_filename}:{code.co_firstlineno}" if code else component._origin
    return Origin(component._path, type(component).__name__, where)


def line_of(generator: Any) -> str:
    """Return the current file and line of a generator, or of the generator that it yields from; "" if unknown."""
    while (inner := getattr(generator, "gi_yieldfrom", None)) is not None and hasattr(inner, "gi_frame"):
        generator = inner
    frame = getattr(generator, "gi_frame", None)
    return f"{frame.f_code.co_filename}:{frame.f_lineno}" if frame else ""


def with_place(call: Callable[[], Any], origin: Origin) -> Any:
    """Call a function of the user's model; add component and line to errors."""
    try:
        return call()
    except AcausalError as error:
        if not error.place:
            error.place = str(replace(origin, where=error.line, text="") if error.line else _place(error, origin))
        raise
    except RecursionError as error:
        raise DeclarationError(f"{_place(error, origin)}: infinite recursion.") from None
    except Exception as error:
        raise DeclarationError(f"{_place(error, origin)}: {python_error_message(error)}") from error


def refuse_endless(count: int, origin: Origin, what: str, most: int = MOST) -> None:
    """Raise DeclarationError if a generator has yielded more entries than any component needs."""
    if count >= most:
        raise DeclarationError(
            f"{origin}: {what} has {most:,} entries and continues: a loop such as `while True` does not end. "
            "Iterate over a range or a list of parts."
        )


def located_statements(component: Component, method: str, most: int = MOST) -> Iterator[tuple[Any, Origin]]:
    """Yield the statements of a method of a component, each with its origin."""
    if getattr(type(component), method) in (getattr(base, method, None) for base in (Component, Connector)):
        return
    here = method_origin(component, method)
    found = with_place(getattr(component, method), here)
    if not isinstance(found, Iterable) or isinstance(found, Expr):
        raise DeclarationError(f"{here}: {returned_message(found, method)}")
    yield from entries(found, here, method, most)


def entries(
    statements: Iterable[Any], here: Origin, method: str, most: int = MOST, nested: tuple[type, ...] = ()
) -> Iterator[tuple[Any, Origin]]:
    """Yield statements, each with its origin, by default `here`; raise DeclarationError for more than `most`.

    Entries of the types `nested` are iterated in turn.
    """
    stack = [iter(statements)]
    for count in itertools.count():
        item = with_place(lambda: next(stack[-1], _END), here)
        origin = here.at(line_of(stack[0]) or here.where)
        refuse_endless(count, origin, f"{method}()", most)
        if item is _END:
            stack.pop()
            if not stack:
                return
        elif isinstance(item, nested):
            stack.append(iter(item))
        else:
            yield item, origin


_END: Any = object()


def _place(error: BaseException, origin: Origin) -> Origin:
    """Return the origin with the innermost line outside this package; the line of the class for a missing method."""
    if isinstance(error, NotImplementedError) and len(error.args) != 1:
        *_, (frame, _) = traceback.walk_tb(error.__traceback__)
        return replace(origin, where=getattr(frame.f_locals.get("self"), "_line", origin.where))
    where = line_in(error)
    return Origin(origin.path, origin.kind, where) if where else origin
