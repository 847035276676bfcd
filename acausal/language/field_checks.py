"""Checks of field declarations when a class is created."""

from __future__ import annotations

import inspect
from collections.abc import Sequence
from typing import Any

import numpy as np

from acausal.errors import AcausalError
from acausal.language import data
from acausal.language import fields as f
from acausal.language.call_arguments import declaration_error
from acausal.language.invalid_operands import decimal_point
from acausal.language.types import shape_of_annotation, wrong_type
from acausal.language.value_checks import shown
from acausal.units import parse

NUMBERS = (int, float, np.number, np.ndarray)


def check_field(cls: Any, name: str, field: f.Field) -> None:
    """Raise DeclarationError, with the line of the field, for invalid arguments of a declaration.

    Parameters
    ----------
    cls : Component class
        The class.
    name : str
        Name of the field.
    field : Field
        The declared field.
    """
    try:
        wrong = _wrong(cls, name, field)
    except AcausalError as error:
        wrong = str(error)
    if wrong:
        raise declaration_error(f"{cls.__name__}.{name}: {wrong}", field.where)


def _wrong(cls: Any, name: str, field: f.Field) -> str:
    """Return the message for an invalid field, "" for a valid one."""
    if not isinstance(field.description, str):
        return f'the first argument must be a description, "...", not {shown(field.description)}.'
    if isinstance(field, f.Part):
        return _wrong_part(field)
    if isinstance(field, f.Observed):
        if not (callable(field.compute) and _takes_self(field.compute)):
            return f"@observed decorates a method, `def {name}(self): return ...`."
        yields = inspect.isgeneratorfunction(field.compute)
        return "an observed quantity is one expression: write `return`, not `yield`." if yields else ""
    wrong = _wrong_shape(cls, name, field) or _wrong_unit(field)
    if not wrong and isinstance(field, f.Parameter | f.Variable):
        wrong = wrong_type(cls, name, field.shape, _declared_by(field))
    if wrong or isinstance(field, f.Outer):
        return wrong
    if isinstance(field, f.Variable):
        return _wrong_variable(cls, field)
    return _wrong_value(field)


def _wrong_unit(field: f.Field) -> str:
    unit = field.unit
    if unit is None or callable(unit):
        return ""
    if isinstance(unit, str):
        unit = [unit]
    elif not isinstance(unit, Sequence) or not all(isinstance(u, str) for u in unit):
        return f'unit={shown(unit)} is not a unit: write unit="m/s", one for each entry, unit=("m", "rad"), or none.'
    for entry in unit:
        parse(entry)
        if entry != entry.strip():
            return f'unit="{entry}" has a blank at its end: write "{entry.strip()}".'
    if isinstance(field.unit, str):
        return ""
    size = field.shape[0] if isinstance(field.shape, tuple) and field.shape else None
    if isinstance(field.shape, tuple) and len(unit) != size:
        what = f"{size} rows" if size else "one value"
        return f"it has {len(unit)} unit{'s' * (len(unit) != 1)} for {what}: give one unit, or one for each row."
    return ""


def _wrong_shape(cls: Any, name: str, field: f.Field) -> str:
    shape = field.shape
    if shape is None or inspect.isfunction(shape):
        return ""
    if isinstance(shape, int):
        return f"a shape is a tuple: shape=({shape},)."
    if isinstance(shape, tuple) and any(isinstance(n, f.Deferrable) for n in shape):
        return "the shape depends on another field: write a function, shape=lambda s: (s.n,)."
    whole = isinstance(shape, tuple) and all(isinstance(n, int) and not isinstance(n, bool) and n >= 0 for n in shape)
    if not whole or not isinstance(shape, tuple) or len(shape) > 2:
        return f"shape={shown(shape)} is not a shape: a vector has shape=(3,), a matrix shape=(3, 3)."
    annotated = shape_of_annotation(cls, name)
    if annotated is not None and annotated != shape:
        return f"its type has shape {annotated}, its argument is shape={shape}: remove one of the two, `{name} = ...`."
    return ""


def _wrong_variable(cls: Any, field: f.Variable) -> str:
    if isinstance(field.start, f.InitialValue):
        start = f"start={shown(field.start.value)}"
        held = ", fixed=True" if field.start.fixed else ""
        return f"write {start}{held}; fixed(...) and guess(...) are for a part: {cls.__name__}(...)."
    if not isinstance(field.fixed, bool):
        return f"fixed is True or False; the value is the start: start={shown(field.fixed)}, fixed=True."
    if field.select not in (f.NEVER, f.AVOID, f.DEFAULT, f.PREFER, f.ALWAYS):
        return f"select={shown(field.select)} is not one of NEVER, AVOID, DEFAULT, PREFER and ALWAYS of acausal."
    for word, value in (("start", field.start), ("nominal", field.nominal)):
        if isinstance(value, str | bool | dict | set | f.Template) or (value is None and word == "start"):
            return f"{word}={shown(value)} must be a number, or an array of its shape."
    if inspect.isfunction(field.start):
        return "start is a value, or an expression of parameters of the class, such as start=2 * r; not a function."
    if isinstance(field.nominal, NUMBERS) and not np.all(np.asarray(field.nominal) > 0):
        return f"nominal={shown(field.nominal)} must be positive: it is the typical size."
    if field.flow and not cls._is_port and not _is_record(cls):
        return "a flow variable belongs to a connector, `class Plug(Connector)`; in a component it is a variable."
    return ""


def _is_record(cls: Any) -> bool:
    return any(base.__name__ == "Record" for base in cls.__mro__)


def _wrong_value(field: f.Field) -> str:
    """Return the message for an invalid default or bound of a parameter, "" for valid ones."""
    default, least = field.default, getattr(field, "minimum", None)
    if isinstance(default, f.InitialValue):
        return f"a parameter has no start: write default={shown(default.value)}."
    if least is not None and (isinstance(least, bool) or not isinstance(least, int | float | np.number)):
        return f"minimum={shown(least)} must be a number; state limits that depend on other fields in requirements()."
    if isinstance(field, f.Parameter) and not isinstance(field.positive, bool):
        return f"positive={shown(field.positive)} must be True or False; a lower bound is minimum=..."
    if inspect.isfunction(default) and not _takes_self(default):
        return "a computed default is a function of the component: default=lambda s: 2 * s.r."
    if isinstance(field, f.Parameter) and isinstance(default, str | bool | dict | set | f.Template):
        if isinstance(default, str) and decimal_point(default):
            return f"default={shown(default)} must be a number{decimal_point(default)}."
        remedy = ' Text and switches are structural: structural("...", default=...).' * isinstance(default, str | bool)
        return f"default={shown(default)} must be a number.{remedy}"
    if isinstance(field, f.Structural) and (wrong := _wrong_class(field)):
        return wrong
    choices = field.choices if isinstance(field, f.Structural) else None
    plain = isinstance(default, str | bool | int | float | None)
    if choices is not None and plain and default is not f.MISSING and default not in choices:
        return f"default={shown(default)} is not one of its choices, {', '.join(map(repr, choices))}."
    return ""


def _wrong_class(field: f.Structural) -> str:
    """Return the message for an invalid class or bound of a structural parameter, "" for valid ones."""
    cls, most, default = field.cls, field.maximum, field.default
    if cls is not None and not isinstance(cls, type):
        return f"cls={shown(cls)} must be a class, such as cls=int."
    if inspect.isfunction(most) and not _takes_self(most):
        return "a computed maximum is a function of the component: maximum=lambda s: 2 * s.n."
    if isinstance(most, f.Deferrable):
        return f"the maximum depends on another field: write a function, maximum=lambda s: s.{shown(most)}."
    if most is not None and not inspect.isfunction(most) and not data.fits(most, float):
        return f"maximum={shown(most)} must be a number, or a function of the component."
    given = default not in (None, f.MISSING) if isinstance(default, str | int | float | None) else False
    if cls is not None and given and not (data.fits(default, cls) or (isinstance(default, str) and data.loads(cls))):
        return f"default={shown(default)} must be {data.expected(cls, optional=False)}."
    return ""


def _wrong_part(field: f.Part) -> str:
    make = field.make
    if isinstance(make, type):
        fits = issubclass(make, f.Template) and (make._is_port or not field.is_port)
    else:
        fits = make is None or isinstance(make, f.Template | list) or callable(make)
    if not fits:
        what = getattr(make, "__name__", None) or shown(make)
        return f"port() takes a connector class, port(Frame), or decorates a method, not {what}. Parts need no port()."
    if isinstance(make, staticmethod | classmethod | property):
        return f"a method that returns a part takes self: remove @{type(make).__name__}."
    if inspect.isfunction(make) and not _takes_self(make):
        return f"a method that returns a part takes only self: `def {make.__name__}(self): return ...`."
    if inspect.isgeneratorfunction(make) and not field.many:
        mark, several = (
            ("port", " A method marked @ports returns several ports.")
            if field.is_port
            else ("part", " A method marked @parts returns several parts.")
        )
        if isinstance(field, f.Family):
            return "@ports decorates a method that returns a dict of ports by name: write `return`, not `yield`."
        return f"@{mark} decorates a method that returns one {mark}: write `return`, not `yield`.{several}"
    return ""


def _declared_by(field: f.Parameter | f.Variable) -> str:
    """Return the name of the function that declares a field."""
    if isinstance(field, f.Parameter):
        return "parameter"
    return "flow" if field.flow else field.causality or "variable"


def _takes_self(method: Any) -> bool:
    try:
        inspect.signature(method).bind(None)
    except (TypeError, ValueError):
        return False
    return True
