"""Files of numbers: read whole; what is wrong is told by file and line."""

from __future__ import annotations

import io
import math
import re
import warnings
from pathlib import Path

import numpy as np

from acausal import DeclarationError
from acausal.result import read_text, shown_name
from components.fe.user_warning import warn

LARGEST = 10**12  # number of a node or an element that a program has
# Exponents of Fortran: 1.5D+10, and 1.5+100, whose letter gives way to a third digit.
FORTRAN = re.compile(r"(?<=[\d.])(?:[dD](?=[+-]?\d)|(?=[+-]\d))")


def wrong(path: str | Path, why: str, line: int | None = None) -> DeclarationError:
    """Return the error that says what is wrong in a file, and in which line (counted from 1)."""
    place = shown_name(path) if line is None else f"{shown_name(path)}, line {line}"
    return DeclarationError(f"{place}: {why}.")


def doubt(path: str | Path, why: str) -> None:
    """Warn of what a file holds."""
    warn(f"{shown_name(path)}: {why}.")


def text_of(path: str | Path, what: str) -> str:
    """Return what is in a text file, whose comments may be in any encoding.

    Parameters
    ----------
    path : str or Path
        Name of the file.
    what : str
        What it is, for messages.

    Raises
    ------
    DeclarationError
        If it cannot be read, is binary or empty.
    """
    text = read_text(path, what, "latin-1")
    if "\0" in text:
        raise wrong(path, f"this is a binary file, not {what}")
    if not text.strip():
        raise wrong(path, f"the file is empty; {what} was expected")
    return text


def table(path: str | Path, what: str, row: str, comments: str | None = None) -> np.ndarray:
    """Return a table of finite numbers that a file holds, a row for each line.

    Parameters
    ----------
    path : str or Path
        Name of the file.
    what : str
        What it is, for messages.
    row : str
        What stands in a line, as words between commas: "row, column, value". Commas and blanks separate in the file.
    comments : str, optional
        With what lines begin that are none of the table.

    Returns
    -------
    array (lines, columns)

    Raises
    ------
    DeclarationError
        If a line holds anything else, or the last one has no end: programs write whole lines, so the file was cut off.
    """
    text = text_of(path, what)
    values = numbers_in(path, text, row, comments)
    if not values.size:
        raise wrong(path, f"there is no line of {what} in the file: {row}")
    if not text.endswith("\n"):
        raise wrong(
            path, f"the last line has no end, so the file seems to be cut off: `{_shown(text.splitlines()[-1])}`"
        )
    return values


def numbers_in(path: str | Path, text: str, row: str, comments: str | None = None, above: int = 0) -> np.ndarray:
    """Return the table of finite numbers in a text, see `table`; `above` lines of the file stand above it."""
    columns = row.count(",") + 1
    values = _loaded(text, comments)
    if values is None:
        values = _loaded(FORTRAN.sub("e", text), comments)
    if values is None or (values.size and values.shape[1] != columns) or not np.isfinite(values).all():
        raise _first_wrong(path, text, row, comments, above)
    return values


def whole_numbers(path: str | Path, values: np.ndarray, what: str) -> np.ndarray:
    """Return numbers of a file as integers, or refuse those that are none."""
    if not (values == np.rint(values)).all():
        bad = values[values != np.rint(values)].flat[0]
        raise wrong(path, f"{what} are whole numbers, not {bad:g}")
    return values.astype(np.int64)


def number(text: str) -> float:
    """Return a number as C or Fortran writes it, or raise ValueError; an empty text is 0."""
    text = text.strip()
    value = float(FORTRAN.sub("e", text) or 0)
    if not math.isfinite(value):
        raise ValueError(f"{text} is not finite")
    return value


def _loaded(text: str, comments: str | None) -> np.ndarray | None:
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")  # of a text of comments alone: an empty table
            return np.loadtxt(io.StringIO(text.replace(",", " ")), ndmin=2, comments=comments)
    except ValueError:
        return None


def _first_wrong(path: str | Path, text: str, row: str, comments: str | None, above: int) -> DeclarationError:
    columns = row.count(",") + 1
    for place, line in enumerate(text.splitlines(), above + 1):
        words = line.replace(",", " ").split()
        if not words or (comments and words[0].startswith(comments)):
            continue
        if len(words) != columns:
            return wrong(path, f"a line holds {row}, not `{_shown(line)}`", place)
        for word in words:
            try:
                number(word)
                good = True
            except ValueError:
                good = False
            if not good:
                return wrong(path, f"a line holds {row}, and `{_shown(word)}` is not a finite number", place)
    return wrong(path, f"a line holds {row}")


def _shown(text: str) -> str:
    return shown_name(text.strip())
