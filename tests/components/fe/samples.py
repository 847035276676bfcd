"""Samples of files of FE programs, and writers of some of their formats."""

from __future__ import annotations

import csv
import io
import re
from pathlib import Path
from typing import Any
from zipfile import ZipFile

import numpy as np
import scipy.linalg
import scipy.sparse as sp

ZIP = Path(__file__).parents[2] / "reference/fe/calculix.zip"
NAMES = ("c3d8i", "c3d20", "c3d10", "c3d10_held")


def calculix(folder: Path) -> Path:
    """Unpack what CalculiX 2.20 wrote of a box of steel, 0.1 x 0.015 x 0.01 m: NAME.inp, .sti, .mas, .dof."""
    with ZipFile(ZIP) as archive:
        archive.extractall(folder)
    return folder


def expected(name: str) -> np.ndarray:
    """Frequencies in Hz that go with a sample."""
    with ZipFile(ZIP) as archive:
        rows = list(csv.reader(io.TextIOWrapper(archive.open("frequencies.csv"), "utf-8")))
    column = rows[0].index(f"{name}[Hz]")
    return np.array([float(row[column]) for row in rows[1:]])


def frequencies(M: Any, K: Any) -> np.ndarray:
    """All frequencies in Hz of a body, held or free, whose mass matrix may be semi-definite; empty equations left out."""
    M, K = M.toarray(), K.toarray()
    used = np.diag(K) > 0
    M, K = M[np.ix_(used, used)], K[np.ix_(used, used)]
    shift = 1e-3 * np.trace(K) / np.trace(M)
    inverse = scipy.linalg.eigh(M, K + shift * M, eigvals_only=True)[::-1]
    return np.sqrt(np.maximum(1 / inverse[inverse > 1e-12 * inverse[0]] - shift, 0)) / (2 * np.pi)


def write_abaqus(
    path: Path, matrix: Any, numbers: np.ndarray, *, labels: bool = True, triangle: bool = True, held=()
) -> None:
    """Write a matrix as `*MATRIX OUTPUT, FORMAT=MATRIX INPUT` (with labels) or `FORMAT=COORDINATE` does."""
    entries = (sp.tril(matrix) if triangle else matrix).tocoo()
    lines = ["** MATRIX OF A TEST"]
    for i, j, value in zip(entries.row, entries.col, entries.data, strict=True):
        value = 1e36 if i == j and i in held else value
        place = f"{numbers[i // 3]},{i % 3 + 1}, {numbers[j // 3]},{j % 3 + 1}," if labels else f"{i + 1} {j + 1}"
        lines.append(f"{place} {value:.17e}")
    path.write_text("\n".join(lines) + "\n")


def deck(nodes: Any, kinds: dict[str, str], *, E: float, nu: float, rho: float, head: str = "", step: str = "") -> str:
    """A deck of Abaqus or CalculiX with the elements of `nodes.cells`; `kinds` has their names in the deck.

    CalculiX reads 20 characters of a number.
    """
    numbers = nodes.numbers if nodes.numbers is not None else np.arange(len(nodes)) + 1
    lines = [head, "*NODE, NSET=NALL"]
    lines += [
        f"{number}, {x:.12g}, {y:.12g}, {z:.12g}" for number, (x, y, z) in zip(numbers, np.asarray(nodes), strict=True)
    ]
    count = 0
    for kind, cells in nodes.cells.items():
        lines.append(f"*ELEMENT, TYPE={kinds[kind]}, ELSET=EALL")
        for cell in cells:
            count += 1
            words = [str(word) for word in (count, *numbers[cell])]
            lines += [
                ", ".join(words[:12]) + ("," if len(words) > 12 else ""),
                *([", ".join(words[12:])] if words[12:] else []),
            ]
    lines += ["*MATERIAL, NAME=A", "*ELASTIC", f"{E:.12g}, {nu:.12g}", "*DENSITY", f"{rho:.12g}"]
    lines += ["*SOLID SECTION, ELSET=EALL, MATERIAL=A", step]
    return "\n".join(line for line in lines if line) + "\n"


def scaled_sid(text: str, length: float, mass: float) -> str:
    """The text of a SID in other units, of `length` m and `mass` kg; q and mode shapes stay as they are."""
    powers = {"mdCM": 1, "J": 2, "Cr": 1, "Gr": 2, "Oe": 1}
    block, lines = "", []
    for line in text.splitlines():
        name, equals, value = line.partition("=")
        words = name.split()
        if not equals and words and words[0] not in ("end", "new", "part"):
            block = words[0]
        entry = re.match(r"m([01])\(", words[0]) if words else None
        if entry and equals:
            factor = 1.0
            if block == "origin" and entry[1] == "0":
                factor = 1 / length
            elif block in powers or block in ("Ct", "Me", "Ge", "Ke", "De"):
                factor = 1 / mass / length ** (powers.get(block, 0) - (entry[1] == "1"))
            elif block == "psi" or (block == "AP" and entry[1] == "1"):
                factor = length
            line = f"{name}= {float(value) * factor:.17g}"
        elif equals and words == ["mass"]:
            line = f"{name}= {float(value) / mass:.17g}"
        lines.append(line)
    return "\n".join(lines) + "\n"
