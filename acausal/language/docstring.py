"""Docstring and signature of a component class, generated from its fields."""

from __future__ import annotations

import inspect
import re
import textwrap
from collections.abc import Iterable
from typing import Any

import numpy as np

from acausal.language import data
from acausal.language import fields as f
from acausal.language.quantities import is_quantity

WIDTH = 100
SECTION = re.compile(r"\n\n(?=[A-Z][\w ]*\n-{3,}$)", re.MULTILINE)
WORD = re.compile(r"^(a|[a-z]{2,})(?=[ ,-]|\.?$)")  # a first word to capitalise, not a symbol such as der(phi)
PLAIN = {"bool": bool, "float": float, "int": int, "str": str}
COMPUTED: Any = type("Computed", (), {"__repr__": lambda self: "..."})()  # stands for a computed default


def with_fields(cls: Any, written: str) -> str:
    """Return the docstring of a component class with sections for parameters, ports and variables.

    Parameters
    ----------
    cls : Component class
        Class whose fields were read.
    written : str
        Docstring of the class, unchanged if it has a Parameters section.
    """
    fields = cls.fields.items()
    made = [
        *_section("Parameters", (_entry(n, d, [_kind(cls, n, d), _default(cls, n, d)]) for n, d in _parameters(cls))),
        *_section("Ports", (_entry(n, d, [d.connector]) for n, d in fields if d.connector)),
        *_section(
            "Variables", [*_starts(cls), *(_entry(n, d, [_kind(cls, n, d)]) for n, d in fields if _is_variable(d))]
        ),
    ]
    if not made or re.search(r"^\s*Parameters\n\s*-{3,}$", written, re.MULTILINE):
        return written
    summary, *sections = SECTION.split(inspect.cleandoc(written))
    return "\n\n".join([summary, *made, *sections])


def signature(cls: Any) -> inspect.Signature:
    """Return the signature of the constructor: keyword-only arguments, variables with their start values."""
    started = [(n, d) for n, d in cls.fields.items() if isinstance(d, f.Variable) and not _is_parameter(d)]
    return inspect.Signature([_argument(cls, n, d) for n, d in [*_parameters(cls), *started]])


def first_line(cls: type) -> str:
    """Return the first line of the docstring of a class, "" where it has none."""
    return (cls.__doc__ or "").strip().partition("\n")[0]


def _parameters(cls: Any) -> list[tuple[str, f.Field]]:
    """Return the fields that are arguments of the constructor, without variables; those without default first."""
    given = [(n, d) for n, d in cls.fields.items() if _is_parameter(d)]
    return sorted(given, key=lambda item: _value(cls, *item) is not inspect.Parameter.empty)


def _is_parameter(field: f.Field) -> bool:
    return isinstance(field, f.Structural | f.Parameter) or (
        isinstance(field, f.Variable) and field.causality == "input"
    )


def _is_variable(field: f.Field) -> bool:
    return isinstance(field, f.Variable | f.Observed) and not _is_parameter(field)


def _argument(cls: Any, name: str, field: f.Field) -> inspect.Parameter:
    """Return a field as an argument of the constructor."""
    text: Any = _kind(cls, name, field)
    kind = PLAIN.get(text, text) if _is_parameter(field) else f"{text}; fixed() or guess()"
    return inspect.Parameter(name, inspect.Parameter.KEYWORD_ONLY, default=_value(cls, name, field), annotation=kind)


def _value(cls: Any, name: str, field: f.Field) -> Any:
    """Return the default of a field in the signature, `...` for a computed one."""
    value = cls._class_values.get(name, field.default)
    if isinstance(field, f.Variable) and not _is_parameter(field):
        start = value if isinstance(value, f.InitialValue) else f.InitialValue(field.start, field.fixed)
        return f.InitialValue(_plain(start.value), start.fixed) if _is_known(start.value) else COMPUTED
    if value is f.MISSING:
        return COMPUTED if isinstance(field, f.Variable) else inspect.Parameter.empty
    return _plain(value) if _is_known(value) else COMPUTED


def _section(title: str, entries: Iterable[str]) -> list[str]:
    """Return a section of a docstring; [] without entries."""
    lines = [*entries]
    return ["\n".join([title, "-" * len(title), *lines])] if lines else []


def _starts(cls: Any) -> list[str]:
    """Return a line on the start values of variables; [] if there are only outputs."""
    names = [n for n, d in cls.fields.items() if isinstance(d, f.Variable) and not (d.causality or d.flow)]
    return [f"Start values: {n}=fixed(...) holds, {n}=guess(...) is a first guess.\n" for n in names[:1]]


def _entry(name: str, field: f.Field, kind: Iterable[str]) -> str:
    """Return name, type, unit and default on one line, then the description."""
    text = WORD.sub(lambda word: word[0].capitalize(), field.description)
    text = f"{text}{'' if text.endswith('.') else '.'} {field.doc}".strip()
    head = f"{name} : {', '.join(filter(None, kind))}"
    return head if text == "." else f"{head}\n" + textwrap.indent(textwrap.fill(text, WIDTH), "    ")


def _kind(cls: Any, name: str, field: f.Field) -> str:
    """Return type, unit and bounds of a field."""
    if isinstance(field, f.Observed):
        return "computed where it is read"
    causality = field.causality if isinstance(field, f.Variable) and not _is_parameter(field) else ""
    return ", ".join(filter(None, (_type(cls, name, field), causality, _unit(field), _bound(field))))


def _type(cls: Any, name: str, field: f.Field) -> str:
    choices, kind = (field.choices, field.cls) if isinstance(field, f.Structural) else (None, None)
    if choices and set(choices) != {True, False}:
        *most, last = (_shown(choice) for choice in choices)
        text = f"{', '.join(most)} or {last}" if most else last
        return f"array of {text}, shape {field.shape}" if isinstance(field.shape, tuple) else text
    annotation = next((a[name] for base in cls.__mro__ if name in (a := inspect.get_annotations(base))), "")
    plain = annotation if isinstance(annotation, str) else getattr(annotation, "__name__", "")
    if choices or plain in PLAIN:
        return "bool" if choices else plain
    if kind is not None:
        return kind.__name__ + " or str" * data.loads(kind)
    more = " or expression of time" * (isinstance(field, f.Variable) and _is_parameter(field))
    if field.shape is None:
        return "object"
    shape = f", shape {field.shape}" if field.shape and not callable(field.shape) else ""
    return f"{'array' if field.shape else 'float'}{more}{shape}"


def _unit(field: f.Field) -> str:
    if isinstance(field.unit, str):
        return "" if field.unit == "1" else f"in {field.unit}"
    return f"in ({', '.join(field.unit)})" if isinstance(field.unit, list | tuple) else ""


def _bound(field: f.Field) -> str:
    if getattr(field, "positive", False):
        return "positive"
    least, most = getattr(field, "minimum", None), getattr(field, "maximum", None)
    bounds = [word for word, end in (("at least", least), ("at most", most)) if isinstance(end, int | float)]
    ends = [end for end in (least, most) if isinstance(end, int | float)]
    return ", ".join(f"{word} {end:g}" for word, end in zip(bounds, ends, strict=True))


def _default(cls: Any, name: str, field: f.Field) -> str:
    """Return the text for the default, "optional" for a computed one."""
    value = cls._class_values.get(name, field.default)
    if value is f.MISSING:
        return ""
    if is_quantity(value):
        return f"default {value}"
    return f"default {_shown(_plain(value))}" if _is_known(value) else "optional"


def _is_known(value: Any) -> bool:
    """Return whether a value is known without an instance."""
    if isinstance(value, list | tuple):
        return all(map(_is_known, value))
    return value is None or isinstance(value, bool | int | float | str | np.ndarray) or is_quantity(value)


def _plain(value: Any) -> Any:
    """Return an array as a list, a zero array as 0."""
    return (value.tolist() if value.any() else 0) if isinstance(value, np.ndarray) else value


def _shown(value: Any) -> str:
    if isinstance(value, str):
        return f'"{value}"'
    if value is callable:
        return "function"
    return f"{value:.10g}" if isinstance(value, float) else repr(value)
