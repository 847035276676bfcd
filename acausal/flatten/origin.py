"""Where something in a model comes from, and errors that say so."""

from __future__ import annotations

import inspect
import itertools
import traceback
from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass, replace
from typing import Any

from acausal.errors import AcausalError, DeclarationError, line_in
from acausal.flatten.raw_errors import in_words
from acausal.language.component import Component, Connector
from acausal.language.expression import Expr
from acausal.language.statement_kinds import returned

MOST = 100_000  # statements of one generator; more are an endless loop


@dataclass(frozen=True)
class Origin:
    """Where an equation comes from: path and class of the component, file and line, and what it says."""

    path: str
    kind: str
    where: str
    text: str = ""

    @classmethod
    def of(cls, component: Component, text: str = "") -> Origin:
        """Where a component is constructed."""
        return cls(component._path, type(component).__name__, component._origin, text)

    def at(self, where: str) -> Origin:
        """The same in another line."""
        return Origin(self.path, self.kind, where, self.text)

    @property
    def owner(self) -> str:
        """Path, class and line in the middle of a sentence."""
        inside = ", ".join(filter(None, [self.kind, self.where]))
        return f"{self.path} ({inside})" if self.path else self.kind + f" ({self.where})" * bool(self.where)

    def __str__(self) -> str:
        name = f"{self.path} ({self.kind})" if self.path else self.kind
        return f"{', '.join(filter(None, [name, self.where]))}{': ' + self.text if self.text else ''}"


def value_origin(component: Component, name: str, by_path: bool = False, text: str = "") -> Origin:
    """Where the value of a field is written: in the call of the constructor, or in the class.

    Parameters
    ----------
    component : Component
        What has the field, bound.
    name : str
        The field.
    by_path : bool
        True for a value by path, `parameters={"beam.E": ...}`: no line of the model holds it.
    text : str
        What it is; the name of the field if not given.
    """
    where = component._origin
    if by_path:
        where = where if component._path else ""
    elif name not in component._values:
        said = (base for base in type(component).__mro__ if name in vars(base).get("_own_values", ()))
        given = next(said, None) if name in component._class_values else None
        where = given._line if given else component.fields[name].where
    return Origin(component._path, type(component).__name__, where, text or name)


def method_origin(component: Component, name: str) -> Origin:
    """Where a method of a component is written."""
    code = getattr(inspect.unwrap(getattr(type(component), name)), "__code__", None)
    where = f"{code.co_filename}:{code.co_firstlineno}" if code else component._origin
    return Origin(component._path, type(component).__name__, where)


def line_of(generator: Any) -> str:
    """Return file and line of the current line of a generator, or of the one that it yields from; "" if unknown."""
    while (inner := getattr(generator, "gi_yieldfrom", None)) is not None and hasattr(inner, "gi_frame"):
        generator = inner
    frame = getattr(generator, "gi_frame", None)
    return f"{frame.f_code.co_filename}:{frame.f_lineno}" if frame else ""


def with_place(call: Callable[[], Any], origin: Origin) -> Any:
    """Call a function of the user's model; name component and line in every error."""
    try:
        return call()
    except AcausalError as error:
        if not error.place:
            error.place = str(replace(origin, where=error.line, text="") if error.line else _place(error, origin))
        raise
    except RecursionError as error:
        raise DeclarationError(f"{_place(error, origin)}: infinite recursion.") from None
    except Exception as error:
        raise DeclarationError(f"{_place(error, origin)}: {in_words(error)}") from error


def refuse_endless(count: int, origin: Origin, what: str, most: int = MOST) -> None:
    """Raise DeclarationError if a generator has yielded more than any component needs."""
    if count >= most:
        raise DeclarationError(
            f"{origin}: {what} has {most:,} entries and continues: a loop such as `while True` does not end. "
            "Iterate over a range or a list of parts."
        )


def stated(component: Component, method: str, most: int = MOST) -> Iterator[tuple[Any, Origin]]:
    """Yield what a method of a component states, each with its place."""
    if getattr(type(component), method) in (getattr(base, method, None) for base in (Component, Connector)):
        return
    here = method_origin(component, method)
    said = with_place(getattr(component, method), here)
    if not isinstance(said, Iterable) or isinstance(said, Expr):
        raise DeclarationError(f"{here}: {returned(said, method)}")
    yield from entries(said, here, method, most)


def entries(
    said: Iterable[Any], here: Origin, method: str, most: int = MOST, nested: tuple[type, ...] = ()
) -> Iterator[tuple[Any, Origin]]:
    """Yield entries, each with its place, which is `here` if it has no line; more than `most` are refused.

    Entries of the types `nested` are gone through in their turn.
    """
    stack = [iter(said)]
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
    """Locate the innermost line outside this package; what a class lacks, at the class."""
    if isinstance(error, NotImplementedError) and len(error.args) != 1:
        *_, (frame, _) = traceback.walk_tb(error.__traceback__)
        return replace(origin, where=getattr(frame.f_locals.get("self"), "_line", origin.where))
    where = line_in(error)
    return Origin(origin.path, origin.kind, where) if where else origin
