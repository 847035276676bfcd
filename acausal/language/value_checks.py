"""Checks of the values of fields, from the constructor or a class body."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from typing import Any

import numpy as np

from acausal.errors import DeclarationError, user_line
from acausal.language import fields as f
from acausal.language.call_arguments import declaration_error
from acausal.language.formatting import in_code
from acausal.nearest import most_similar


def check_value(cls: Any, name: str, value: Any) -> Any:
    """Return the checked value for a field of a class; classes of parts are instantiated.

    Raises
    ------
    DeclarationError
        If the class has no such field, or the value is invalid for it.
    """
    field = cls.fields.get(name)
    where = f"{cls.__name__}.{name}"
    if field is None:
        raise DeclarationError(f"{cls.__name__} has no field `{name}`; {nearest_field(cls, name)}")
    if isinstance(field, f.Part):
        return _check_part(where, value, field)
    if isinstance(field, f.Outer):
        raise DeclarationError(
            f"{where} is found automatically: {field.description}. Remove it, and add one {field.cls.__name__} to the "
            "model."
        )
    if isinstance(field, f.Observed):
        raise DeclarationError(f"{where} is computed from results and takes no value.")
    if isinstance(field, f.Variable) and isinstance(value, list | tuple):
        _refuse_initial_entries(where, value, name)
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
    near = most_similar(name, cls.fields) or next(iter(_described(cls, name)), "")
    return f"did you mean `{near}`?" if near else f"its fields are {', '.join(cls.fields)}."


def positional_message(cls: Any, unnamed: Sequence[Any], values: Mapping[str, Any]) -> str:
    """Return the message for positional arguments of a constructor."""
    if len(unnamed) == 1 and isinstance(unnamed[0], dict):
        return f"{cls.__name__} takes its values by name; unpack a dict by two stars: {cls.__name__}(**values)."
    kinds = (f.Part,) if any(isinstance(value, f.Template) for value in unnamed) else (f.Parameter, f.Structural)
    if any(isinstance(value, f.InitialValue) for value in unnamed):
        kinds = (f.Variable,)
    names = [n for kind in kinds for n, field in cls.fields.items() if isinstance(field, kind) and n not in values]
    if not names:
        return f"{cls.__name__} takes its values by name, and has none of this kind; {nearest_field(cls, '')}"
    written = ", ".join(f"{name}={shown(value)}" for name, value in zip(names, unnamed, strict=False))
    return f"{cls.__name__} takes its values by name, for instance {cls.__name__}({written})."


def class_keyword_message(cls: Any, name: str, value: Any) -> str:
    """Return the message for a keyword argument of a class statement."""
    known = isinstance(value, f.Template) or name in getattr(cls, "fields", {}) or name in cls._settings
    line = f"{name} = {shown(value)}" if known else f'{name}: Scalar = parameter("...", default={shown(value)})'
    bases = ", ".join(base.__name__ for base in cls.__bases__)
    return f"class {cls.__name__}({bases}, {name}=...): write values in the class body, on their own line, `{line}`."


def refuse_decorator(cls: Any) -> None:
    """Raise DeclarationError for a class with @dataclass or a similar decorator."""
    if hasattr(cls, "__dataclass_fields__") or hasattr(cls, "__attrs_attrs__"):
        raise declaration_error(
            f"{cls.__name__} is decorated with @dataclass, which replaces its constructor. Remove the decorator: "
            'fields of components are declared as `k: Scalar = parameter("...", default=1)`.'
        )


def refuse_constructor(cls: Any) -> None:
    """Raise DeclarationError for a class whose constructor does not call super().__init__()."""
    own = next((vars(base)["__init__"] for base in cls.__mro__ if "__init__" in vars(base)), None)
    code = getattr(own, "__code__", None)
    line = f"{code.co_filename}:{code.co_firstlineno}" if code else ""
    raise declaration_error(
        f"the constructor of {cls.__name__} does not call super().__init__(), so its arguments would be lost. Add "
        "`super().__init__(**values)` to it, or remove it: fields need no constructor.",
        line,
    )


def is_part_class(value: Any) -> bool:
    """Return whether a value is a component class, which stands for an instance without arguments."""
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
                "Leave out missing parts."
            )
    return made


def holds_parts(value: Any) -> bool:
    """Return whether a value is a component, or contains one at any depth."""
    if isinstance(value, f.Template) or is_part_class(value):
        return isinstance(value, f.Template)
    if isinstance(value, dict):
        return holds_parts(list(value.values()))
    return isinstance(value, list | tuple | set | frozenset) and any(is_part_class(v) or holds_parts(v) for v in value)


def _refuse_initial_entries(where: str, entries: Sequence[Any], name: str) -> None:
    """Raise DeclarationError for a list with entries fixed(...) or guess(...)."""
    first = next((entry for entry in entries if isinstance(entry, f.InitialValue)), None)
    if first is not None:
        word = "fixed" if first.fixed else "guess"
        inside = tuple(entry.value if isinstance(entry, f.InitialValue) else entry for entry in entries)
        whole = repr(inside if len(inside) > 1 else first.value)
        raise DeclarationError(f"{where}: put {word}(...) around the whole value: {name}={word}({whole}).")


def _check_part(where: str, value: Any, field: f.Part) -> Any:
    if isinstance(field, f.Family):
        raise DeclarationError(
            f"{where} creates ports from structural values; connect these by name. It takes no value, not "
            f"{shown(value)}."
        )
    if isinstance(value, list | tuple):
        return instances(value, where)
    value = instance(value)
    if isinstance(value, f.Template) and field.many:
        raise DeclarationError(f"{where} is a list of parts; give a list: {field.name}=[{value!r}].")
    if value is None or isinstance(value, f.Template):
        return value
    what, remedy = "a part", f"give a list: {field.name}=[...]" if isinstance(value, dict | set) else "give a component"
    if field.is_port:
        what, remedy = "a port", "it is connected, connect(...) or chain(...), and takes no value"
    raise DeclarationError(f"{where} is {what}; {remedy}, not {shown(value)}.")


def _described(cls: Any, word: str) -> list[str]:
    """Return the fields whose description contains a word: `m` for `mass`."""
    values = {name: field for name, field in cls.fields.items() if not isinstance(field, f.Part | f.Outer)}
    return [name for name, field in values.items() if word in field.description.lower().split()]


def shown(value: Any, otherwise: str = "...") -> str:
    """Return a value as Python code, `otherwise` if the code is long."""
    if isinstance(value, f.InitialValue):
        return f"{'fixed' if value.fixed else 'guess'}({shown(value.value)})"
    if isinstance(value, f.Template):
        given = vars(value).get("_values", {}).items()
        text = f"{type(value).__name__}({', '.join(f'{name}={shown(v)}' for name, v in given)})"
    else:
        text = repr(value)
    return in_code(text, otherwise)


def shown_or_kind(value: Any) -> str:
    """Return a value as Python code, its kind if the code is long."""
    kind = f"an array of shape {value.shape}" if isinstance(value, np.ndarray) else f"a {type(value).__name__}"
    return shown(value, kind)
