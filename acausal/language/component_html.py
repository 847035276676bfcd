"""HTML of a component that is not built, for notebooks: its parts and parameters."""

from __future__ import annotations

import inspect
from collections.abc import Mapping, Sequence
from html import escape
from typing import Any

from acausal.language import fields as f
from acausal.language.value_checks import shown

SHOWN = 12  # rows of a table


def component_html(cls: Any, given: Mapping[str, Any]) -> str:
    """Return the tables of the parts and of the parameters of a component, given values first.

    Parameters
    ----------
    cls : Component class
        The class of the component.
    given : mapping of str to value
        The values of its constructor.
    """
    parts = [
        (name, _part(given.get(name, field.make)), field.description)
        for name, field in cls.fields.items()
        if isinstance(field, f.Part) and not field.is_port
    ]
    values = [
        (name, _value(given.get(name, argument.default)), _kind(argument.annotation), cls.fields[name].description)
        for name, argument in cls.__signature__.parameters.items()
        if isinstance(cls.fields.get(name), f.Structural | f.Parameter)
    ]
    values.sort(key=lambda row: row[0] not in given)
    text = escape((inspect.getdoc(cls) or "").partition("\n")[0])
    tables = table_html(("part", "component", ""), parts) + table_html(("parameter", "value", "kind", ""), values)
    return f"<p><b>{escape(cls.__name__)}</b> {text}</p>{tables}"


def _part(made: Any) -> str:
    """Return the code of a part, "" if a method creates it."""
    if isinstance(made, list):
        return f"{len(made)} parts"
    if isinstance(made, f.Template):
        return shown(made, f"{type(made).__name__}(...)")
    return f"{made.__name__}()" if isinstance(made, type) else ""


def _value(value: Any) -> str:
    return "" if value is inspect.Parameter.empty else shown(value)


def _kind(annotation: Any) -> str:
    return annotation if isinstance(annotation, str) else annotation.__name__


def table_html(head: Sequence[str], rows: Sequence[Sequence[str]]) -> str:
    """Return a table of the first rows; "" without rows.

    Parameters
    ----------
    head : sequence of str
        Names of the columns.
    rows : sequence of sequence of str
        The cells.
    """
    if not rows:
        return ""
    more = [(f"... ({len(rows)} in all)", *[""] * (len(head) - 1))] if len(rows) > SHOWN else []
    lines = ["".join(f"<td>{escape(cell)}</td>" for cell in row) for row in [*rows[:SHOWN], *more]]
    names = "".join(f"<th>{escape(name)}</th>" for name in head)
    return f"<table><tr>{names}</tr>{''.join(f'<tr>{line}</tr>' for line in lines)}</table>"
