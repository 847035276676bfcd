"""What stands in the page of an explorer, unpacked independently of the page's own script."""

from __future__ import annotations

import json
import re
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np

from tests.acausal.animation.places import unpacked


class Explored:
    """The document of an explorer's page."""

    def __init__(self, path: Path) -> None:
        self.text = path.read_text()
        found = re.search(r'<script type="application/json" id="document">(.*?)</script>', self.text, re.DOTALL)
        assert found
        self.document = json.loads(found[1])
        explorer = self.document["explorer"]
        self.model = json.loads(unpacked(explorer["model"], "u1").tobytes())
        self.time = unpacked(explorer["time"], "<f8")
        self.columns = series(explorer["series"], len(self.time))
        self.constants = unpacked(explorer["series"]["constants"], "<f8")
        self.variables = dict(members(self.model["root"], ""))

    def column(self, number: int) -> np.ndarray:
        """Values of a variable at the times of the page."""
        return self.columns[number] if number >= 0 else np.full(len(self.time), self.constants[~number])


def series(packed: dict[str, Any], times: int) -> np.ndarray:
    """Return the changing variables, shape (varying, times)."""
    low, high = unpacked(packed["codes"], "u1").reshape(2, packed["varying"], times).astype(np.int64)
    folded = low + 256 * high
    codes = np.where(folded % 2, -(folded + 1) // 2, folded // 2)
    for _ in range(3):
        codes = np.cumsum(codes, axis=1)
    codes %= 2**16
    values = unpacked(packed["low"], "<f8")[:, None] + unpacked(packed["step"], "<f8")[:, None] * codes
    return np.where(codes == 2**16 - 1, np.nan, values)


def members(part: dict[str, Any], path: str) -> Iterator[tuple[str, dict[str, Any]]]:
    """Yield variables and parameters, with their paths."""
    for kind in ("variables", "parameters"):
        for one in part.get(kind, ()):
            yield f"{path}{one['name']}", one
    for inner in part.get("parts", ()):
        yield from members(inner, f"{path}{inner['name']}.")
