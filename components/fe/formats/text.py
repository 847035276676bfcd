"""Text files of numbers, with errors that name file and line."""

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

LARGEST = 10**12  # largest number of a node or element; more than any FE program has
# Fortran exponents: 1.5D+10, and 1.5+100, where a third digit replaces the letter.
FORTRAN = re.compile(r"(?<=[\d.])(?:[dD](?=[+-]?\d)|(?=[+-]\d))")


def file_error(path: str | Path, why: str, line: int | None = None) -> DeclarationError:
    """Return the error for a file, or for one of its lines (counted from 1)."""
    place = shown_name(path) if line is None else f"{shown_name(path)}, line {line}"
    return DeclarationError(f"{place}: {why}.")


def file_warning(path: str | Path, why: str) -> None:
    """Warn about the content of a file."""
    warn(f"{shown_name(path)}: {why}.")


def text_of(path: str | Path, what: str) -> str:
    """Return the content of a text file; comments may be in any encoding.

    Parameters
    ----------
    path : str or Path
        Name of the file.
    what : str
        Kind of content, for messages.

    Raises
    ------
    DeclarationError
        If the file cannot be read, is binary or empty.
    """
    text = read_text(path, what, "latin-1")
    if "\0" in text:
        raise file_error(path, f"this is a binary file, not {what}")
    if not text.strip():
        raise file_error(path, f"the file is empty; {what} was expected")
    return text


def table(path: str | Path, what: str, row: str, comments: str | None = None) -> np.ndarray:
    """Return the table of finite numbers in a file, one row for each line.

    Parameters
    ----------
    path : str or Path
        Name of the file.
    what : str
        Kind of content, for messages.
    row : str
        Columns of the table: "row, column, value". Commas or blanks separate them in the file.
    comments : str, optional
        Prefix of lines to ignore.

    Returns
    -------
    array (lines, columns)

    Raises
    ------
    DeclarationError
        If a line has other content, or the last line has no newline: the file was truncated.
    """
    text = text_of(path, what)
    values = numbers_in(path, text, row, comments)
    if not values.size:
        raise file_error(path, f"the file has no lines of {what}: {row}")
    if not text.endswith("\n"):
        raise file_error(
            path, f"the last line is incomplete; the file seems to be truncated: `{_shown(text.splitlines()[-1])}`"
        )
    return values


def numbers_in(path: str | Path, text: str, row: str, comments: str | None = None, above: int = 0) -> np.ndarray:
    """Return the table of finite numbers in a text, as `table` does; the text begins below line `above` of the file."""
    columns = row.count(",") + 1
    values = _loaded(text, comments)
    if values is None:
        values = _loaded(FORTRAN.sub("e", text), comments)
    if values is None or (values.size and values.shape[1] != columns) or not np.isfinite(values).all():
        raise _first_error(path, text, row, comments, above)
    return values


def whole_numbers(path: str | Path, values: np.ndarray, what: str) -> np.ndarray:
    """Return numbers of a file as integers; raise an error unless all are whole."""
    if not (values == np.rint(values)).all():
        bad = values[values != np.rint(values)].flat[0]
        raise file_error(path, f"{what} must be integers, not {bad:g}")
    return values.astype(np.int64)


def number(text: str) -> float:
    """Return a number in C or Fortran notation, or raise ValueError; an empty text is 0."""
    text = text.strip()
    value = float(FORTRAN.sub("e", text) or 0)
    if not math.isfinite(value):
        raise ValueError(f"{text} is not finite")
    return value


def _loaded(text: str, comments: str | None) -> np.ndarray | None:
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")  # loadtxt warns if there are only comments
            return np.loadtxt(io.StringIO(text.replace(",", " ")), ndmin=2, comments=comments)
    except ValueError:
        return None


def _first_error(path: str | Path, text: str, row: str, comments: str | None, above: int) -> DeclarationError:
    columns = row.count(",") + 1
    for place, line in enumerate(text.splitlines(), above + 1):
        words = line.replace(",", " ").split()
        if not words or (comments and words[0].startswith(comments)):
            continue
        if len(words) != columns:
            return file_error(path, f"a line must be {row}, not `{_shown(line)}`", place)
        for word in words:
            try:
                number(word)
                good = True
            except ValueError:
                good = False
            if not good:
                return file_error(path, f"a line must be {row}, and `{_shown(word)}` is not a finite number", place)
    return file_error(path, f"a line must be {row}")


def _shown(text: str) -> str:
    return shown_name(text.strip())
