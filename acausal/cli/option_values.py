"""Parsing of option values."""

from __future__ import annotations

import ast
from collections.abc import Iterable
from pathlib import Path
from typing import Any

from acausal.errors import DeclarationError
from acausal.language.table import Table
from acausal.result import shown_name

# First characters of a text that is meant as a number, a tuple or a quoted text.
_LITERAL = "([{+-'\""
_DIGITS = 300


def read_settings(texts: Iterable[str]) -> dict[str, Any]:
    """Read NAME=VALUE pairs.

    Parameters
    ----------
    texts : iterable of str
        VALUE is a number, a word (fem, true, false, None) or a tuple such as 0,0,1.

    Raises
    ------
    DeclarationError
        If a text is not such a pair, or a name occurs twice.
    """
    values: dict[str, Any] = {}
    for text in texts:
        name, value = pair(text, "--set takes NAME=VALUE, such as --set omega=4 or --set beam.E=7e10")
        if name in values:
            raise DeclarationError(f"--set gives `{shown_name(name)}` twice; leave one out.")
        values[name] = value_of(value, f"--set {shown_name(name)}")
    return values


def read_inputs(texts: Iterable[str]) -> dict[str, Any]:
    """Read NAME=FILE.csv:COLUMN pairs as times and values.

    Parameters
    ----------
    texts : iterable of str
        Times are in the column `time`, else in the first one; COLUMN may be left out if there is one more.

    Raises
    ------
    DeclarationError
        If a text is not such a pair, a name occurs twice, or a file has no such column.
    """
    found: dict[str, Any] = {}
    for text in texts:
        name, value = pair(text, "--input takes NAME=FILE.csv:COLUMN, such as --input road=road.csv:height")
        if name in found:
            raise DeclarationError(f"--input gives `{shown_name(name)}` twice; leave one out.")
        path, colon, column = (value, "", "") if Path(value).exists() else value.rpartition(":")
        if not colon and not Path(value).exists():
            path, column = value, ""
        data = Table.from_csv(path, column or None)
        if data.width:
            raise DeclarationError(f"--input {shown_name(name)}: name one of the {data.width} columns, {path}:COLUMN.")
        found[name] = data.x, data.values
    return found


def read_switches(texts: Iterable[str]) -> dict[str, list[Any]]:
    """Read NAME=VALUE,VALUE pairs.

    Parameters
    ----------
    texts : iterable of str
        Each VALUE as in `read_settings`, except tuples.
    """
    found: dict[str, list[Any]] = {}
    for text in texts:
        form = "--switch takes NAME=VALUE,VALUE, such as --switch crank=elastic,rigid"
        name, values = pair(text, form)
        if name in found:
            raise DeclarationError(f"--switch gives `{shown_name(name)}` twice; give all its values at once.")
        parts = [part.strip() for part in values.split(",")]
        if not all(parts):
            raise DeclarationError(f"{form}, not `{shown_name(text)}`.")
        found[name] = [value_of(part, f"--switch {shown_name(name)}") for part in parts]
    return found


def read_size(text: str | None) -> tuple[int, int] | None:
    """Read WIDTHxHEIGHT in pixels; None if not given.

    Raises
    ------
    DeclarationError
        If the text is not such a size.
    """
    if text is None:
        return None
    width, by, height = text.lower().partition("x")
    if not (by and width.isdecimal() and height.isdecimal()):
        raise DeclarationError(f"--size takes width and height in pixels, such as --size 800x600, not {text!r}.")
    return int(width), int(height)


def pair(text: str, form: str) -> tuple[str, str]:
    """Split NAME=VALUE; `form` describes the expected form in the message."""
    name, equals, value = (part.strip() for part in text.partition("="))
    if not (name and equals and value):
        raise DeclarationError(f"{form}, not `{shown_name(text)}`.")
    return name, value


def value_of(text: str, option: str) -> Any:
    """Read a number, a word or a tuple.

    Parameters
    ----------
    text : str
        The text, without surrounding spaces.
    option : str
        The option, for messages.
    """
    if text.lower() in ("true", "false"):
        return text.lower() == "true"
    try:
        value = ast.literal_eval(text)
        if _is_plain(value):
            return value
    except (ValueError, SyntaxError, MemoryError, RecursionError):
        pass
    try:
        return float(text)
    except ValueError:
        pass
    if text[0] in _LITERAL:
        raise DeclarationError(
            f"{option}: `{shown_name(text)}` is not a value; give a number (4, -7e10), a word (fem), or a tuple (0,0,1)."
        )
    return text


def _is_plain(value: Any) -> bool:
    """Return whether a value is a plain value, as parameters take it."""
    if isinstance(value, list | tuple):
        return all(_is_plain(item) for item in value)
    if isinstance(value, int) and abs(value) > 10**_DIGITS:
        return False  # exceeds the range of a double; as a float it is infinite and refused with that message
    return value is None or isinstance(value, bool | int | float | str)
