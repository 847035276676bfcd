"""The Parameters section of a component's docstring, made from its fields."""

from __future__ import annotations

import inspect
import re
import textwrap
from typing import Any

import numpy as np

from acausal.language import data
from acausal.language import fields as f
from acausal.language.quantities import is_quantity

WIDTH = 100
SECTION = re.compile(r"\n\n(?=[A-Z][\w ]*\n-{3,}$)", re.MULTILINE)
PLAIN = ("bool", "float", "int", "str")


def with_parameters(cls: Any) -> str | None:
    """Return the docstring of a component class with all that its constructor takes, inherited fields too.

    Parameters
    ----------
    cls : Component class
        Whose fields were read; without a docstring, or with a Parameters section of its own, it keeps what it has.
    """
    written = vars(cls).get("__doc__")
    given = [_entry(cls, name, field) for name, field in cls.fields.items() if _is_parameter(field)]
    if not written or not given or re.search(r"^\s*Parameters\n\s*-{3,}$", written, re.MULTILINE):
        return written
    summary, *sections = SECTION.split(inspect.cleandoc(written))
    return "\n\n".join([summary, "\n".join(["Parameters", "----------", *given]), *sections])


def first_line(cls: type) -> str:
    """Return the first line of the docstring of a class, "" where it has none."""
    return (cls.__doc__ or "").strip().partition("\n")[0]


def _is_parameter(field: f.Field) -> bool:
    return isinstance(field, f.Structural | f.Parameter) or (
        isinstance(field, f.Variable) and field.causality == "input"
    )


def _entry(cls: Any, name: str, field: f.Field) -> str:
    """Name, type, unit and default on one line, then the description."""
    parts = [_type(cls, name, field), _unit(field), _bound(field), _default(cls._class_values.get(name, field.default))]
    text = field.description[:1].upper() + field.description[1:]
    text = f"{text}{'' if text.endswith('.') else '.'} {field.doc}".strip()
    return f"{name} : {', '.join(filter(None, parts))}\n" + textwrap.indent(textwrap.fill(text, WIDTH), "    ")


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
    more = " or expression of time" if isinstance(field, f.Variable) else ""
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


def _default(value: Any) -> str:
    """Describe the default, "optional" for one that follows from other values."""
    if value is f.MISSING:
        return ""
    if is_quantity(value):
        return f"default {value}"
    if isinstance(value, np.ndarray):
        value = value.tolist() if value.any() else 0
    known = value is None or isinstance(value, bool | int | float | str | list | tuple)
    return f"default {_shown(value)}" if known else "optional"


def _shown(value: Any) -> str:
    if isinstance(value, str):
        return f'"{value}"'
    return f"{value:.10g}" if isinstance(value, float) else repr(value)
