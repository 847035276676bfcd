"""Checks of the values given to fields, by the constructor or in a class body."""

from __future__ import annotations

import difflib
import sys
from collections.abc import Iterable
from typing import Any

from acausal.errors import PACKAGE, DeclarationError
from acausal.language import fields as f


def check_value(cls: Any, name: str, value: Any) -> Any:
    """Return the value for a field of a class, with parts in place of their classes.

    Raises
    ------
    DeclarationError
        If the class has no such field, or the value cannot be of this field.
    """
    field = cls.fields.get(name)
    where = f"{cls.__name__}.{name}"
    if field is None:
        raise DeclarationError(f"{cls.__name__} has no field `{name}`; {nearest_field(cls, name)}")
    if isinstance(field, f.Part):
        return _check_part(where, value, field)
    if isinstance(field, f.Outer):
        raise DeclarationError(
            f"{where} is found automatically: {field.description}. Leave it out, and put one {field.cls.__name__} in the model."
        )
    if isinstance(field, f.Observed):
        raise DeclarationError(f"{where} is computed from results and takes no value.")
    if isinstance(field, f.Variable) and field.causality != "input" and not isinstance(value, f.InitialValue):
        raise DeclarationError(
            f"{where} is a variable: write {name}=fixed({value!r}) for a value at the start, "
            f"or {name}=guess({value!r}) for a guess."
        )
    if isinstance(value, f.InitialValue) and not isinstance(field, f.Variable):
        raise DeclarationError(f"{where} is not a variable: it takes a value, not fixed(...) or guess(...).")
    return value


def nearest_field(cls: Any, name: str) -> str:
    """Return the remedy for a name that is not a field."""
    near = difflib.get_close_matches(name, cls.fields, 1) or _described(cls, name)
    return f"did you mean `{near[0]}`?" if near else f"its fields are {', '.join(cls.fields)}."


def is_part_class(value: Any) -> bool:
    """Whether a value is a component class, which stands for an instance made with no arguments."""
    return isinstance(value, type) and issubclass(value, f.Template)


def instance(item: Any) -> Any:
    """Return the part that a component or a component class stands for."""
    if not is_part_class(item):
        return item
    made = item()
    made.__dict__["_origin"] = user_line()
    return made


def instances(items: Iterable[Any], where: str) -> list[Any]:
    """Return the parts that a list of components and component classes stands for."""
    made = [instance(item) for item in items]
    for k, item in enumerate(made):
        if not isinstance(item, f.Template):
            raise DeclarationError(
                f"{where}[{k}] is {item!r}; a list of parts contains only components, not lists of them. "
                "Leave out what does not exist."
            )
    return made


def holds_parts(value: Any) -> bool:
    """Whether a value is a component, or holds one at any depth."""
    if isinstance(value, f.Template) or is_part_class(value):
        return isinstance(value, f.Template)
    if isinstance(value, dict):
        return holds_parts(list(value.values()))
    return isinstance(value, list | tuple | set | frozenset) and any(is_part_class(v) or holds_parts(v) for v in value)


def user_line() -> str:
    """Return file and line of the innermost frame outside this package."""
    frame: Any = sys._getframe(1)
    while frame.f_back is not None and frame.f_code.co_filename.startswith(PACKAGE):
        frame = frame.f_back
    return f"{frame.f_code.co_filename}:{frame.f_lineno}"


def _check_part(where: str, value: Any, field: f.Part) -> Any:
    if isinstance(value, list | tuple):
        return instances(value, where)
    value = instance(value)
    if isinstance(value, f.Template) and field.many:
        raise DeclarationError(f"{where} is a list of parts; give a list: {field.name}=[{value!r}].")
    if value is None or isinstance(value, f.Template):
        return value
    mend = f"give a list: {field.name}=[...]" if isinstance(value, dict | set) else "give a component"
    raise DeclarationError(f"{where} is a part; {mend}, not {value!r}.")


def _described(cls: Any, word: str) -> list[str]:
    """Fields whose description contains the word: `mass` for `m`."""
    values = {name: field for name, field in cls.fields.items() if not isinstance(field, f.Part | f.Outer)}
    return [name for name, field in values.items() if word in field.description.lower().split()]
