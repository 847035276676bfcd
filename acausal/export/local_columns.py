"""Columns of the tables of a model, with numbers of its file."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from acausal.language.table import Table


def local_columns(tables: Mapping[int, Table]) -> tuple[dict[int, float], tuple[np.ndarray, ...]]:
    """Return the number of the first column of each table by its entry, and the columns of all."""
    numbers, columns = dict[int, float](), list[np.ndarray]()
    for place, table in tables.items():
        numbers[place] = float(len(columns))
        columns += table.columns
    return numbers, tuple(columns)
