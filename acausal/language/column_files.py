"""Columns of numbers in CSV files."""

from __future__ import annotations

import os
from pathlib import Path

import numpy as np

from acausal.errors import DeclarationError


def read_csv(path: str | os.PathLike[str]) -> dict[str, np.ndarray]:
    """Return the columns of a CSV file by name; those without names have numbers from 1 on.

    Raises
    ------
    DeclarationError
        The file cannot be read, or an entry is not a number.
    """
    try:
        text = Path(path).expanduser().read_text(encoding="utf-8-sig")
    except (OSError, UnicodeDecodeError) as error:
        raise DeclarationError(f"cannot read {os.fspath(path)}: {getattr(error, 'strerror', None) or error}.") from None
    lines = [line for line in text.splitlines() if line.strip() and not line.startswith("#")]
    if not lines:
        raise DeclarationError(f"{os.fspath(path)} is empty.")
    delimiter = max(",;\t", key=lines[0].count)
    names = [word.strip().strip('"') for word in lines[0].split(delimiter)]
    headed = not all(map(_is_number, names))
    names = names if headed else [str(k + 1) for k in range(len(names))]
    rows = []
    for number, line in enumerate(lines[headed:], headed + 1):
        words = line.split(delimiter)
        if len(words) != len(names) or not all(map(_is_number, words)):
            raise DeclarationError(f"{os.fspath(path)}, row {number}: {line[:60]!r} is not {len(names)} numbers.")
        rows.append([float(word) for word in words])
    return dict(zip(names, np.array(rows, dtype=float).reshape(-1, len(names)).T, strict=True))


def _is_number(word: str) -> bool:
    try:
        float(word)
    except ValueError:
        return False
    return True
