"""Tube: circular section with a circular hole."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from components.beams.sections.round import RoundSection


@dataclass(frozen=True)
class Tube(RoundSection):
    """Circular section with a circular hole in its centre.

    Parameters
    ----------
    d_o, d_i : float
        Outer and inner diameter in m.
    """

    d_o: Any
    d_i: Any
